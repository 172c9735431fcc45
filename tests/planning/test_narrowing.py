"""In parts of a world, where to stay in place may matter: traps with values by hand, and random worlds and formulas."""

from __future__ import annotations

import random
from itertools import product
from typing import Any

import pytest

from models.logic import parse
from models.planning import Options, Plan, check, plan
from models.planning.chain import explore
from models.planning.options import Objective
from models.planning.policy import WAIT
from models.world import OomdpWorld, compile_world, load_environment, toys_spec
from tests.planning.random_boards import board, random_board, random_formula
from tests.planning.random_tasks import toys_task

FLIP: dict[str, Any] = {"outcomes": [{"set": {"one.at": "off if one.at == on else on"}}]}
FIDDLE: dict[str, Any] = {"outcomes": [{"set": {"red.at": "off if red.at == on else on"}}]}
OFF = {"one": "off", "red": "off"}


def planned(world: OomdpWorld, formula: str, *, objective: Objective = "max") -> tuple[Plan, Plan]:
    """Plans with and without relevance, which must agree; the policy attains its claims in the whole world, and lets a
    step pass only where the world stops.
    """
    reduced, full = (
        plan(world, parse(formula), options=Options(relevance=on, objective=objective)) for on in (True, False)
    )
    assert reduced.outcome == full.outcome
    assert (reduced.lower, reduced.upper) == pytest.approx((full.lower, full.upper), abs=1e-6)
    if reduced.policy is not None:
        assert reduced.expected_steps == pytest.approx(full.expected_steps, rel=1e-6, abs=1e-9)
        assert (reduced.round_steps or (0, 0)) == pytest.approx(full.round_steps or (0, 0), rel=1e-6)
        found = check(world, reduced.policy)
        attained = reduced.lower if objective == "max" else 1 - reduced.upper
        assert found.sound
        assert found.probability == pytest.approx(attained, abs=1e-6)
        assert found.expected_steps == pytest.approx(reduced.expected_steps, rel=1e-6, abs=1e-9)
        chain = explore(world, reduced.policy)
        waiting = chain.state[chain.action == WAIT]
        assert not any(world.outcomes(one, waiting).enabled.any() for one in range(len(world.actions)))
    return reduced, full


def attains(
    world: OomdpWorld, formula: str, *, probability: float, steps: float, states: int, rounds: float | None = None
) -> Plan:
    """The plan with relevance, which must have these values by hand, in a part with so many states."""
    reduced, _ = planned(world, formula)
    assert (reduced.lower, reduced.upper) == pytest.approx((probability, probability), abs=1e-9)
    assert reduced.expected_steps == pytest.approx(steps, rel=1e-7)
    assert reduced.sizes.states == states
    if rounds is not None:
        assert reduced.round_steps == pytest.approx((rounds, rounds), rel=1e-7)
    return reduced


def test_a_toy_may_be_the_only_way_to_wait() -> None:
    """`one` flips at every step unless something else is done."""
    alone = plan(board({"flip": FLIP}, OFF), parse("F G a"))
    assert alone.outcome == "unreachable"
    result = attains(board({"flip": FLIP, "fiddle": FIDDLE}, OFF), "F G a", probability=1, steps=1, states=4)
    assert result.trajectory is not None
    assert [step.action for step in result.trajectory.steps[:3]] == ["flip", "fiddle", "fiddle"]


def test_only_what_it_takes_to_wait_is_added() -> None:
    """`blue` and `green` can be turned too, but to fiddle with `red` is enough."""
    dials = {**OFF, "blue": "off", "green": "off"}
    both = {"when": "blue.at == off", "outcomes": [{"set": {"blue.at": "on", "green.at": "on"}}]}
    attains(board({"flip": FLIP, "both": both, "fiddle": FIDDLE}, dials), "F G a", probability=1, steps=1, states=4)


def test_to_wait_may_have_to_be_prepared() -> None:
    """`one` is on and must stay so: `red` is turned on, which takes a step and does not go twice, then polished."""
    prepare = {"when": "red.at == off", "outcomes": [{"set": {"red.at": "on"}}]}
    polish = {"when": "red.at == on", "outcomes": [{"set": {"red.at": "red.at"}}]}
    world = board({"flip": FLIP, "prepare": prepare, "polish": polish}, {"one": "on", "red": "off"})
    attains(world, "G a", probability=1, steps=1, states=4)


