"""Which guards, effects and constraints make a variable matter, in a domain in which everything can be said.

Each case is also planned in the whole world.
"""

from __future__ import annotations

from typing import Any

import pytest

from models.logic import atoms, parse
from models.planning import plan
from models.world import OomdpWorld, compile_world, load_environment, relevant_part
from tests.planning.test_relevance import same
from tests.world.worlds import changed

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
    world = compile_world(load_environment(changed(SWITCHBOARD, *changes)))
    assert isinstance(world, OomdpWorld)
    return world


def kept(world: OomdpWorld) -> set[str]:
    """The objects whose variables are kept for reaching the goal."""
    found = relevant_part(world, atoms(parse("F done")), world.initial)
    return {variable.object for variable in (world if found is None else found).variables}


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
    assert kept(world) == wanted
    same(world, "F done")


def test_what_an_action_moves_beside_matters() -> None:
    world = board((f"{WIN}/outcomes/0/set", {"goal.power": "on", "lever.power": "on"}))
    assert kept(world) == {"goal", "lever"}
    same(world, "F done")


def test_what_decides_an_effect_matters() -> None:
    world = board((f"{WIN}/outcomes/0/set", {"goal.power": "gate.power"}))
    assert kept(world) == {"goal", "gate"}
    same(world, "F done")


def test_what_decides_a_probability_matters() -> None:
    likely = [
        {"probability": "1 if gate.power == on else 0.5", "set": {"goal.power": "on"}},
        {"probability": "0 if gate.power == on else 0.5"},
    ]
    world = board((f"{WIN}/outcomes", likely))
    assert kept(world) == {"goal", "gate"}
    same(world, "F done")


def test_a_variable_with_a_single_value_may_be_set_beside() -> None:
    world = board((f"{WIN}/outcomes/0/set", {"goal.power": "on", "cart.at": "cart.at"}))
    assert {"gate", "lever", "spare"}.isdisjoint(kept(world))
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
    assert kept(world) == wanted
    same(world, "F done")


def lamps(guard: str, lit: int) -> OomdpWorld:
    """Thirteen lamps, some lit, which can be switched: a count of them is a range, as it fits no table."""
    names = [f"lamp {i}" for i in range(13)]
    return board(
        ("domain_spec/classes/lamp", {"state": {"power": "power"}}),
        ("domain_spec/actions/light", {"arguments": ["x: lamp"], "outcomes": [{"set": {"x.power": "on"}}]}),
        ("domain_spec/actions/dim", {"arguments": ["x: lamp"], "outcomes": [{"set": {"x.power": "off"}}]}),
        ("objects", {"hall": {"class": "room"}, **{name: {"class": "lamp"} for name in names}}),
        (
            "state",
            {**SWITCHBOARD["state"], **{name: {"power": "on" if i < lit else "off"} for i, name in enumerate(names)}},
        ),
        (f"{WIN}/when", guard),
    )


@pytest.mark.parametrize(
    ("guard", "lit", "matter"),
    [
        ("count(x: lamp; x.power == on) <= 5", 0, False),
        ("count(x: lamp; x.power == on) <= 5", 8, True),
        ("count(x: lamp; x.power == on) >= 5", 13, False),
        ("count(x: lamp; x.power == on) >= 5", 0, True),
        ("not count(x: lamp; x.power == on) > 5", 0, False),
        ("not 5 < count(x: lamp; x.power == on)", 8, True),
        ("count(x: lamp; x.power == on) == 5", 0, True),
        ("count(x: lamp; x.power == on) == 13", 13, False),
        ("any(x: lamp; x.power == on)", 13, False),
        ("any(x: lamp; x.power == on)", 0, True),
        ("not any(x: lamp; x.power == on)", 0, False),
        ("not any(x: lamp; x.power == on)", 13, True),
        ("all(x: lamp; x.power == on)", 13, False),
        ("all(x: lamp; x.power == on)", 0, True),
    ],
)
def test_counts_matter_unless_all_stands_at_the_better_end(guard: str, lit: int, matter: bool) -> None:
    world = lamps(guard, lit)
    found = {name for name in kept(world) if name.startswith("lamp")}
    assert bool(found) == matter
    same(world, "F done")


@pytest.mark.parametrize("guard", ["count(x: lamp; x.power == on) >= 100", "count(x: lamp; x.power == on) < 0 / 0"])
def test_an_action_that_is_never_possible_stays_impossible(guard: str) -> None:
    """No table can tell that the guard never holds."""
    assert plan(lamps(guard, 13), parse("F done")).outcome == "unreachable"
