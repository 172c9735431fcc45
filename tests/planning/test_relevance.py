"""Plans in the part of a world that matters are plans in the whole world."""

from __future__ import annotations

import pytest

from models.logic import parse
from models.planning import Options, Plan, check, plan
from models.world import OomdpWorld, compile_world, load_environment, toys_spec
from tests.planning.random_tasks import Task, navigation_task, toys_task


def both_ways(world: OomdpWorld, formula: str) -> tuple[Plan, Plan]:
    """Plans with and without relevance, which must agree, the first attaining its claims in the whole world."""
    parsed = parse(formula)
    reduced, full = (plan(world, parsed, options=Options(relevance=on)) for on in (True, False))
    assert reduced.outcome == full.outcome
    assert (reduced.lower, reduced.upper) == pytest.approx((full.lower, full.upper), abs=1e-6)
    if reduced.policy is not None and reduced.expected_steps is not None:
        assert reduced.expected_steps == pytest.approx(full.expected_steps, rel=1e-6, abs=1e-9)
        found = check(world, reduced.policy)
        assert found.sound
        assert found.probability == pytest.approx(reduced.lower, abs=1e-6)
        assert found.expected_steps == pytest.approx(reduced.expected_steps, rel=1e-6, abs=1e-9)
    return reduced, full


def same(world: OomdpWorld, formula: str) -> None:
    """A plan in a smaller part is as good as one in the whole."""
    reduced, full = both_ways(world, formula)
    assert reduced.outcome == "solved"
    assert reduced.sizes.states < full.sizes.states


@pytest.mark.parametrize("block", range(6))
def test_the_part_has_the_same_plans(block: int) -> None:
    smaller, partial = 0, 0
    for seed in range(block * 15, block * 15 + 15):
        tasks: list[Task] = [toys_task(seed), toys_task(seed, spare=1), navigation_task(seed)]
        tasks += [toys_task(seed, spare=1, following=True), navigation_task(seed, following=True)]
        for task in tasks:
            reduced, full = both_ways(task.world, task.text)
            smaller += reduced.sizes.states < full.sizes.states
            partial += 0 < full.lower < 0.999
    assert smaller >= 8
    assert partial >= 1


@pytest.mark.parametrize(
    "formula",
    ["F (holding(box) & X holding(box))", "X X F in(cylinder, box)", "F at(box, kitchen) & X at(robot, bedroom)"],
)
def test_formulas_that_count_steps_have_a_part_too(formula: str) -> None:
    world = compile_world(load_environment(toys_spec(columns=4, toys=2, slip=0.1)))
    assert isinstance(world, OomdpWorld)
    same(world, formula)


def test_a_world_far_too_large_to_list_is_planned_and_checked() -> None:
    """Its states have numbers of 61 bits; times the memories they need 64."""
    world = compile_world(load_environment(toys_spec(columns=5, rows=2, toys=15)))
    assert isinstance(world, OomdpWorld)
    tour = "F at(robot, kitchen)"
    for room in ("room_10", "bedroom", "room_10", "kitchen", "attic"):
        tour = f"F (at(robot, {room}) & {tour})"
    result = plan(world, parse(tour), initial=world.encode({"robot": {"at": "room_10"}}))
    assert result.policy is not None
    assert check(world, result.policy).expected_steps == pytest.approx(result.expected_steps)
