"""What can be reached of a world, against a search state by state."""

from __future__ import annotations

import numpy as np
import pytest

from models.logic import Atom, Name
from models.world import OomdpWorld, StateError, World, compile_world, load_environment, reachable_part, toys_spec


def lock(latches: int, *, chance: str = "1") -> OomdpWorld:
    """Latches in a row, each of which can be pushed open once the one before it is; that works with some chance."""
    domain = {
        "name": "lock",
        "attributes": {"position": ["shut", "open"]},
        "classes": {"latch": {"static": {"before": "latch | none"}, "state": {"at": "position"}}},
        "functions": {"open": {"arguments": ["l: latch"], "is": "l.at == open"}},
        "actions": {
            "push": {
                "arguments": ["l: latch"],
                "when": "l.at == shut and (l.before == none or l.before.at == open)",
                "outcomes": [
                    {"probability": chance, "set": {"l.at": "open"}},
                    {"probability": f"1 - {chance}"},
                ],
            }
        },
    }
    objects = {
        f"l{i}": {"class": "latch", "attributes": {"before": f"l{i - 1}" if i else "none"}} for i in range(latches)
    }
    state = {name: {"at": "shut"} for name in objects}
    spec = {"name": "lock", "kind": "oomdp", "domain_spec": domain, "objects": objects, "state": state}
    world = compile_world(load_environment(spec))
    assert isinstance(world, OomdpWorld)
    return world


def search(world: World, start: int) -> set[int]:
    """The reachable states, one by one."""
    found, stack = {start}, [start]
    while stack:
        here = np.array([stack.pop()])
        for action in range(len(world.actions)):
            outcomes = world.outcomes(action, here)
            for successor in outcomes.successor[outcomes.probability > 0].tolist():
                if successor not in found:
                    found.add(successor)
                    stack.append(successor)
    return found


@pytest.mark.parametrize(
    "world", [lock(7, chance="0.5"), compile_world(load_environment(toys_spec(columns=2, toys=2, slip=0.1)))]
)
def test_it_has_the_states_and_transitions_of_a_search(world: World) -> None:
    part = reachable_part(world, world.initial, most_states=10_000, most_outcomes=1_000_000)
    assert part is not None
    assert set(part.states.tolist()) == search(world, world.initial)
    assert (np.diff(part.states) > 0).all()
    listed = part.listed
    assert listed is not None
    for state in range(part.size):
        chosen = range(listed.first_choice[state], listed.first_choice[state + 1])
        enabled = []
        for action in range(len(world.actions)):
            outcomes = world.outcomes(action, part.states[state : state + 1])
            if outcomes.enabled[0]:
                enabled.append(action)
                choice = chosen[len(enabled) - 1]
                here = slice(listed.first_outcome[choice], listed.first_outcome[choice + 1])
                found = dict(zip(part.states[listed.successor[here]], listed.probability[here], strict=True))
                happens = outcomes.probability[:, 0] > 0
                assert found == dict(zip(outcomes.successor[happens, 0], outcomes.probability[happens, 0], strict=True))
        assert listed.action[list(chosen)].tolist() == enabled


def test_it_is_a_world() -> None:
    world = lock(40, chance="0.5")
    part = reachable_part(world, world.initial, most_states=41, most_outcomes=200)
    assert part is not None
    assert part.size == 41
    assert part.decode(part.initial) == world.decode(world.initial)
    opened = part.encode({"l0": {"at": "open"}})
    assert part.decode(opened)["l0"] == {"at": "open"}
    assert part.labels([Atom("open", (Name("l0"),))])[0].tolist() == [i != part.initial for i in range(41)]
    assert part.valid().all()
    first = part.outcomes(0, np.array([part.initial]))
    assert sorted(first.successor[:, 0].tolist()) == sorted([part.initial, opened])
    assert part.cost(0, np.array([0, 1])).tolist() == [1, 1]
    with pytest.raises(StateError, match="cannot be reached"):
        part.encode({"l3": {"at": "open"}})


@pytest.mark.parametrize(("states", "outcomes"), [(40, 1_000), (100, 50)])
def test_nothing_is_given_beyond_a_limit(states: int, outcomes: int) -> None:
    world = lock(40, chance="0.5")
    assert reachable_part(world, world.initial, most_states=states, most_outcomes=outcomes) is None


def test_each_level_is_told_and_may_end_the_search() -> None:
    heard: list[int] = []

    def tell(found: int) -> None:
        heard.append(found)
        if found == 5:
            raise KeyboardInterrupt

    world = lock(40)
    with pytest.raises(KeyboardInterrupt):
        reachable_part(world, world.initial, most_states=100, most_outcomes=1_000, tell=tell)
    assert heard == [2, 3, 4, 5]
