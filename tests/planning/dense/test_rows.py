"""A world compressed into rows of entries, against what the world says of every state."""

from __future__ import annotations

from collections.abc import Mapping
from itertools import pairwise
from typing import Any

import numpy as np
import pytest

from models.logic import parse
from models.planning import Options, plan
from models.planning.dense.compressed import Compressed, Rows, compress
from models.world import OomdpWorld, ProjectedWorld, compile_world, load_environment, relevant_part, toys_spec
from tests.planning.random_tasks import navigation_task, toys_task
from tests.world.test_factors import WORLDS
from tests.world.worlds import changed

LENGTHS = (1, 7, 50, 5_000)
STAY = -1
Moves = dict[int, dict[int, float]]
"""action -> successor -> probability"""


def world_of(data: Any) -> OomdpWorld:
    world = compile_world(load_environment(data))
    assert isinstance(world, OomdpWorld)
    return world


def entries(dense: Compressed) -> list[Moves]:
    """The moves of every valid state; those of others, which count for nothing, lead to states of the world too."""
    rows, effects = dense.rows, dense.effects
    found: list[Moves] = [{} for _ in dense.valid]
    for row in range(len(rows.first_entry) - 1):
        for entry in range(rows.first_entry[row], rows.first_entry[row + 1]):
            effect = rows.effect[entry]
            action, outcomes = int(effects.action[effect]), range(effects.first[effect], effects.first[effect + 1])
            for place in places(rows, entry):
                state = row * rows.length + place
                move = {state + int(effects.shift[k]): float(effects.probability[k]) for k in outcomes}
                assert all(0 <= successor < len(found) for successor in move)
                if dense.valid[state]:
                    assert action not in found[state], "a state has an action twice"
                    found[state][action] = move
    return found


def places(rows: Rows, entry: int) -> list[int]:
    """The places in the row where an entry's effect is possible."""
    begin, end, width, stride = (int(part[entry]) for part in (rows.begin, rows.end, rows.width, rows.stride))
    assert 0 <= begin < end <= rows.length
    assert 0 < width <= stride
    assert (end - begin - width) % stride == 0
    return [place for run in range(begin, end, stride) for place in range(run, run + width)]


def moves(world: OomdpWorld | ProjectedWorld) -> list[Moves]:
    """The same as the world tells them; nothing in invalid states."""
    found: list[Moves] = [{} for _ in range(world.size)]
    valid = world.valid()
    for action in range(len(world.actions)):
        outcomes = world.outcomes(action)
        for state in np.flatnonzero(outcomes.enabled & valid).tolist():
            pairs = zip(outcomes.successor[:, state].tolist(), outcomes.probability[:, state].tolist(), strict=True)
            found[state][action] = {successor: chance for successor, chance in pairs if chance > 0}
    for state in np.flatnonzero(valid).tolist():
        found[state] = found[state] or {STAY: {state: 1.0}}
    return found


def check(world: OomdpWorld | ProjectedWorld) -> Compressed:
    """Entries and validity are the world's."""
    assert world.factored is not None
    dense = compress(world.factored, np.zeros(world.size, dtype=np.int8))
    assert (dense.valid == world.valid()).all()
    for found, known in zip(entries(dense), moves(world), strict=True):
        assert list(found) == sorted(found), "the first action is the first of the world's"
        same_moves(found, known)
    return dense


def same_moves(found: Moves, known: Mapping[int, Mapping[int, float]]) -> None:
    assert found.keys() == known.keys()
    for action, move in found.items():
        assert move == pytest.approx(known[action], abs=1e-15)


