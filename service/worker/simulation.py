"""Running a stored policy in the world that it was planned in."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from models.world import State
from service.worker.worlds import read_world


@dataclass(frozen=True, slots=True)
class SimulationJob:
    """Run a policy, given as its bytes, in a world, given as JSON text, from `state`; None: where its plan began."""

    world: str
    policy: bytes
    runs: int
    seed: int
    max_steps: int
    state: State | None


@dataclass(frozen=True, slots=True)
class SimulationAnswer:
    """How the runs ended; `steps` are the numbers of steps that occurred, ascending, with how many runs had each."""

    satisfied: int
    lost: int
    undecided: int
    success_rate: float
    mean_steps: float
    steps: tuple[tuple[int, int], ...]


def run_simulation(job: SimulationJob) -> SimulationAnswer:
    """Run the policy; the seed decides everything. Raises StateError."""
    from models.planning import from_bytes, simulate

    policy = from_bytes(job.policy)
    initial = None if job.state is None else policy.encode(job.state)
    found = simulate(
        read_world(job.world), policy, runs=job.runs, seed=job.seed, initial=initial, max_steps=job.max_steps
    )
    satisfied, decided = int(found.satisfied.sum()), int(found.decided.sum())
    return SimulationAnswer(
        satisfied=satisfied,
        lost=decided - satisfied,
        undecided=job.runs - decided,
        success_rate=found.success_rate,
        mean_steps=found.mean_steps,
        steps=tuple(zip(*(part.tolist() for part in np.unique(found.steps, return_counts=True)), strict=True)),
    )
