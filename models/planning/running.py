"""Single runs of a policy: one drawn by lot, and the most probable one worked out again."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from models.logic import parse, translate
from models.planning.chain import explore
from models.planning.policy import Policy, Step
from models.planning.simulation import enter
from models.planning.trajectory import Trajectory, most_probable_run
from models.world import World

MOST_STATES = 200_000
"""Largest chain in which the most probable run is looked for."""


@dataclass(frozen=True, slots=True)
class RunStep:
    """A state by its index, the memory before its label is read, and what the policy says there."""

    state: int
    memory: int
    step: Step


def run(
    world: World, policy: Policy, *, seed: int, max_steps: int, state: int | None = None, memory: int | None = None
) -> tuple[RunStep, ...]:
    """One run of `policy`, from `state` with `memory` (default: where its plan began), until it is satisfied or lost.

    Outcomes are drawn by lot; the seed decides everything. The last step is the one after `max_steps` actions where the
    run goes on for longer. Raises StateError and InvalidMemoryError.
    """
    generator = np.random.default_rng(seed)
    here = policy.initial_state if state is None else state
    now = policy.initial_memory if memory is None else memory
    steps: list[RunStep] = []
    while True:
        found = policy.step(here, now)
        steps.append(RunStep(here, now, found))
        if found.status in ("satisfied", "lost") or len(steps) > max_steps:
            return tuple(steps)
        if found.action is not None:
            action = np.array([policy.actions.index(found.action)])
            here = int(enter(world, np.array([here], dtype=np.int64), action, generator.random(1))[0])
        now = found.memory


def likeliest_run(world: World, policy: Policy) -> Trajectory:
    """The trajectory of a policy's plan, from the policy alone; see `most_probable_run`.

    In a chain of more than MOST_STATES states it may be only the first step. Raises FormulaTooLargeError and
    SpotMissingError (the formula's automaton is made again).
    """
    chain = explore(world, policy, most=MOST_STATES)
    return most_probable_run(chain, policy, translate(parse(policy.formula)))
