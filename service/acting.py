"""The use cases of a stored policy that need a worker process: its simulation, its automaton as a picture."""

from __future__ import annotations

from typing import Literal

import numpy as np
from anyio.to_thread import run_sync

from models.logic.drawing import MAX_STATES
from models.world import State
from service.errors import DrawingTooLargeError
from service.places import at
from service.services import Services
from service.worker import DrawingJob, SimulationAnswer, SimulationJob, run_drawing, run_simulation

AutomatonFormat = Literal["hoa", "dot", "svg"]


async def simulate(
    services: Services, policy_id: str, *, runs: int, seed: int, max_steps: int, state: State | None
) -> SimulationAnswer:
    """Run a policy in the very world it was planned in; what `state` leaves out is as where its plan began."""
    stored, _ = await run_sync(services.policy, policy_id)
    job = SimulationJob(stored.world, stored.data, runs, seed, max_steps, state)
    with at("/state", only={"invalid-state"}):
        return await services.workers.plan(run_simulation, job, timeout_s=services.settings.plan_timeout_s)


async def automaton(services: Services, policy_id: str, form: AutomatonFormat) -> str:
    """The automaton whose states are a policy's memory. Spot, and the layout of a picture, run in a worker process."""
    _, policy = await run_sync(services.policy, policy_id)
    if form == "hoa":
        return policy.hoa
    if form == "svg" and policy.memories > MAX_STATES:
        with at("/query/format"):
            raise DrawingTooLargeError(
                f"the automaton has {policy.memories} states, and a picture at most {MAX_STATES}; take dot or hoa"
            )
    accepting, rejecting = policy.accepted, (policy.row < 0) & ~policy.accepted
    job = DrawingJob(
        hoa=policy.hoa,
        formula=policy.formula,
        accepting=frozenset(np.flatnonzero(accepting).tolist()),
        rejecting=frozenset(np.flatnonzero(rejecting).tolist()),
        format=form,
    )
    return await services.workers.check(run_drawing, job, timeout_s=services.settings.logic_timeout_s)
