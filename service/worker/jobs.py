"""What the worker processes run. Jobs and answers are plain values that pickle."""

from __future__ import annotations

import json
from dataclasses import dataclass
from functools import lru_cache
from typing import TYPE_CHECKING, Literal

from models.logic import Formula, equivalent, parse
from models.queries import Template, review
from models.world import Environment, State, World, compile_world, load_environment

if TYPE_CHECKING:  # planning loads torch, which the process for formula checks does without
    from models.planning import Trajectory

Device = Literal["auto", "cpu", "cuda"]
Outcome = Literal["solved", "unsatisfiable", "unreachable"]

NamedState = dict[str, dict[str, str]]
"""object -> attribute -> value."""

MAX_STEPS = 1_000
"""Most steps of a trajectory in an answer."""


@dataclass(frozen=True, slots=True)
class PlanJob:
    """Plan for a resolved formula in an environment, given as JSON text, from `state` (partial; None: the initial)."""

    environment: str
    formula: Formula
    state: State | None
    epsilon: float
    max_states: int
    device: Device


@dataclass(frozen=True, slots=True)
class PlanAnswer:
    """What planning found; `policy` are the bytes of `models.planning.Policy.to_bytes`, None when there is none."""

    outcome: Outcome
    lower: float
    upper: float
    expected_steps: float | None
    expected_steps_upper: float | None  # infinite when iteration could not bound them
    initial: NamedState
    initial_memory: int
    trajectory: tuple[tuple[NamedState, int, str | None], ...]  # state, memory before reading it, action
    run_probability: float | None  # of exactly this run
    complete: bool  # the trajectory ends where the formula is satisfied
    policy: bytes | None
    states: int
    product_states: int
    automaton_states: int


@dataclass(frozen=True, slots=True)
class ReviewJob:
    """Review a template that was learned in an environment, given as JSON text."""

    template: Template
    environment: str


def warm_planning() -> None:
    """Load what planning needs, and plan once so that nothing is left to load."""
    from models.planning import Options, plan
    from models.world import toys_spec

    world = compile_world(load_environment(toys_spec(columns=2, rows=1, toys=[("sphere", "red")], slip=0.1)))
    plan(world, parse("F holding(sphere)"), options=Options())


def warm_logic() -> None:
    """Load Spot."""
    equivalent(parse("F a"), parse("true U a"))


def run_plan(job: PlanJob) -> PlanAnswer:
    """Compile, build the product, and run value iteration."""
    from models.planning import Options, plan, to_bytes

    world = _world(job.environment)
    initial = world.initial if job.state is None else world.encode(job.state)
    options = Options(epsilon=job.epsilon, max_states=job.max_states, device=job.device)
    found = plan(world, job.formula, initial=initial, options=options)
    return PlanAnswer(
        outcome=found.outcome,
        lower=found.lower,
        upper=found.upper,
        expected_steps=found.expected_steps,
        expected_steps_upper=found.expected_steps_upper,
        initial=world.decode(initial),
        initial_memory=found.initial_memory,
        trajectory=_steps(world, found.trajectory),
        run_probability=None if found.trajectory is None else found.trajectory.probability,
        complete=found.trajectory is not None
        and found.trajectory.complete
        and len(found.trajectory.steps) <= MAX_STEPS,
        policy=None if found.policy is None else to_bytes(found.policy),
        states=found.sizes.states,
        product_states=found.sizes.product_states,
        automaton_states=found.sizes.automaton_states,
    )


def run_review(job: ReviewJob) -> tuple[str, ...]:
    """The warnings of a template."""
    return review(job.template, _environment(job.environment))


def _steps(world: World, trajectory: Trajectory | None) -> tuple[tuple[NamedState, int, str | None], ...]:
    steps = () if trajectory is None else trajectory.steps[:MAX_STEPS]
    return tuple((world.decode(step.state), step.memory, step.action) for step in steps)


@lru_cache(maxsize=16)
def _environment(text: str) -> Environment:
    return load_environment(json.loads(text))


@lru_cache(maxsize=4)
def _world(text: str) -> World:
    return compile_world(_environment(text))
