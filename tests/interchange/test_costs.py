"""Costs of actions through exports and imports: Storm's least expected rewards are the planner's least costs."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import pytest

from models.interchange import (
    PrismModelError,
    drn_model,
    drn_product,
    label_names,
    prism_model,
    read_prism,
)
from models.logic import Atom, atoms, parse, translate
from models.planning import Options, plan
from models.world import Environment, load_environment, resolve
from tests.interchange.isomorphism import from_drn, from_prism, maximum
from tests.planning.test_costs import DEAR, dear_toys
from tests.world.worlds import SWITCHES, changed

pytest.importorskip("stormpy")

LAMPS: dict[str, Any] = changed(
    SWITCHES, ("domain_spec/actions/go/cost", "2 - p"), ("domain_spec/actions/press/cost", 0.5)
)
WORLDS: dict[str, tuple[dict[str, Any], str]] = {
    "toys": (dear_toys(pick=3, east="1 + slip", put=0.25), "F in(sphere, box)"),
    "toys in order": (dear_toys(north=7, take=0.5), "!at(robot, bathroom) U holding(box) & F in(cube, box)"),
    "lamps": (LAMPS, "F (lit(one) & lit(two))"),
    "lamps by step": (LAMPS, "X X F (lit(one) & idle)"),
    "dear": (DEAR, "F goal"),
}


def task(name: str) -> tuple[Environment, Any]:
    data, formula = WORLDS[name]
    environment = load_environment(data)
    return environment, resolve(parse(formula), environment)


def least(environment: Environment, formula: Any) -> float:
    """The planner's least expected cost of a task that is sure to succeed."""
    found = plan(environment.world, formula, options=Options(relevance=False))
    assert (found.lower, found.upper) == (1, 1)
    assert found.expected_steps is not None
    return found.expected_steps


@pytest.mark.parametrize("name", WORLDS)
def test_the_least_cost_in_the_product_is_the_planners(name: str, tmp_path: Path) -> None:
    environment, formula = task(name)
    model = from_drn(drn_product(environment.world, translate(formula)), tmp_path)
    assert maximum(model, 'R{"costs"}min=? [ F "accepting" ]') == pytest.approx(least(environment, formula), rel=1e-5)


@pytest.mark.parametrize("name", ["toys", "lamps", "dear"])
def test_the_least_cost_in_the_world_is_the_planners(name: str, tmp_path: Path) -> None:
    environment, formula = task(name)
    wanted = atoms(formula)
    goal = " & ".join(f'"{label}"' for label in label_names(wanted).values())
    texts = (
        from_prism(prism_model(environment, atoms=wanted), tmp_path)[1],
        from_drn(drn_model(environment.world, atoms=wanted), tmp_path),
        from_drn(drn_model(environment.world, atoms=wanted, reachable=True), tmp_path),
    )
    cost = least(environment, formula)
    for model in texts:
        assert maximum(model, f'R{{"costs"}}min=? [ F {goal} ]') == pytest.approx(cost, rel=1e-5)


def test_steps_are_counted_beside_costs(tmp_path: Path) -> None:
    """Of the two ways the short one takes 1 step and the long one 4 on average, at 10 and 7."""
    _, model = from_prism(prism_model(load_environment(DEAR), atoms=[Atom("goal")]), tmp_path)
    assert maximum(model, 'R{"steps"}min=? [ F "goal" ]') == pytest.approx(1)
    assert maximum(model, 'R{"costs"}min=? [ F "goal" ]') == pytest.approx(7)


def test_a_parameter_of_a_cost_stays_one() -> None:
    text = prism_model(load_environment(WORLDS["toys"][0]))
    assert "  [east] true : 1 + slip;\n" in text
    assert "  [pick_sphere] true : 3;\n" in text
    assert "  [drop_sphere] true : 1;\n" in text


def test_a_state_that_stops_costs_1_a_step(tmp_path: Path) -> None:
    """It is the only way to the third step after the goal, which costs 10."""
    environment = load_environment(changed(DEAR, ("transitions/1/cost", 100)))
    model = from_drn(drn_product(environment.world, translate(parse("F (goal & X X X goal)"))), tmp_path)
    assert maximum(model, 'R{"costs"}min=? [ F "accepting" ]') == pytest.approx(13)
    assert least(environment, parse("F (goal & X X X goal)")) == pytest.approx(13)
    _, stuck = from_prism(prism_model(environment, atoms=[Atom("goal")]), tmp_path)
    assert maximum(stuck, 'R{"costs"}min=? [ C<=4 ]') == pytest.approx(13)


