"""The part of a world that a formula depends on: by hand, and against planning in the whole world."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

from models.logic import Atom, Name, parse
from models.logic import atoms as atoms_of
from models.planning import Options, Plan, check, plan
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
from tests.planning.random_tasks import Task, navigation_task, toys_task
from tests.world import test_world as contract
from tests.world.worlds import changed

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


# Toys and navigation.


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


# A domain in which everything can be said: switches, a goal, and a place with one value only.

SWITCHBOARD: dict[str, Any] = {
    "name": "board",
    "kind": "oomdp",
    "domain_spec": {
        "name": "board",
        "attributes": {"power": ["off", "on"]},
        "classes": {"room": {}, "switch": {"state": {"power": "power"}}, "thing": {"state": {"at": "room"}}},
        "constants": {"goal": "switch", "gate": "switch", "lever": "switch", "spare": "switch", "cart": "thing"},
        "functions": {"done": {"is": "goal.power == on"}},
        "actions": {
            "win": {"outcomes": [{"set": {"goal.power": "on"}}]},
            "open": {"outcomes": [{"set": {"gate.power": "on"}}]},
            "shut": {"outcomes": [{"set": {"gate.power": "off"}}]},
            "turn": {"outcomes": [{"set": {"spare.power": "off if spare.power == on else on"}}]},
        },
    },
    "objects": {"hall": {"class": "room"}},
    "state": {
        **{name: {"power": "off"} for name in ("goal", "gate", "lever", "spare")},
        "cart": {"at": "hall"},
    },
}
WIN = "domain_spec/actions/win"


def board(*changes: tuple[str, Any]) -> OomdpWorld:
    return world_of(changed(SWITCHBOARD, *changes))


@pytest.mark.parametrize(
    ("guard", "gate", "wanted"),
    [
        ("gate.power == on", "off", {"goal", "gate"}),
        ("gate.power == on", "on", {"goal"}),
        ("gate.power != on", "on", {"goal", "gate"}),
        ("gate.power != on", "off", {"goal"}),
        ("not gate.power == off", "off", {"goal", "gate"}),
        ("gate.power == lever.power", "on", {"goal", "gate", "lever"}),
        ("gate.power == lever.power", "off", {"goal"}),
        ("gate.power == on or goal.power == off", "off", {"goal", "gate"}),
        ("gate.power == on and goal.power == off", "on", {"goal"}),
        ("gate.power == goal.power", "off", {"goal", "gate"}),  # better off now, worse off later
    ],
)
def test_a_guard_matters_unless_all_stands_where_it_forbids_the_least(guard: str, gate: str, wanted: set[str]) -> None:
    world = board((f"{WIN}/when", guard), ("state/gate/power", gate))
    assert kept(world, "F done") == wanted
    same(world, "F done")


def test_what_an_action_moves_beside_matters() -> None:
    world = board((f"{WIN}/outcomes/0/set", {"goal.power": "on", "lever.power": "on"}))
    assert kept(world, "F done") == {"goal", "lever"}
    same(world, "F done")


def test_what_decides_an_effect_matters() -> None:
    world = board((f"{WIN}/outcomes/0/set", {"goal.power": "gate.power"}))
    assert kept(world, "F done") == {"goal", "gate"}
    same(world, "F done")


def test_what_decides_a_probability_matters() -> None:
    likely = [
        {"probability": "1 if gate.power == on else 0.5", "set": {"goal.power": "on"}},
        {"probability": "0 if gate.power == on else 0.5"},
    ]
    world = board((f"{WIN}/outcomes", likely))
    assert kept(world, "F done") == {"goal", "gate"}
    same(world, "F done")


def test_a_variable_with_a_single_value_may_be_set_beside() -> None:
    world = board((f"{WIN}/outcomes/0/set", {"goal.power": "on", "cart.at": "cart.at"}))
    assert {"gate", "lever", "spare"}.isdisjoint(kept(world, "F done"))
    same(world, "F done")


@pytest.mark.parametrize(
    ("constraint", "gate", "wanted"),
    [
        ("count(x: switch; x.power == on) <= 1", "off", {"goal"}),
        ("count(x: switch; x.power == on) <= 1", "on", {"goal", "gate"}),
        ("goal.power == on implies gate.power == on", "off", {"goal", "gate"}),
        ("goal.power == on implies gate.power == on", "on", {"goal"}),
        ("gate.power == on or lever.power == on", "on", {"goal"}),
    ],
)
def test_constraints_matter_as_guards_do(constraint: str, gate: str, wanted: set[str]) -> None:
    world = board(("domain_spec/constraints", [constraint]), ("state/gate/power", gate))
    assert kept(world, "F done") == wanted
    same(world, "F done")


def test_an_action_that_is_never_possible_stays_impossible() -> None:
    """No table can tell that the thirteenth lamp is missing: its guard is a sum over too many variables."""
    lamps = {f"lamp {i}": {"class": "switch"} for i in range(13)}
    world = board(
        ("objects", {**lamps, "hall": {"class": "room"}}),
        ("state", {**SWITCHBOARD["state"], **{lamp: {"power": "on"} for lamp in lamps}}),
        (f"{WIN}/when", "count(x: switch; x.power == on) >= 100"),
    )
    found = part(world, "F done")
    assert found is not None
    assert plan(world, parse("F done")).outcome == "unreachable"


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


# Plans in the part are plans in the whole.


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
def test_formulas_that_count_steps_are_planned_in_the_whole(formula: str) -> None:
    world = toys(2)
    reduced, full = both_ways(world, formula)
    assert reduced.sizes == full.sizes


def test_a_world_far_too_large_to_list_is_planned_and_checked() -> None:
    """Its states have numbers of 61 bits; times the memories they need 64."""
    world = world_of(toys_spec(columns=5, rows=2, toys=15))
    tour = "F at(robot, kitchen)"
    for room in ("room_10", "bedroom", "room_10", "kitchen", "attic"):
        tour = f"F (at(robot, {room}) & {tour})"
    result = plan(world, parse(tour), initial=world.encode({"robot": {"at": "room_10"}}))
    assert result.policy is not None
    assert check(world, result.policy).expected_steps == pytest.approx(result.expected_steps)
