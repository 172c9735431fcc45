"""Solvers of explicit MDPs: value iteration on the matrices of the world in which goal states are absorbing.

The matrices are made beforehand, as sparse as each solver takes them, over the valid states of the world; "set-up" is
what the solver does with them before it solves.
"""

from __future__ import annotations

import contextlib
import io
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray
from scipy import sparse

from benchmarks.planning.cases import Case, Toys
from benchmarks.planning.run import Limits, Run
from benchmarks.planning.toys import goal_atoms, resolved
from models.world import World

EPSILON = 1e-6
"""The change in a sweep at which a solver stops."""
DISCOUNT = 1 - 1e-8
"""mdpsolver takes no 1; so near to it a value of some steps is off by less than 1e-6 of itself."""
LOOK_AHEAD = 5
"""mdpsolver's sweeps for each policy: of 1, 5, 10, 20 and 100, and of its other methods, the quickest here."""


@dataclass(frozen=True, slots=True, eq=False)
class Matrices:
    """Valid states by number; `actions` gives for each action where it is possible, and [k, n] outcomes there."""

    world: World
    states: NDArray[np.int64]
    goal: NDArray[np.bool_]
    number: NDArray[np.int64]  # [world.size]

    @property
    def initial(self) -> int:
        return int(self.number[self.world.initial])

    def actions(self) -> Iterator[tuple[NDArray[np.int64], NDArray[np.float64], NDArray[np.int64]]]:
        for action in range(len(self.world.actions)):
            outcomes = self.world.outcomes(action, self.states)
            at = np.flatnonzero(outcomes.enabled & ~self.goal)
            yield at, outcomes.probability[:, at], self.number[outcomes.successor[:, at]]


def matrices(case: Case) -> Matrices:
    """What both solvers are given, in no format yet."""
    assert isinstance(case, Toys)
    environment, _ = resolved(case)
    world = environment.world
    states = np.flatnonzero(world.valid()).astype(np.int64)
    number = np.full(world.size, -1, dtype=np.int64)
    number[states] = np.arange(len(states))
    goal = np.logical_and.reduce(world.labels(goal_atoms(case, environment), states))
    return Matrices(world, states, goal, number)


def mdpsolver_run(case: Case, _limits: Limits) -> Callable[[], Run]:
    """mdpsolver: modified policy iteration with Gauss-Seidel updates."""
    import mdpsolver

    found = matrices(case)
    chances, columns, rewards = _lists(found)
    count, initial = len(found.states), found.initial
    del found

    def run() -> Run:
        result = Run(notes={"states": count})
        model = mdpsolver.model()
        with result.timed("set-up"):
            model.mdp(discount=DISCOUNT, rewards=rewards, tranMatProbs=chances, tranMatColumns=columns)
        with result.timed("solve"):
            model.solve(
                algorithm="mpi",
                update="gs",
                parIterLim=LOOK_AHEAD,
                tolerance=EPSILON / (1 - DISCOUNT),
                initValueVector=[0.0] * count,
                makeFinalCheck=False,
            )
            model.getPolicy()
        result.value("steps", -model.getValue(initial))
        return result

    return run


def _lists(found: Matrices) -> tuple[list[Any], list[Any], list[Any]]:
    """Probabilities and successors by state and choice, and what each choice earns."""
    chances: list[list[list[float]]] = [[] for _ in found.states]
    columns: list[list[list[int]]] = [[] for _ in found.states]
    for states, probability, successor in found.actions():
        happens = probability.T > 0
        ends = np.cumsum(happens.sum(axis=1)).tolist()
        flat, targets = probability.T[happens].tolist(), successor.T[happens].tolist()
        begin = 0
        for state, end in zip(states.tolist(), ends, strict=True):
            chances[state].append(flat[begin:end])
            columns[state].append(targets[begin:end])
            begin = end
    for state in np.flatnonzero(found.goal).tolist():
        chances[state], columns[state] = [[1.0]], [[state]]
    rewards = [[0.0 if done else -1.0] * len(of) for of, done in zip(chances, found.goal.tolist(), strict=True)]
    return chances, columns, rewards


def pymdptoolbox_run(case: Case, _limits: Limits) -> Callable[[], Run]:
    """pymdptoolbox: value iteration; an action that is not possible stays, at the cost of a step.

    Without its check of the matrices, which makes dense ones of them: 42 s and 2.8 GB for 11,000 states.
    """
    import mdptoolbox.util
    from mdptoolbox.mdp import ValueIteration

    mdptoolbox.util.check = lambda _transitions, _rewards: None

    found = matrices(case)
    transitions = [_square(*action, len(found.states)) for action in found.actions()]
    rewards = np.repeat(np.where(found.goal, 0.0, -1.0)[:, None], len(transitions), axis=1)
    initial = found.initial
    del found

    def run() -> Run:
        result = Run(notes={"states": len(rewards)})
        with contextlib.redirect_stdout(io.StringIO()):  # it warns of no discount
            with result.timed("set-up"):
                solver = ValueIteration(transitions, rewards, 1.0, epsilon=EPSILON, max_iter=10**6)
            with result.timed("solve"):
                solver.run()
        result.value("steps", -solver.V[initial])
        return result

    return run


def _square(
    at: NDArray[np.int64], probability: NDArray[np.float64], successor: NDArray[np.int64], count: int
) -> sparse.csr_matrix[Any]:
    """[count, count] one action."""
    still = np.setdiff1d(np.arange(count), at)
    rows = np.concatenate([np.broadcast_to(at, successor.shape).reshape(-1), still])
    columns = np.concatenate([successor.reshape(-1), still])
    values = np.concatenate([probability.reshape(-1), np.ones(len(still))])
    happens = values > 0
    return sparse.csr_matrix((values[happens], (rows[happens], columns[happens])), shape=(count, count))