@pytest.mark.parametrize("name", ["toys", "lamps", "dear"])
def test_costs_survive_a_round_trip(name: str) -> None:
    environment, formula = task(name)
    wanted = atoms(formula)
    again = load_environment(read_prism(prism_model(environment, atoms=wanted)))
    goal = " & ".join(label_names(wanted).values())
    assert least(again, parse(f"F ({goal})")) == pytest.approx(least(environment, formula), rel=1e-6)


def test_where_all_costs_are_1_there_are_only_steps() -> None:
    environment = load_environment(dear_toys())
    product = drn_product(environment.world, translate(parse("true")))
    for text in (prism_model(environment), drn_model(environment.world), product):
        assert "costs" not in text


MODEL = """mdp
const double c = 2.5;
module m
  x : [0..2] init 0;
  [go] x < 2 -> 0.5 : (x' = x + 1) + 0.5 : true;
  [] x = 0 -> (x' = 2);
endmodule
"""
COSTS = 'rewards "costs"\n  [go] true : c;\n  x = 0 : 0.1;\n  [] true : 3;\nendrewards\n'
STEPS = 'rewards "steps"\n  true : 1;\nendrewards\n'
TIME = 'rewards "time"\n  x < 2 : 4;\nendrewards\n'
FREE = 'rewards "free"\n  x = 0 : 1;\nendrewards\n'
UNNAMED = "rewards\n  true : 5;\nendrewards\n"


def costs(text: str, **options: Any) -> list[float]:
    """Of `go` and of the other command in state 0, and of `go` in state 1."""
    data = read_prism(text, **options)
    load_environment(data)
    assert [(t["from"], t["action"]) for t in data["transitions"]] == [(0, "go"), (0, "choice0"), (1, "go")]
    return [t.get("cost", 1) for t in data["transitions"]]


@pytest.mark.parametrize(
    ("structures", "wanted", "found"),
    [
        ("", None, [1, 1, 1]),
        (COSTS, None, [2.6, 3.1, 2.5]),
        (TIME, None, [4, 4, 4]),
        (UNNAMED, None, [5, 5, 5]),
        (STEPS + COSTS, None, [2.6, 3.1, 2.5]),
        (STEPS + TIME, None, [1, 1, 1]),
        (STEPS + TIME, "time", [4, 4, 4]),
        (COSTS + STEPS, "steps", [1, 1, 1]),
        (UNNAMED + STEPS, "", [5, 5, 5]),
        (FREE, None, [1, 1, 1]),  # `go` in state 1 would cost nothing
    ],
)
def test_rewards_are_read_as_costs(structures: str, wanted: str | None, found: list[float]) -> None:
    assert costs(MODEL + structures, rewards=wanted) == pytest.approx(found, abs=1e-12)


def test_rewards_of_a_dtmc_are_costs_too() -> None:
    text = "dtmc\nmodule m\n  x : [0..1] init 0;\n  [] x = 0 -> 0.5 : (x' = 1) + 0.5 : true;\nendmodule\n"
    data = read_prism(text + 'rewards "time"\n  x = 0 : 2.5;\nendrewards\n')
    assert [(t["action"], t["cost"]) for t in data["transitions"]] == [("step", 2.5)]


@pytest.mark.parametrize(
    ("structures", "wanted", "message"),
    [
        (STEPS + TIME, "cost", "no reward structure cost: it has steps, time"),
        ("", "costs", "no reward structure costs: it has none"),
        (FREE + STEPS, "free", "costs are positive, but in state 1 the rewards free are 0"),
        ("rewards\n  true : -1;\nendrewards\n", "", "the rewards without a name are -1"),
    ],
)
def test_rewards_that_are_no_costs_are_refused_where_they_are_asked_for(
    structures: str, wanted: str, message: str
) -> None:
    with pytest.raises(PrismModelError) as refusal:
        read_prism(MODEL + structures, rewards=wanted)
    assert message in refusal.value.detail
