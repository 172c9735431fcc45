"""Which part of toys and navigation worlds a formula depends on, and that this part is a world.

Guards are in `test_relevance_of_guards.py`; that plans in the part are plans in the whole in
`tests/planning/test_relevance.py`.
"""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

from models.logic import Atom, Name, parse
from models.logic import atoms as atoms_of
from models.world import (
    OomdpWorld,
    ProjectedWorld,
    StateError,
    compile_world,
    load_environment,
    navigation_spec,
    relevant_part,
    toys_spec,
)
from tests.world import test_world as contract

TOYS = [("cylinder", "red"), ("sphere", "red"), ("cube", "red"), ("cone", "red")]
IN_BOX = "F in(cylinder, box)"


def world_of(data: Any) -> OomdpWorld:
    world = compile_world(load_environment(data))
    assert isinstance(world, OomdpWorld)
    return world


def toys(count: int = 4, *, columns: int = 4, slip: float = 0.1, **state: str) -> OomdpWorld:
    """The robot in the kitchen, the box in the bedroom, toys elsewhere; `state` moves some of them."""
    moved = {name: {"in": place} for name, place in state.items()}
    return world_of(toys_spec(columns=columns, toys=TOYS[:count], slip=slip, state=moved))


def part(world: OomdpWorld, formula: str, start: int | None = None) -> ProjectedWorld | None:
    return relevant_part(world, atoms_of(parse(formula)), world.initial if start is None else start)


def kept(world: OomdpWorld, formula: str, start: int | None = None) -> set[str]:
    """The objects whose variables are kept; all of them where nothing is dropped."""
    found = part(world, formula, start)
    return {variable.object for variable in (world if found is None else found).variables}


def harmless(found: ProjectedWorld, world: OomdpWorld, name: str) -> set[str]:
    position = next(i for i, variable in enumerate(world.variables) if variable.object == name)
    return {world.variables[position].values[digit] for digit in found.projection.harmless[position]}


@pytest.mark.parametrize(
    ("formula", "wanted"),
    [
        (IN_BOX, {"robot", "box", "cylinder"}),
        ("F at(robot, kitchen)", {"robot"}),
        ("F at(box, kitchen)", {"robot", "box"}),
        ("F holding(cone)", {"robot", "box", "cone"}),
        ("F (at(cube, kitchen) & F holding(sphere))", {"robot", "box", "cube", "sphere"}),
        ("F colored(box, red)", {"robot"}),
    ],
)
def test_further_toys_are_dropped(formula: str, wanted: set[str]) -> None:
    assert kept(toys(), formula) == wanted


@pytest.mark.parametrize(("columns", "count"), [(1, 3), (2, 2), (2, 3), (3, 3), (3, 4), (4, 3), (6, 3)])
def test_further_toys_are_dropped_in_worlds_of_any_size(columns: int, count: int) -> None:
    wanted = {"robot", "box", "cylinder"} if columns > 1 else {"cylinder"}  # all lies where it can be put together
    assert kept(toys(count, columns=columns), IN_BOX) == wanted


def test_a_toy_that_is_held_at_the_start_matters() -> None:
    world = toys(sphere="robot")
    assert kept(world, IN_BOX) == {"robot", "box", "cylinder", "sphere"}
    assert kept(world, "F at(robot, bedroom)") == {"robot"}


def test_a_toy_in_the_box_moves_with_it_and_does_not_matter() -> None:
    world = toys(sphere="box")
    assert kept(world, IN_BOX) == {"robot", "box", "cylinder"}
    assert kept(world, "F at(sphere, kitchen)") == {"robot", "box", "sphere"}


def test_where_it_starts_decides() -> None:
    world = toys()
    held = world.encode({"sphere": {"in": "robot"}})
    assert "sphere" not in kept(world, IN_BOX)
    assert "sphere" in kept(world, IN_BOX, held)


def test_a_dropped_toy_may_be_anywhere_but_in_the_hand() -> None:
    world = toys()
    found = part(world, IN_BOX)
    assert found is not None
    places = set(world.variables[-1].values)
    assert harmless(found, world, "sphere") == places - {"robot"}
    assert harmless(found, world, "robot") == set(world.variables[0].values)


def test_navigation_and_worlds_of_which_all_matters_have_no_smaller_part() -> None:
    assert part(world_of(navigation_spec(columns=3, rows=3, slip=0.2)), "F at(robot, goal)") is None
    assert part(toys(1), IN_BOX) is None
    assert part(world_of(toys_spec(columns=5, rows=2, toys=24)), "F at(robot, attic)") is None  # cannot be numbered


# States to and fro, and the contract of worlds.


@pytest.fixture(scope="module")
def whole() -> OomdpWorld:
    return toys(3, slip=0.2)


@pytest.fixture(scope="module")
def inner(whole: OomdpWorld) -> ProjectedWorld:
    found = part(whole, IN_BOX)
    assert found is not None
    return found


def test_states_are_embedded_and_projected_back(whole: OomdpWorld, inner: ProjectedWorld) -> None:
    every = np.arange(inner.size)
    embedded = inner.projection.embed(every)
    assert (inner.projection.project(embedded) == every).all()
    assert len(set(embedded.tolist())) == inner.size
    assert inner.projection.embed(np.array([inner.initial])).tolist() == [whole.initial]
    assert inner.size == 4 * 5 * 6
    for state in (0, 7, inner.size - 1):
        rest = {name: value for name, value in whole.decode(whole.initial).items() if name in ("sphere", "cube")}
        assert whole.decode(int(embedded[state])) == inner.decode(state) | rest


def test_it_is_a_world(whole: OomdpWorld, inner: ProjectedWorld) -> None:
    contract.test_size_is_the_product_of_the_variables(inner)
    contract.test_the_initial_state_is_valid(inner)
    contract.test_encode_inverts_decode(inner)
    contract.test_actions_are_named_once(inner)
    contract.test_batches_are_rows_of_the_whole(inner)
    assert inner.actions == whole.actions
    atom = Atom("in", (Name("cylinder"), Name("box")))
    embedded = inner.projection.embed(np.arange(inner.size))
    assert (inner.labels([atom]) == whole.labels([atom], embedded)).all()


def test_a_state_that_breaks_a_constraint_is_refused(inner: ProjectedWorld) -> None:
    with pytest.raises(StateError, match="constraint"):
        inner.encode({"box": {"in": "robot"}, "cylinder": {"in": "robot"}})


def test_what_only_moves_others_is_not_possible_and_the_rest_is_as_in_the_whole(
    whole: OomdpWorld, inner: ProjectedWorld
) -> None:
    embedded = inner.projection.embed(np.arange(inner.size))
    for action, name in enumerate(whole.actions):
        found, known = inner.outcomes(action), whole.outcomes(action, embedded)
        if "sphere" in name or "cube" in name:
            assert not found.enabled.any()
            assert not found.probability.any()
            assert (found.successor == np.arange(inner.size)).all()
        else:
            assert (found.enabled == known.enabled).all()
            assert (found.probability == known.probability).all()
            assert (inner.projection.embed(found.successor) == known.successor).all()
