"""Costs of actions, by hand and in both solvers."""

from __future__ import annotations

from typing import Any

import pytest

from models.logic import parse
from models.planning import Options, check, plan
from models.world import WorldError, compile_world, load_environment, toys_spec

DEAR: dict[str, Any] = {
    "name": "dear",
    "kind": "explicit",
    "states": 4,
    "labels": {"goal": [3]},
    "transitions": [
        {"from": 0, "action": "short", "cost": 10, "to": [[3, 1.0]]},
        {"from": 0, "action": "long", "to": [[1, 1.0]]},
        {"from": 1, "action": "on", "cost": 2.5, "to": [[2, 0.5], [1, 0.5]]},
        {"from": 2, "action": "on", "to": [[3, 1.0]]},
    ],
}


def test_the_cheaper_way_is_taken_though_it_is_longer() -> None:
    world = compile_world(load_environment(DEAR))
    result = plan(world, parse("F goal"))
    assert result.policy is not None
    assert result.policy.step(0, result.initial_memory).action == "long"
    assert result.expected_steps == pytest.approx(1 + 5 + 1)  # 2.5 for each of two tries on average
    assert check(world, result.policy).expected_steps == pytest.approx(7)


def dear_toys(**costs: Any) -> dict[str, Any]:
    """Toys with a domain of their own, in which some actions cost."""
    from importlib.resources import files

    import yaml

    domain = yaml.safe_load((files("models.world") / "domains" / "toys.yaml").read_text())
    for action, cost in costs.items():
        domain["actions"][action]["cost"] = cost
    spec = toys_spec(columns=3, rows=1, toys=[("sphere", "red"), ("cube", "red")], slip=0.1)
    del spec["domain"]
    return {**spec, "domain_spec": domain}


@pytest.mark.parametrize("relevance", [True, False])
def test_costs_of_the_world_language(relevance: bool) -> None:
    world = compile_world(load_environment(dear_toys(pick=3, east="1 + slip")))
    result = plan(world, parse("F holding(sphere)"), options=Options(relevance=relevance))
    assert result.policy is not None
    # Two moves east of cost 1.1 that succeed with 0.9 (at the wall a slip stays), and a grasp of cost 3 with 0.9.
    assert result.expected_steps == pytest.approx(2 * 1.1 / 0.9 + 3 / 0.9, rel=1e-7)
    assert check(world, result.policy).expected_steps == pytest.approx(result.expected_steps, rel=1e-7)


@pytest.mark.parametrize("unit", [1e-6, 1e6])
def test_the_unit_of_costs_does_not_matter(unit: float) -> None:
    costs = dict.fromkeys(("north", "south", "east", "west", "pick", "drop", "put", "take"), unit)
    world = compile_world(load_environment(dear_toys(**costs)))
    for formula in ("F in(sphere, box)", "!at(robot, bathroom) U holding(box)"):
        plain = plan(compile_world(load_environment(dear_toys())), parse(formula), options=Options(relevance=False))
        result = plan(world, parse(formula), options=Options(relevance=False))
        assert (result.lower, result.upper) == pytest.approx((plain.lower, plain.upper))
        assert plain.expected_steps is not None
        assert result.expected_steps == pytest.approx(plain.expected_steps * unit, rel=1e-6)


@pytest.mark.parametrize("cost", [0, -1, "slip - slip", "1 / 0"])
def test_a_cost_is_positive(cost: Any) -> None:
    with pytest.raises(WorldError) as caught:
        compile_world(load_environment(dear_toys(pick=cost)))
    assert any("/actions/pick/cost" in place.pointer for place in caught.value.places)


def test_a_cost_reads_no_state() -> None:
    with pytest.raises(WorldError) as caught:
        compile_world(load_environment(dear_toys(pick="1 if robot.at == kitchen else 2")))
    assert any("/actions/pick/cost" in place.pointer for place in caught.value.places)
