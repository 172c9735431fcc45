"""Seeded runs of a policy in the world itself, not in the planner's product.

A run ends where the policy says that the formula holds if it goes on: `check` tells whether that is so.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from models.planning.policy import NOTHING, Policy
from models.world import World

MAX_STEPS = 10_000
"""Default length at which a run that is still undecided ends."""


@dataclass(frozen=True, slots=True, eq=False)
class Simulation:
    """How each run ended."""

    satisfied: NDArray[np.bool_]  # [runs]  the formula holds, or will if the policy goes on for ever
    decided: NDArray[np.bool_]  # [runs]  that, or it cannot be any more; else the run was cut off
    steps: NDArray[np.int64]  # [runs]  actions done until then

    @property
    def success_rate(self) -> float:
        """The share of runs that satisfied the formula."""
        return float(self.satisfied.mean())

    @property
    def mean_steps(self) -> float:
        """Mean number of steps until the outcome was decided, or the run cut off."""
        return float(self.steps.mean())


def simulate(
    world: World,
    policy: Policy,
    *,
    runs: int,
    seed: int,
    initial: int | None = None,
    max_steps: int = MAX_STEPS,
) -> Simulation:
    """Run `policy` from `initial` (default: the policy's initial state) `runs` times; the seed decides
    everything.
    """
    generator = np.random.default_rng(seed)
    state = np.full(runs, policy.initial_state if initial is None else initial, dtype=np.int64)
    memory = np.full(runs, policy.initial_memory, dtype=np.int32)
    steps = np.zeros(runs, dtype=np.int64)
    decided = np.zeros(runs, dtype=np.bool_)
    satisfied = np.zeros(runs, dtype=np.bool_)
    active = np.arange(runs)
    for done in range(max_steps + 1):
        memory[active] = policy.after(state[active], memory[active])
        action = policy.acting(state[active], memory[active])
        sustaining = policy.sustaining(state[active], memory[active])
        satisfied[active] = policy.accepted[memory[active]] | sustaining
        ended = (action == NOTHING) | sustaining
        decided[active[ended]] = True
        steps[active] = done
        active, action = active[~ended], action[~ended]
        if not len(active) or done == max_steps:
            break
        state[active] = enter(world, state[active], action, generator.random(len(active)))
    return Simulation(satisfied, decided, steps)


def enter(
    world: World, state: NDArray[np.int64], action: NDArray[np.int64], chance: NDArray[np.float64]
) -> NDArray[np.int64]:
    """The state that each run enters; `chance` is uniform in [0, 1). Without an action the state stays."""
    entered = state.copy()
    for number in np.unique(action[action >= 0]):
        chosen = np.flatnonzero(action == number)
        answer = world.outcomes(int(number), state[chosen])
        total = np.cumsum(answer.probability, axis=0)  # [k, m]
        last = len(total) - 1 - np.argmax(answer.probability[::-1] > 0, axis=0)
        outcome = np.minimum((chance[chosen] >= total).sum(axis=0), last)
        entered[chosen] = answer.successor[outcome, np.arange(len(chosen))]
    return entered
