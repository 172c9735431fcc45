"""Worlds for tests: explicit arrays behind the World protocol, written without the code under test."""

from __future__ import annotations

import random
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field

import numpy as np
import torch
from numpy.typing import NDArray

from models.logic import Atom
from models.planning.options import Device
from models.world import ExplicitWorld, Outcomes, State, Variable
from models.world import Transitions as Listed

DEVICES: list[Device] = ["cpu", "cuda"] if torch.cuda.is_available() else ["cpu"]
"""Where sweeps can run on this machine."""

Transitions = Mapping[int, Mapping[str, Mapping[int, float]]]
"""state -> action -> successor -> probability."""


@dataclass(frozen=True, eq=False)
class ArrayWorld:
    """A world of `size` states, one variable, nullary labels."""

    size: int
    transitions: Transitions
    holds: Mapping[str, frozenset[int]]
    initial: int = 0
    forbidden: frozenset[int] = frozenset()
    name: str = "arrays"
    actions: tuple[str, ...] = field(init=False)
    variables: tuple[Variable, ...] = field(init=False)

    def __post_init__(self) -> None:
        names = dict.fromkeys(name for choices in self.transitions.values() for name in choices)
        object.__setattr__(self, "actions", tuple(names))
        values = tuple(str(state) for state in range(self.size))
        object.__setattr__(self, "variables", (Variable("world", "state", values),))

    def _states(self, states: NDArray[np.int64] | None) -> list[int]:
        return list(range(self.size)) if states is None else states.tolist()

    def valid(self, states: NDArray[np.int64] | None = None) -> NDArray[np.bool_]:
        return np.array([s not in self.forbidden for s in self._states(states)], dtype=np.bool_)

    def encode(self, state: State, *, base: int | None = None) -> int:
        return int(state["world"]["state"]) if state else self.initial if base is None else base

    def decode(self, index: int) -> dict[str, dict[str, str]]:
        return {"world": {"state": str(index)}}

    def labels(self, atoms: Sequence[Atom], states: NDArray[np.int64] | None = None) -> NDArray[np.bool_]:
        wanted = self._states(states)
        rows = [[s in self.holds[atom.function] for s in wanted] for atom in atoms]
        return np.array(rows, dtype=np.bool_).reshape(len(atoms), len(wanted))

    listed = None

    def cost(self, action: int, states: NDArray[np.int64] | None = None) -> NDArray[np.float64]:
        return np.ones(len(self._states(states)))

    def outcomes(self, action: int, states: NDArray[np.int64] | None = None) -> Outcomes:
        wanted = self._states(states)
        name = self.actions[action]
        rows = [self.transitions.get(s, {}).get(name, {}) for s in wanted]
        width = max([len(row) for row in rows], default=0) or 1
        probability = np.zeros((width, len(wanted)))
        successor = np.tile(np.array(wanted, dtype=np.int64), (width, 1))
        for column, row in enumerate(rows):
            for k, (target, chance) in enumerate(row.items()):
                probability[k, column], successor[k, column] = chance, target
        return Outcomes(np.array([bool(row) for row in rows], dtype=np.bool_), probability, successor)


def random_world(seed: int, *, states: int | None = None, atoms: str = "ab") -> ArrayWorld:
    """A random MDP with self-loops, traps, end components, unreachable parts and states without actions."""
    pick = random.Random(seed)
    size = states or pick.choice([1, 3, 5, 8, 12, 18, 24])
    transitions: dict[int, dict[str, dict[int, float]]] = {}
    stuck = {state for state in range(size) if state == size - 1 or pick.random() < 0.25}
    for state in range(size):
        actions = pick.sample(["p", "q", "r", "s"], 0 if state in stuck else pick.choice([1, 1, 1, 2, 2, 3, 4]))
        transitions[state] = {}
        for action in sorted(actions):
            targets = pick.sample(range(size), min(size, pick.choice([1, 2, 3, 3])))
            if pick.random() < 0.2:
                targets[0] = state
            if pick.random() < 0.2:
                targets[-1] = size - 1
            weights = [pick.choice([1, 1, 2, 5, 0.25]) for _ in set(targets)]
            total = sum(weights)
            transitions[state][action] = {t: w / total for t, w in zip(dict.fromkeys(targets), weights, strict=True)}
    holds = {name: frozenset(s for s in range(size - 1) if pick.random() < 0.2) for name in atoms}
    return ArrayWorld(size, transitions, holds, initial=pick.choice(sorted(set(range(size)) - stuck) or [0]))


def listed(world: ArrayWorld) -> ExplicitWorld:
    """The same world with its transitions listed; without forbidden states."""
    assert not world.forbidden
    choices = [
        (state, number, world.transitions[state][name])
        for state in range(world.size)
        for number, name in enumerate(world.actions)
        if name in world.transitions.get(state, {})
    ]
    counts = np.bincount([state for state, _, _ in choices], minlength=world.size)
    transitions = Listed(
        first_choice=np.cumsum([0, *counts]).astype(np.int32),
        action=np.array([number for _, number, _ in choices], dtype=np.int32),
        cost=np.ones(len(choices)),
        first_outcome=np.cumsum([0, *(len(move) for _, _, move in choices)]).astype(np.int32),
        successor=np.array([target for _, _, move in choices for target in move], dtype=np.int32),
        probability=np.array([chance for _, _, move in choices for chance in move.values()]),
    )
    labels = {name: np.array(sorted(states), dtype=np.int64) for name, states in world.holds.items()}
    return ExplicitWorld(
        world.name, initial=world.initial, actions=world.actions, labels=labels, transitions=transitions
    )
