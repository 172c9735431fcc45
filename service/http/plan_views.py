"""From plans and jobs to the shapes of responses."""

from __future__ import annotations

import json
import math
from typing import Any

from models.logic import to_text as formula_text
from models.world import Environment
from service.http.problems import problem_of
from service.http.schemas import (
    Bounds,
    JobOut,
    JobProgress,
    JobTiming,
    ModelSize,
    Obstacle,
    PlanResponse,
    PolicySummary,
    RoundSteps,
    Situation,
    Timing,
    TrajectoryStep,
    VerifiedOut,
)
from service.http.schemas.problems import Problem
from service.http.views import bindings_out, query_out, rounded
from service.jobs import Planned, planned
from service.store import StoredJob
from service.understanding import Meaning


def described(meaning: Meaning, environment: Environment, *, objective: str) -> dict[str, Any]:
    """What is known of a plan's answer before planning."""
    return {
        "objective": objective,
        "confidence": rounded(meaning.confidence),
        "contextual_query": None if meaning.query is None else query_out(meaning.query).model_dump(mode="json"),
        "ltl": formula_text(meaning.formula),
        "explanation": meaning.explanation(environment),
        "bindings": [binding.model_dump(mode="json") for binding in bindings_out(meaning)],
        "warnings": list(meaning.warnings),
        "environment": environment.name,
    }


def plan_out(plan: Planned, seconds: float) -> PlanResponse:
    """A plan that took so long."""
    answer = plan.answer
    steps = [TrajectoryStep(state=state, memory=memory, action=action) for state, memory, action in answer.trajectory]
    policy = None
    if plan.policy_id is not None:
        url = f"/policies/{plan.policy_id}"
        policy = PolicySummary(id=plan.policy_id, url=url, memories=answer.automaton_states, states=answer.states)
    return PlanResponse(
        id=plan.policy_id,
        outcome=answer.outcome,
        obstacles=[Obstacle(ltl=ltl, explanation=said) for ltl, said in answer.obstacles],
        probability=Bounds(lower=answer.lower, upper=answer.upper),
        expected_steps=answer.expected_steps,
        expected_steps_upper=_finite(answer.expected_steps_upper),
        round_steps=_round_out(answer.round_steps),
        initial=Situation(state=answer.initial, memory=answer.initial_memory),
        trajectory=steps,
        trajectory_loop=answer.loop,
        trajectory_probability=answer.run_probability,
        trajectory_complete=answer.complete,
        policy=policy,
        verified=_verified_out(plan),
        model=ModelSize(
            states=answer.states,
            product_states=answer.product_states,
            automaton_states=answer.automaton_states,
        ),
        timing=Timing(total_s=round(seconds, 6)),
        **plan.told,
    )


def job_plan_out(job: StoredJob) -> PlanResponse:
    """The plan of a job that succeeded; it took from its acceptance to its end."""
    return plan_out(planned(job), (job.ended_at or job.created_at) - job.created_at)


def job_problem(job: StoredJob) -> Problem:
    """The problem of a job that failed."""
    return problem_of(json.loads(job.error or "{}"))


def job_out(job: StoredJob) -> JobOut:
    """A job with its plan or its problem."""
    return JobOut(
        id=job.id,
        state=job.state,
        url=job_url(job.id),
        environment=job.environment,
        ltl=job.ltl,
        progress=progress_out(job.progress),
        plan=job_plan_out(job) if job.state == "succeeded" else None,
        error=job_problem(job) if job.state == "failed" else None,
        timing=JobTiming(created_at=job.created_at, ended_at=job.ended_at),
    )


def progress_out(progress: str | None) -> JobProgress:
    """How far a plan is; nothing where its job has said nothing yet."""
    return JobProgress() if progress is None else JobProgress.model_validate_json(progress)


def job_url(job_id: str) -> str:
    """The path of a job."""
    return f"/jobs/{job_id}"


def _finite(number: float | None) -> float | None:
    return number if number is not None and math.isfinite(number) else None


def _round_out(steps: tuple[float, float] | None) -> RoundSteps | None:
    return None if steps is None else RoundSteps(lower=steps[0], upper=_finite(steps[1]))


def _verified_out(plan: Planned) -> VerifiedOut | None:
    found = plan.answer.verified
    if found is None:
        return None
    return VerifiedOut(
        probability=found.probability,
        expected_steps=_finite(found.expected_steps),
        sound=found.sound,
        states=found.states,
    )
