"""Ever larger parts of a world, and the world that may stay in each: against what the whole world does."""

from __future__ import annotations

import random
from itertools import pairwise

import numpy as np
import pytest

from models.logic import atoms, parse
from models.world import IdlingWorld, OomdpWorld, ProjectedWorld, relevant_parts
from tests.planning.random_boards import board, random_board
from tests.world import test_world as contract
from tests.world.test_relevance import toys

FORMULA = atoms(parse("a & b"))


def parts_of(world: OomdpWorld) -> list[ProjectedWorld]:
    return list(relevant_parts(world, FORMULA, world.initial))


def kept(part: ProjectedWorld) -> set[str]:
    return {variable.object for variable in part.variables}


def test_parts_grow_by_what_the_smallest_action_moves() -> None:
    flip = {"outcomes": [{"set": {"one.at": "on"}}]}
    near = {"when": "blue.at == off", "outcomes": [{"set": {"blue.at": "on"}}]}
    far = {"when": "blue.at == on and green.at == on", "outcomes": [{"set": {"red.at": "on"}}]}
    world = board({"flip": flip, "near": near, "far": far}, dict.fromkeys(("one", "red", "blue", "green"), "off"))
    first, second = parts_of(world)
    assert kept(first) == {"one"}
    assert kept(second) == {"one", "blue"}  # then red and green with blue, which is all


def test_toys_come_one_by_one_after_the_box() -> None:
    world = toys(3)
    found = relevant_parts(world, atoms(parse("F at(robot, kitchen)")), world.initial)
    sizes = [len(part.variables) for part in found]
    assert sizes == [1, 2, 3, 4]


def test_what_nothing_moves_is_never_added() -> None:
    world = board({"flip": {"outcomes": [{"set": {"one.at": "on"}}]}}, {"one": "off", "red": "off"})
    (only,) = parts_of(world)
    assert kept(only) == {"one"}


def test_an_action_without_effect_is_in_the_part_where_its_guard_holds() -> None:
    flip = {"outcomes": [{"set": {"one.at": "on"}}]}
    fiddle = {"outcomes": [{"set": {"red.at": "on"}}]}
    rest = {"when": "red.at == on and one.at == off", "outcomes": [{"probability": 0.5}, {"probability": 0.5}]}
    for red in ("on", "off"):
        world = board({"flip": flip, "fiddle": fiddle, "rest": rest}, {"one": "off", "red": red})
        part = parts_of(world)[0]
        found = part.outcomes(world.actions.index("rest"))
        assert found.enabled.tolist() == [red == "on", False]
        assert part.projection.harmless[1] == (int(red == "on"),)  # where the guard is the same


@pytest.mark.parametrize("seed", range(25))
def test_every_step_of_the_whole_world_is_one_in_the_part_or_leaves_it_as_it_is(seed: int) -> None:
    """From all states, and what the part does from there too where the others stay."""
    world = random_board(random.Random(seed))
    states = np.flatnonzero(world.valid())
    for part in parts_of(world):
        assert part.projection.project(np.array([world.initial])).tolist() == [part.initial]
        here = part.projection.project(states)
        for action in range(len(world.actions)):
            whole, inner = world.outcomes(action, states), part.outcomes(action, here)
            entered = part.projection.project(whole.successor)
            alike = inner.enabled & (entered == inner.successor).all(axis=0)
            alike &= (whole.probability == inner.probability).all(axis=0)
            idle = ((entered == here) | (whole.probability == 0)).all(axis=0)
            assert (~whole.enabled | alike | idle).all()
            every = np.arange(part.size)
            there = world.outcomes(action, part.projection.embed(every))
            mine = part.outcomes(action, every)
            assert (~mine.enabled | there.enabled).all()


def test_it_is_a_world() -> None:
    world = toys(3, slip=0.2)
    part = next(relevant_parts(world, atoms(parse("F holding(cylinder)")), world.initial))
    idling = IdlingWorld(part)
    contract.test_size_is_the_product_of_the_variables(idling)
    contract.test_the_initial_state_is_valid(idling)
    contract.test_encode_inverts_decode(idling)
    contract.test_actions_are_named_once(idling)
    contract.test_batches_are_rows_of_the_whole(idling)
    stay = idling.outcomes(len(idling.actions) - 1)
    assert (stay.successor == np.arange(idling.size)).all()
    assert stay.enabled.all()
    assert all(
        (idling.outcomes(action).successor == part.outcomes(action).successor).all()
        for action in range(len(part.actions))
    )


@pytest.mark.parametrize(("cost", "least"), [(3, 1), (0.25, 0.25)])
def test_to_stay_costs_no_more_than_anything_it_stands_for(cost: float, least: float) -> None:
    flip = {"cost": 0.125, "outcomes": [{"set": {"one.at": "on"}}]}
    fiddle = {"cost": cost, "outcomes": [{"set": {"red.at": "on"}}]}
    world = board({"flip": flip, "fiddle": fiddle}, {"one": "off", "red": "off"})
    idling = IdlingWorld(parts_of(world)[0])
    assert idling.cost(len(idling.actions) - 1).tolist() == [least] * 2
    assert idling.factored.actions[-1].cost == least


def test_the_parts_of_a_world_grow() -> None:
    for seed in range(40):
        parts = parts_of(random_board(random.Random(seed)))
        assert all(kept(one) < kept(other) for one, other in pairwise(parts))