def test_what_waits_may_jam() -> None:
    """With `red` on nothing is possible any more, and everything stays as it is."""
    flip = {**FLIP, "when": "red.at == off"}
    jam = {"when": "red.at == off", "outcomes": [{"set": {"red.at": "on"}}]}
    attains(board({"flip": flip, "jam": jam}, OFF), "F G a", probability=1, steps=2, states=4)


def test_waiting_may_succeed_with_a_probability_only() -> None:
    """`red` breaks or holds, half each, when it is pressed: once it holds it can be polished for ever."""
    dials = {"one": "on", "red": "low"}
    flip = {"outcomes": [{"set": {"one.at": "low if one.at == high else high"}}]}
    press = {
        "when": "red.at == low",
        "outcomes": [{"probability": 0.5, "set": {"red.at": "mid"}}, {"probability": 0.5, "set": {"red.at": "high"}}],
    }
    polish = {"when": "red.at == high", "outcomes": [{"set": {"red.at": "red.at"}}]}
    world = board(
        {"flip": flip, "press": press, "polish": polish}, dials | {"one": "high"}, values=("low", "mid", "high")
    )
    attains(world, "G a", probability=0.5, steps=1, states=9)


@pytest.mark.parametrize("fiddle", [True, False])
def test_all_that_matters_may_be_impossible(fiddle: bool) -> None:
    """`one` would need `two` to be on, which nothing turns: it stays off while `red` is fiddled with, or for ever."""
    turn = {"when": "two.at == on", "outcomes": [{"set": {"one.at": "on"}}]}
    world = board({"turn": turn} | ({"fiddle": FIDDLE} if fiddle else {}), {**OFF, "two": "off"})
    result = attains(world, "G !a", probability=1, steps=0, states=8 if fiddle else 4, rounds=1)
    assert result.policy is not None
    assert result.policy.step(world.initial, result.initial_memory).action == ("fiddle" if fiddle else None)
    assert planned(world, "F a")[0].outcome == "unreachable"


@pytest.mark.parametrize("guard", ["true", "red.at == on", "two.at == off"])
def test_an_action_without_effect_waits_in_the_smallest_part(guard: str) -> None:
    rest = {"when": guard, "outcomes": [{}]}
    dials = {"one": "off", "two": "off", "red": "on"}
    spin = {"outcomes": [{"set": {"two.at": "off"}}]}
    world = board({"flip": FLIP, "fiddle": FIDDLE, "spin": spin, "rest": rest}, dials)
    attains(world, "F G a", probability=1, steps=1, states=2)


def test_steps_are_counted_though_nothing_happens() -> None:
    """On after two steps exactly: one flip and one step of something else, whatever that costs."""
    assert plan(board({"flip": FLIP}, OFF), parse("X X a")).outcome == "unreachable"
    fiddle = {**FIDDLE, "cost": 5}
    attains(board({"flip": FLIP, "fiddle": fiddle}, OFF), "X X a", probability=1, steps=6, states=4)
    attains(board({"flip": FLIP, "fiddle": fiddle}, OFF), "X X X a", probability=1, steps=3, states=2)


def test_rounds_are_as_short_as_in_the_whole_world() -> None:
    """`a` holds in every second step, or for ever where there is something else to do meanwhile."""
    attains(board({"flip": FLIP}, OFF), "G F a", probability=1, steps=0, states=4, rounds=2)
    attains(board({"flip": FLIP, "fiddle": FIDDLE}, OFF), "G F a", probability=1, steps=0, states=4, rounds=1)
    attains(board({"flip": FLIP, "fiddle": FIDDLE}, OFF), "G F a & G F !a", probability=1, steps=0, states=2, rounds=2)


def test_the_least_probability_is_that_of_the_whole_world() -> None:
    """`a` need not come again if `red` is there to fiddle with."""
    assert plan(board({"flip": FLIP}, OFF), parse("G F a"), options=Options(objective="min")).lower == 1
    reduced, _ = planned(board({"flip": FLIP, "fiddle": FIDDLE}, OFF), "G F a", objective="min")
    assert (reduced.lower, reduced.upper, reduced.expected_steps) == (0, 0, 0)


