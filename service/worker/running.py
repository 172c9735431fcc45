"""One run of a stored policy in the world that it was planned in, as data or as a picture."""

from __future__ import annotations

from dataclasses import dataclass
from functools import lru_cache
from typing import TYPE_CHECKING

from models.world import State
from models.world.picture import picture, to_svg
from service.worker.worlds import read_environment, read_world

if TYPE_CHECKING:
    from models.planning import Policy


@dataclass(frozen=True, slots=True)
class RunJob:
    """Run a policy, given as its bytes, in a world, given as JSON text, from `state` and `memory`; None: where its plan
    began.
    """

    world: str
    policy: bytes
    seed: int
    max_steps: int
    state: State | None
    memory: int | None


@dataclass(frozen=True, slots=True)
class RunMoment:
    """A step of a run; `memory` is the one before the label of the state is read."""

    state: State
    memory: int
    memory_after: int
    action: str | None
    probability: float
    expected_steps: float
    status: str


@dataclass(frozen=True, slots=True)
class PictureJob:
    """Draw the most probable run of a policy, with things as they are at a step of it; None: at its end."""

    world: str
    policy: bytes
    step: int | None


def run_run(job: RunJob) -> tuple[RunMoment, ...]:
    """The run; the seed decides everything. Raises StateError and InvalidMemoryError."""
    from models.planning import run

    policy = _read_policy(job.policy)
    state = None if job.state is None else policy.encode(job.state)
    found = run(read_world(job.world), policy, seed=job.seed, max_steps=job.max_steps, state=state, memory=job.memory)
    return tuple(
        RunMoment(
            state=policy.decode(moment.state),
            memory=moment.memory,
            memory_after=moment.step.memory,
            action=moment.step.action,
            probability=moment.step.probability,
            expected_steps=moment.step.expected_steps,
            status=moment.step.status,
        )
        for moment in found
    )


def run_picture(job: PictureJob) -> str:
    """The SVG."""
    from models.planning import likeliest_run

    policy, environment = _read_policy(job.policy), read_environment(job.world)
    steps = likeliest_run(read_world(job.world), policy).steps
    last = len(steps) - 1
    shown = last if job.step is None else min(job.step, last)
    caption = f"step {shown} of {last}"
    if (action := steps[shown].action) is not None:
        caption += f", then {action}"
    states = [policy.decode(step.state) for step in steps]
    return to_svg(picture(environment, states[shown], run=states, caption=caption))


@lru_cache(maxsize=2)
def _read_policy(data: bytes) -> Policy:
    from models.planning import from_bytes

    return from_bytes(data)
