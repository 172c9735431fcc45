"""The use cases of a stored policy that need a worker process: its runs, its pictures."""

from __future__ import annotations

from typing import Literal

import numpy as np
from anyio.to_thread import run_sync

from models.logic.drawing import MAX_STATES
from models.world import Environment, State
from models.world.picture import MOST_CELLS, picture, size_of, to_svg
from service.errors import DrawingTooLargeError
from service.places import at
from service.services import Services
from service.worker import (
    DrawingJob,
    PictureJob,
    RunJob,
    RunMoment,
    SimulationAnswer,
    SimulationJob,
    run_drawing,
    run_picture,
    run_run,
    run_simulation,
)

AutomatonFormat = Literal["hoa", "dot", "svg"]


async def simulate(
    services: Services, policy_id: str, *, runs: int, seed: int, max_steps: int, state: State | None
) -> SimulationAnswer:
    """Run a policy in the very world it was planned in; what `state` leaves out is as where its plan began."""
    stored, _ = await run_sync(services.policy, policy_id)
    job = SimulationJob(stored.world, stored.data, runs, seed, max_steps, state)
    with at("/state", only={"invalid-state"}):
        return await services.workers.plan(run_simulation, job, timeout_s=services.settings.plan_timeout_s)


async def run(
    services: Services, policy_id: str, *, seed: int, max_steps: int, state: State | None, memory: int | None
) -> tuple[RunMoment, ...]:
    """One run in the very world it was planned in; what `state` leaves out is as where its plan began."""
    stored, _ = await run_sync(services.policy, policy_id)
    job = RunJob(stored.world, stored.data, seed, max_steps, state, memory)
    with at("/state", only={"invalid-state"}), at("/memory", only={"invalid-memory"}):
        return await services.workers.plan(run_run, job, timeout_s=services.settings.plan_timeout_s)


async def image(services: Services, policy_id: str, *, step: int | None) -> str:
    """The most probable run as a picture, SVG."""
    stored, _ = await run_sync(services.policy, policy_id)
    environment = await run_sync(services.parsed, stored.world)
    refuse_large(environment.value)
    job = PictureJob(stored.world, stored.data, step)
    return await services.workers.plan(run_picture, job, timeout_s=services.settings.plan_timeout_s)


def world_image(environment: Environment, state: State | None) -> str:
    """An environment in a state, SVG; what the state leaves out is as in the initial one."""
    refuse_large(environment)
    world = environment.world
    with at("/query/state"):
        index = world.initial if state is None else world.encode(state)
    return to_svg(picture(environment, world.decode(index)))


def refuse_large(environment: Environment) -> None:
    """Raise `DrawingTooLargeError` for a world of which a picture would show nothing."""
    if size_of(environment) > MOST_CELLS:
        raise DrawingTooLargeError(
            f"the world has {size_of(environment)} cells or things, and a picture at most {MOST_CELLS}"
        )


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
