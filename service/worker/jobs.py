"""What the worker processes run. Jobs and answers are plain values that pickle."""

from __future__ import annotations

import resource
import time
from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Literal

from models.logic import Formula, PropertyClass, classify, equivalent, parse, to_text
from models.queries import Template, review
from models.world import State, World, explain
from service.worker.child import board
from service.worker.progress import Meter
from service.worker.worlds import read_environment, read_world

if TYPE_CHECKING:  # planning loads SciPy and numba, which the process for formula checks does without
    from models.planning import Policy, Trajectory

Device = Literal["auto", "cpu", "cuda"]
Objective = Literal["max", "min"]
Outcome = Literal["solved", "unsatisfiable", "unreachable"]

NamedState = dict[str, dict[str, str]]
"""object -> attribute -> value."""

SHARES = {"rounds": 0.3, "probability": 0.5, "steps": 0.7, "evaluate": 0.85}
"""Shares of the time for a plan at which the stages end that sweep; the rest is for the policy."""
MAX_STEPS = 1_000
"""Most steps of a trajectory in an answer."""

MOST_BYTES = 8 * 2**30
"""Estimate of memory beyond which a plan is refused before it begins, or where the process may have less, that."""


@dataclass(frozen=True, slots=True)
class PlanJob:
    """Plan for a resolved formula in an environment, given as JSON text, from `state` (partial; None: the initial).
    `verify` asks for the policy to be checked.
    """

    environment: str
    formula: Formula
    state: State | None
    epsilon: float
    max_states: int
    device: Device
    objective: Objective
    verify: bool
    relevance: bool
    timeout_s: float


@dataclass(frozen=True, slots=True)
class Verified:
    """What an evaluation of the policy apart from planning found; the probability is that of the formula."""

    probability: float
    expected_steps: float  # infinite when a run may stay undecided for ever
    sound: bool
    states: int


@dataclass(frozen=True, slots=True)
class PlanAnswer:
    """What planning found; `policy` are the bytes of `models.planning.Policy.to_bytes`, None when there is none."""

    outcome: Outcome
    lower: float
    upper: float
    expected_steps: float | None
    expected_steps_upper: float | None  # infinite when iteration could not bound them
    round_steps: tuple[float, float] | None  # likewise
    initial: NamedState
    initial_memory: int
    trajectory: tuple[tuple[NamedState, int, str | None], ...]  # state, memory before reading it, action
    run_probability: float | None  # of exactly this run
    complete: bool  # the trajectory ends where the goal is satisfied, or will be by going on
    loop: int | None  # the step that the last one repeats
    policy: bytes | None
    verified: Verified | None
    states: int
    product_states: int
    automaton_states: int
    sweeps: int = 0  # of value iteration; this and what follows is not known of answers that older versions stored
    obstacles: tuple[tuple[str, str], ...] = ()  # why the goal is unreachable: formulas, each in English too


@dataclass(frozen=True, slots=True)
class ReviewJob:
    """Review a template that was learned in an environment, given as JSON text."""

    template: Template
    environment: str


def warm_planning() -> None:
    """Load what planning needs, and plan once so that nothing is left to load."""
    from models.planning.warming import warm

    warm()


def warm_logic() -> None:
    """Load Spot."""
    equivalent(parse("F a"), parse("true U a"))


def run_plan(job: PlanJob) -> PlanAnswer:
    """Compile, build the product, and run value iteration; check the policy if that is asked for.

    Each stage stops sweeping after its share of the time, so that there is an answer before the time is up.
    """
    from models.planning import Options, plan, to_bytes

    started = time.monotonic()

    world = read_world(job.environment)
    initial = world.initial if job.state is None else world.encode(job.state)
    options = Options(
        epsilon=job.epsilon,
        max_states=job.max_states,
        max_bytes=_most_bytes(),
        device=job.device,
        objective=job.objective,
        relevance=job.relevance,
        hurry=lambda stage: time.monotonic() - started > SHARES.get(stage, 1.0) * job.timeout_s,
    )
    meter = Meter(board(), ends={stage: started + share * job.timeout_s for stage, share in SHARES.items()})
    found = plan(world, job.formula, initial=initial, options=options, progress=meter)
    run = found.trajectory
    whole = run is not None and len(run.steps) <= MAX_STEPS
    return PlanAnswer(
        outcome=found.outcome,
        lower=found.lower,
        upper=found.upper,
        expected_steps=found.expected_steps,
        expected_steps_upper=found.expected_steps_upper,
        initial=world.decode(initial),
        initial_memory=found.initial_memory,
        round_steps=found.round_steps,
        trajectory=_steps(world, run),
        run_probability=None if run is None else run.probability,
        complete=run is not None and run.complete and whole,
        loop=run.loop if run is not None and whole else None,
        policy=None if found.policy is None else to_bytes(found.policy),
        verified=_verified(world, found.policy, job.objective) if job.verify and found.policy is not None else None,
        states=found.sizes.states,
        product_states=found.sizes.product_states,
        automaton_states=found.sizes.automaton_states,
        sweeps=meter.sweeps,
        obstacles=_explained(found.obstacles, job.environment),
    )


def run_review(job: ReviewJob) -> tuple[str, ...]:
    """The warnings of a template."""
    return review(job.template, read_environment(job.environment))


def run_classification(formula: Formula) -> PropertyClass:
    """The class of a formula."""
    return classify(formula)


def _most_bytes() -> int:
    limit, _ = resource.getrlimit(resource.RLIMIT_AS)
    return MOST_BYTES if limit == resource.RLIM_INFINITY else min(MOST_BYTES, limit)


def _explained(formulas: Sequence[Formula], environment: str) -> tuple[tuple[str, str], ...]:
    return tuple((to_text(formula), explain(formula, read_environment(environment))) for formula in formulas)


def _steps(world: World, trajectory: Trajectory | None) -> tuple[tuple[NamedState, int, str | None], ...]:
    steps = () if trajectory is None else trajectory.steps[:MAX_STEPS]
    return tuple((world.decode(step.state), step.memory, step.action) for step in steps)


def _verified(world: World, policy: Policy, objective: Objective) -> Verified | None:
    """None where the policy's Markov chain cannot be evaluated."""
    from models.planning import UncheckableError, check

    try:
        found = check(world, policy)
    except UncheckableError:
        return None
    goal = found.probability
    return Verified(1.0 - goal if objective == "min" else goal, found.expected_steps, found.sound, found.states)
