"""The most probable run of a policy that satisfies the formula.

A shortest path by -log p over the Markov chain of the policy.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from models.logic import Automaton
from models.planning.chain import Chain
from models.planning.kernels import runs
from models.planning.lasso import bottoms, circle
from models.planning.policy import Policy

MAX_LENGTH = 10_000
"""Most steps of a trajectory, not counting the one at which it ends satisfied; and of the loop at its end."""

STEP_COST = 1e-9
"""What a step costs beside -log p: more than the rounding of the sums, so that no step is free and the shorter of
equally probable runs is the cheaper one."""


@dataclass(frozen=True, slots=True)
class TrajectoryStep:
    """A state, the memory before its label is read, and the action done there (None where the run ends or the
    world enables none)."""

    state: int
    memory: int
    action: str | None


@dataclass(frozen=True, slots=True)
class Trajectory:
    """The most probable run, from the initial state and memory, in which the policy satisfies the formula.

    Of all runs that end satisfied it is the single most probable one; that alone may be improbable where many
    runs share the probability. Of equally probable runs it is a shortest (a run counts as equal within a
    relative 1e-9 for each step that it is longer). It never visits a state twice with the same memory.

    `complete`: the run comes to where the formula is satisfied, or will be if the policy goes on for ever. In the
    latter case it goes on into a circle that satisfies the formula for ever: the last step repeats step `loop`.
    Otherwise the run was longer than MAX_LENGTH steps and only those are here; or, after a plan that was cut short by
    `max_sweeps` or in a chain too large to explore, no run that satisfies the formula was found, and there is only the
    initial step. `probability` is the product of the probabilities of the outcomes from each step to the next, until
    the formula is satisfied or only has to be kept up: 1 for a single step.
    """

    steps: tuple[TrajectoryStep, ...]
    complete: bool
    probability: float
    loop: int | None = None


def most_probable_run(chain: Chain, policy: Policy, automaton: Automaton) -> Trajectory:
    """The trajectory of a policy, by its chain. Deterministic."""
    sustaining = policy.sustaining(chain.state, chain.after)
    satisfied = policy.accepted[chain.after] | sustaining
    cost = STEP_COST - np.log(chain.probability)
    nodes, outcomes = _cheapest_path(chain, satisfied, cost)
    complete = len(nodes) <= MAX_LENGTH + 1 and bool(satisfied[nodes[-1]])
    nodes, outcomes = nodes[: MAX_LENGTH + complete], outcomes[: MAX_LENGTH + complete - 1]
    loop = None
    if sustaining[nodes[-1]]:
        around = circle(chain, bottoms(chain, policy, automaton), nodes[-1], cost)
        if around is not None and len(around[0]) <= MAX_LENGTH:
            nodes, loop = [*nodes, *around[0]], len(nodes) - 1 + around[1]
    memories = [policy.initial_memory, *(int(chain.after[node]) for node in nodes[:-1])]
    steps = tuple(
        TrajectoryStep(int(chain.state[node]), memory, _name(policy, int(chain.action[node])))
        for node, memory in zip(nodes, memories, strict=True)
    )
    return Trajectory(steps, complete, float(np.prod(chain.probability[outcomes])), loop)


def _name(policy: Policy, action: int) -> str | None:
    return policy.actions[action] if action >= 0 else None


def _cheapest_path(
    chain: Chain, satisfied: NDArray[np.bool_], cost: NDArray[np.float64]
) -> tuple[list[int], list[int]]:
    """The nodes from the initial one to one that is satisfied, and the outcomes between them; only the initial one if
    there is no path.
    """
    if satisfied[0] or not satisfied.any():
        return [0], []
    path, end = runs.cheapest_path(chain.first, chain.target, cost, 0, satisfied)
    outcomes = path[::-1]
    return ([0], []) if end < 0 else ([0, *chain.target[outcomes].tolist()], outcomes.tolist())
