"""`/plan`."""

from __future__ import annotations

import math
import time

from fastapi import APIRouter

from models.logic import to_text as formula_text
from service.http.dependencies import BODY, GROUNDING, ServicesDep, refusals
from service.http.schemas import (
    Bounds,
    ModelSize,
    PlanRequest,
    PlanResponse,
    PolicySummary,
    RoundSteps,
    Situation,
    Timing,
    TrajectoryStep,
    VerifiedOut,
)
from service.http.views import answers_in, bindings_out, environment_data, query_in, query_out
from service.pipeline import Planned, PlanOrder, plan

router = APIRouter(tags=["planning"])


@router.post(
    "/plan",
    operation_id="plan",
    responses=refusals(
        *BODY,
        *GROUNDING,
        "unknown-environment",
        "unknown-template",
        "invalid-environment",
        "invalid-state",
        "text-too-long",
        "not-understood",
        "ambiguous-command",
        "wrong-answer",
        "formula-syntax",
        "formula-too-large",
        "model-too-large",
        "device-unavailable",
        "out-of-time",
        "overloaded",
    ),
)
async def post_plan(body: PlanRequest, services: ServicesDep) -> PlanResponse:
    """Plan a command, a contextual query or an LTL formula in an environment."""
    started = time.perf_counter()
    settings, options = services.settings, body.options
    spec = body.environment_spec
    order = PlanOrder(
        text=body.text,
        answers=answers_in(body.answers),
        query=body.contextual_query if body.query is None else query_in(body.query),
        ltl=body.ltl,
        environment=body.environment,
        spec=None if spec is None else environment_data(spec),
        state=body.state,
        translator=body.translator,
        epsilon=options.epsilon,
        timeout_s=min(options.timeout_s, settings.plan_timeout_s),
        max_states=min(options.max_states, settings.max_states),
        device=options.device,
        objective=options.objective,
        verify=options.verify,
        relevance=options.relevance,
    )
    return _plan_out(await plan(services, order), order, time.perf_counter() - started)


def _finite(number: float | None) -> float | None:
    return number if number is not None and math.isfinite(number) else None


def _round_out(steps: tuple[float, float] | None) -> RoundSteps | None:
    return None if steps is None else RoundSteps(lower=steps[0], upper=_finite(steps[1]))


def _verified_out(planned: Planned) -> VerifiedOut | None:
    found = planned.answer.verified
    if found is None:
        return None
    return VerifiedOut(
        probability=found.probability,
        expected_steps=_finite(found.expected_steps),
        sound=found.sound,
        states=found.states,
    )


def _plan_out(planned: Planned, order: PlanOrder, seconds: float) -> PlanResponse:
    answer, meaning = planned.answer, planned.meaning
    steps = [TrajectoryStep(state=state, memory=memory, action=action) for state, memory, action in answer.trajectory]
    policy = None
    if planned.policy_id is not None:
        url = f"/policies/{planned.policy_id}"
        policy = PolicySummary(id=planned.policy_id, url=url, memories=answer.automaton_states, states=answer.states)
    return PlanResponse(
        id=planned.policy_id,
        outcome=answer.outcome,
        objective=order.objective,
        contextual_query=None if meaning.query is None else query_out(meaning.query),
        ltl=formula_text(meaning.formula),
        explanation=meaning.explanation(planned.environment),
        bindings=bindings_out(meaning),
        warnings=list(meaning.warnings),
        environment=planned.environment.name,
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
        verified=_verified_out(planned),
        model=ModelSize(
            states=answer.states,
            product_states=answer.product_states,
            automaton_states=answer.automaton_states,
        ),
        timing=Timing(total_s=round(seconds, 6)),
    )