@pytest.mark.parametrize(
    ("formula", "steps", "states", "rounds"),
    [
        ("G F at(robot, kitchen) & G F at(robot, bathroom)", 0, 4, 4),
        ("G !holding(sphere) & F at(robot, bathroom)", 2, 4 * 5 * 6, 1),
        ("G (at(robot, kitchen) -> F at(robot, bathroom))", 0, 4, 1),
        ("G F in(sphere, box) & G F !in(sphere, box)", 0, 4 * 5 * 6, 2),  # put, take
        ("F G holding(sphere)", 4, 4 * 5 * 6, 1),
        ("X X at(robot, bathroom)", 2, 4, None),
        ("X X X X at(robot, bathroom)", 4, 4, None),  # against the wall meanwhile
        ("F (holding(sphere) & X in(sphere, box))", 7, 4 * 5 * 6, None),  # 3 moves, pick, 2 moves back, put
    ],
)
def test_ten_more_toys_cost_nothing(formula: str, steps: float, states: int, rounds: float | None) -> None:
    """Kitchen, bedroom with the box, bathroom, living room with the sphere, in a row; over a milliard states."""
    toys = [("sphere", "red"), *((f"ball {i}", "red") for i in range(10))]
    world = compile_world(load_environment(toys_spec(columns=4, toys=toys)))
    result = plan(world, parse(formula))
    assert (result.lower, result.upper) == (1, 1)
    assert result.expected_steps == pytest.approx(steps, rel=1e-7)
    assert result.sizes.states == states
    assert result.round_steps == (None if rounds is None else pytest.approx((rounds, rounds), rel=1e-7))
    assert result.policy is not None
    assert check(world, result.policy).sound


def test_a_robot_that_slips_stays_by_handling_what_is_there() -> None:
    """Each move may lead out of the bathroom, but to pick up the ball there and drop it does not: 2 moves and slips."""
    toys = [("sphere", "red"), ("ball", "red")]
    world = compile_world(load_environment(toys_spec(columns=4, toys=toys, slip=0.1)))
    assert isinstance(world, OomdpWorld)
    reduced, full = planned(world, "F G at(robot, bathroom)")
    assert (reduced.lower, reduced.sizes) == (1, full.sizes)


@pytest.mark.parametrize("block", range(3))
@pytest.mark.parametrize("objective", ["max", "min"])
def test_random_worlds_and_formulas(block: int, objective: Objective) -> None:
    smaller = solved = 0
    for seed in range(block * 20, block * 20 + 20):
        pick = random.Random(seed)
        reduced, full = planned(random_board(pick), random_formula(seed, pick), objective=objective)
        smaller += reduced.sizes.states < full.sizes.states
        solved += full.outcome == "solved"
    assert smaller >= 8
    assert solved >= 8


def test_without_time_for_more_the_bounds_are_those_of_the_whole_world() -> None:
    """Where no larger part is tried they may be wide, but hold."""
    wide = 0
    objectives: tuple[Objective, ...] = ("max", "min")
    for seed, objective in product(range(100, 160), objectives):
        pick = random.Random(seed)
        world, formula = random_board(pick), parse(random_formula(seed, pick))
        short = plan(world, formula, options=Options(objective=objective, hurry=lambda _: True))
        full = plan(world, formula, options=Options(objective=objective, relevance=False))
        assert short.outcome == full.outcome
        assert short.lower <= full.lower + 1e-9
        assert full.upper <= short.upper + 1e-9
        wide += short.upper - short.lower > 1e-6
    assert wide


@pytest.mark.parametrize("seed", range(30))
def test_toys_with_steps_that_count_have_the_values_of_the_reference(seed: int) -> None:
    task = toys_task(seed, spare=1, following=True)
    result = plan(task.world, parse(task.text))
    assert result.lower == pytest.approx(task.answer.probability, abs=1e-6)
    if result.expected_steps is not None:
        assert result.expected_steps == pytest.approx(task.answer.steps, rel=1e-6, abs=1e-9)