@pytest.mark.parametrize("length", LENGTHS)
@pytest.mark.parametrize("name", sorted(set(WORLDS) - {"toys", "house", "warehouse"}))
def test_entries_are_the_worlds_actions(name: str, length: int, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("models.planning.dense.tables.LENGTH", length)
    dense = check(world_of(WORLDS[name]))
    assert dense.rows.length <= length


@pytest.mark.parametrize("length", LENGTHS)
def test_entries_of_random_worlds(length: int, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("models.planning.dense.tables.LENGTH", length)
    lengths = set()
    for seed in range(8):
        for task in (toys_task(seed), navigation_task(seed)):
            lengths.add(check(task.world).rows.length)
    assert len(lengths) > 1 or length == 1


@pytest.mark.parametrize("length", LENGTHS)
def test_entries_of_a_part(length: int, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("models.planning.dense.tables.LENGTH", length)
    formula = parse("F in(cylinder, box)")
    world = world_of(toys_spec(columns=4, toys=[("cylinder", "red"), ("sphere", "red"), ("cube", "red")], slip=0.2))
    part = relevant_part(world, (formula.operand,), world.initial)  # type: ignore[union-attr, arg-type]
    assert part is not None
    check(part)


def stuck() -> OomdpWorld:
    """Three switches that only go on: in the last state there is nothing to do."""
    data = {
        "name": "stuck",
        "kind": "oomdp",
        "domain_spec": {
            "name": "stuck",
            "attributes": {"power": ["off", "on"]},
            "classes": {"switch": {"state": {"power": "power"}}},
            "actions": {
                "press": {
                    "arguments": ["x: switch"],
                    "when": "x.power == off",
                    "outcomes": [{"set": {"x.power": "on"}}],
                }
            },
            "constraints": ["count(x: switch; x.power == on) >= 1"],
        },
        "objects": {name: {"class": "switch"} for name in "abc"},
        "state": {"a": {"power": "on"}, "b": {"power": "off"}, "c": {"power": "off"}},
    }
    return world_of(data)


@pytest.mark.parametrize("length", [1, 2, 4, 8])
def test_a_stuck_state_stays(length: int, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("models.planning.dense.tables.LENGTH", length)
    found = entries(check(stuck()))
    assert [state for state, choices in enumerate(found) if STAY in choices] == [7]
    assert found[7] == {STAY: {7: 1.0}}
    assert not found[0], "an invalid state has no entry"


def test_what_a_row_repeats_is_one_entry() -> None:
    """In rows of two toys the last toy can be picked up where it is with the robot: at every 18th place."""
    dense = check(world_of(toys_spec(columns=4, rows=4, toys=2, slip=0.1)))
    rows = dense.rows
    assert rows.length == 18 * 18
    repeated = rows.stride > rows.width
    assert (rows.stride[repeated] == 18).mean() > 0.9
    assert len(rows.effect) < 12 * (len(rows.first_entry) - 1)


@pytest.mark.parametrize("length", LENGTHS)
def test_rows_are_cut_where_the_letter_changes(length: int, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("models.planning.dense.tables.LENGTH", length)
    for seed, world in enumerate((world_of(WORLDS["many toys"]), stuck(), navigation_task(3).world)):
        assert world.factored is not None
        letter = np.random.default_rng(seed).integers(0, 2, world.size).astype(np.int8)
        dense = compress(world.factored, letter)
        rows = dense.rows
        read = np.full(world.size, -1)
        for row in range(len(rows.first_part) - 1):
            parts = range(rows.first_part[row], rows.first_part[row + 1])
            assert all(rows.letter[part] != rows.letter[following] for part, following in pairwise(parts))
            for part in parts:
                here = slice(row * rows.length + rows.part_begin[part], row * rows.length + rows.part_end[part])
                assert (read[here] == -1).all()
                read[here] = rows.letter[part]
        assert (read == letter)[world.valid()].all()


@pytest.mark.parametrize("length", LENGTHS)
def test_a_row_leads_to_the_rows_of_its_successors(length: int, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("models.planning.dense.tables.LENGTH", length)
    for world in (world_of(WORLDS["many toys"]), toys_task(1).world, navigation_task(3).world):
        assert world.factored is not None
        rows = compress(world.factored, np.zeros(world.size, dtype=np.int8)).rows
        known: list[set[int]] = [set() for _ in range(len(rows.first_input) - 1)]
        for state, choices in enumerate(moves(world)):
            known[state // rows.length] |= {successor // rows.length for move in choices.values() for successor in move}
        found = [rows.input[begin:end].tolist() for begin, end in pairwise(rows.first_input)]
        assert [sorted(row) for row in known] == [sorted(row) for row in found]


@pytest.mark.parametrize("limit", ["3000000000", "2147483649", "1e30", "1 / 0"])
@pytest.mark.parametrize("side", ["count(x: switch; x.power == on) <= {}", "{} > count(x: switch; x.power == on)"])
def test_a_guard_may_compare_with_a_number_of_any_size(side: str, limit: str) -> None:
    """With 13 switches the count fits no table and is a range."""
    data = {
        "name": "many",
        "kind": "oomdp",
        "domain_spec": {
            "name": "many",
            "attributes": {"power": ["off", "on"]},
            "classes": {"switch": {"state": {"power": "power"}}},
            "constants": {"goal": "switch"},
            "functions": {"done": {"is": "goal.power == on"}},
            "actions": {"win": {"when": side.format(limit), "outcomes": [{"set": {"goal.power": "on"}}]}},
        },
        "objects": {f"switch {i}": {"class": "switch"} for i in range(12)},
        "state": {name: {"power": "off"} for name in ("goal", *(f"switch {i}" for i in range(12)))},
    }
    world = world_of(changed(data))
    assert world.outcomes(0).enabled.all()
    result = plan(world, parse("F done"), options=Options(relevance=False))
    assert (result.outcome, result.expected_steps) == ("solved", 1.0)
