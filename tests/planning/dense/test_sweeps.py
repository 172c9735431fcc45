"""The compiled passes over rows against the same, state by state, from what the world says of every state."""

from __future__ import annotations

from itertools import pairwise

import numpy as np
import pytest
from numpy.typing import NDArray

from models.planning.dense import rows
from models.planning.dense.compressed import Compressed, compress
from models.planning.dense.schedule import Schedule, schedule
from models.planning.dense.tables import Effects, without_loops
from models.world import OomdpWorld, toys_spec
from tests.planning.dense.test_rows import LENGTHS, STAY, moves, world_of
from tests.planning.random_tasks import navigation_task, toys_task

AFTER = np.array([[1, 0, -1], [1, 1, -2]], dtype=np.int32)
"""Memory after reading each of three letters in each of two memories."""


def problems(seed: int) -> list[tuple[OomdpWorld, NDArray[np.int8], Compressed]]:
    """Random worlds, with letters as they come."""
    made = []
    for world in (toys_task(seed).world, navigation_task(seed).world):
        assert world.factored is not None
        letter = np.random.default_rng(seed).integers(0, 3, world.size).astype(np.int8)
        made.append((world, letter, compress(world.factored, letter)))
    return made


def worths(world: OomdpWorld, value: NDArray[np.float64]) -> list[list[dict[int, float]]]:
    """What each action of each state is worth, by memory after reading."""
    cost = {STAY: 1.0} | {action: float(world.cost(action, np.array([0]))[0]) for action in range(len(world.actions))}
    return [
        [
            {
                action: cost[action] + sum(chance * value[then, successor] for successor, chance in move.items())
                for action, move in choices.items()
            }
            for then in range(len(value))
        ]
        for choices in moves(world)
    ]


@pytest.mark.parametrize("length", LENGTHS)
@pytest.mark.parametrize("seed", range(4))
def test_a_look_ahead_is_the_least_worth_of_an_action(length: int, seed: int, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("models.planning.dense.tables.LENGTH", length)
    for world, letter, dense in problems(seed):
        value = np.random.default_rng(seed).random((2, world.size)) * 10
        known, n = worths(world, value), dense.rows.length
        for row in range(world.size // n):
            found = np.full((2, n), -1.0)
            rows.look_ahead(dense.rows, dense.effects, AFTER, value.reshape(-1), row, found)
            for state in (row * n + np.flatnonzero(dense.valid[row * n : row * n + n])).tolist():
                for memory in range(2):
                    then = AFTER[memory, letter[state]]
                    least = -1.0 if then < 0 else min(known[state][then].values())
                    assert found[memory, state - row * n] == pytest.approx(least, rel=1e-12)


@pytest.mark.parametrize("length", LENGTHS)
@pytest.mark.parametrize("seed", range(4))
def test_the_first_of_the_cheapest_actions_is_chosen(length: int, seed: int, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("models.planning.dense.tables.LENGTH", length)
    for world, letter, dense in problems(seed):
        value = np.random.default_rng(seed).integers(0, 4, (2, world.size)).astype(np.float64)
        value[:, ::7] = np.inf
        known = worths(world, value)
        action, steps = np.empty(value.shape, dtype=np.int16), np.empty(value.shape)
        arguments = (value.reshape(-1), 1e-9, action.reshape(-1), steps.reshape(-1))
        count = world.size // dense.rows.length
        excess = rows.choose(dense.rows, dense.effects, dense.valid, AFTER, *arguments, 0, count)
        most = 0.0
        for state in range(world.size):
            for then in range(2):
                choices = known[state][then] if dense.valid[state] else {}
                least = min(choices.values(), default=np.inf)
                if least == np.inf:
                    assert (action[then, state], steps[then, state]) == (-1, 0.0)
                    continue
                first = min(number for number, worth in choices.items() if worth < least * (1 + 1e-10))
                assert action[then, state] == (first if first != STAY else -2)
                assert steps[then, state] == pytest.approx(least, rel=1e-9)
                before = [value[memory, state] for memory in range(2) if AFTER[memory, letter[state]] == then]
                most = max([most, *(steps[then, state] - one for one in before)])
        assert excess == pytest.approx(most, rel=1e-9)


def test_what_leads_back_is_left_out() -> None:
    effects = Effects(
        action=np.array([0, 1, 2, STAY], dtype=np.int32),
        cost=np.array([1.0, 3.0, 1.0, 1.0]),
        first=np.array([0, 2, 5, 6, 7], dtype=np.int32),
        probability=np.array([0.8, 0.2, 0.5, 0.25, 0.25, 1.0, 1.0]),
        shift=np.array([0, 4, -1, 0, 1, 2, 0]),
    )
    found = without_loops(effects)
    assert found.cost == pytest.approx([5.0, 4.0, 1.0, 1.0])
    assert found.first.tolist() == [0, 1, 3, 4, 5]
    assert found.probability == pytest.approx([1.0, 2 / 3, 1 / 3, 1.0, 1.0])
    assert found.shift.tolist() == [4, -1, 1, 2, 0]


@pytest.mark.parametrize("length", [1, 20, 400])
def test_groups_of_a_level_do_not_lead_to_each_other(length: int, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("models.planning.dense.tables.LENGTH", length)
    monkeypatch.setattr("models.planning.dense.tables.ROWS", 1)
    world = world_of(toys_spec(columns=3, rows=2, toys=2, slip=0.1))
    assert world.factored is not None
    dense = compress(world.factored, np.zeros(world.size, dtype=np.int8))
    count = world.size // dense.rows.length
    near = np.random.default_rng(length).integers(0, 50, count)
    found = schedule(dense.rows, dense.radix, near)
    assert sorted(found.order.tolist()) == list(range(count))
    levels_hold(dense, found, near)


def levels_hold(dense: Compressed, found: Schedule, near: NDArray[np.int64]) -> None:
    """Of two groups one of which leads to the other, the nearer one is in the lower level."""
    group, level = np.empty((2, len(found.order)), dtype=np.int64)
    for number, (begin, end) in enumerate(pairwise(found.group.tolist())):
        members = found.order[begin:end]
        group[members] = number
        level[members] = np.searchsorted(found.level, number, side="right") - 1
        assert (np.diff(near[members]) >= 0).all(), "the nearest row of a group comes first"
    nearest = np.array([near[group == one].min() for one in range(len(found.group) - 1)])
    for row, (begin, end) in enumerate(pairwise(dense.rows.first_input.tolist())):
        for other in dense.rows.input[begin:end].tolist():
            if group[row] != group[other]:
                assert level[row] != level[other]
                lower, higher = (row, other) if level[row] < level[other] else (other, row)
                assert nearest[group[lower]] <= nearest[group[higher]]
