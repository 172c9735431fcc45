"""`/plan`."""

from __future__ import annotations

import time
from functools import partial

from fastapi import APIRouter, Response
from fastapi.responses import JSONResponse

from service.http.dependencies import BODY, GROUNDING, ServicesDep, refusals
from service.http.idempotency import SLUGS, KeyHeader, once_of
from service.http.plan_views import described, job_out, job_plan_out, job_problem, job_url, plan_out
from service.http.preferences import PreferHeader, wait_of
from service.http.problems import response_of
from service.http.schemas import JobOut, PlanRequest, PlanResponse
from service.http.views import answers_in, environment_data, query_in
from service.jobs import OPERATION
from service.logs import JOB_ID
from service.pipeline import PlanOrder, plan
from service.store import StoredJob

router = APIRouter(tags=["planning"])


@router.post(
    "/plan",
    operation_id="plan",
    responses={
        202: {
            "model": JobOut,
            "description": "The plan takes longer than the request waits, and is made as a job.",
            "headers": {
                "Location": {"schema": {"type": "string"}, "description": "The job."},
                "Retry-After": {"schema": {"type": "integer"}, "description": "Seconds until it is worth asking."},
                "Preference-Applied": {"schema": {"type": "string"}, "description": "What of `Prefer` was done."},
            },
        },
        **refusals(
            *BODY,
            *SLUGS,
            "insufficient-storage",
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
            "out-of-memory",
            "overloaded",
            "worker-died",
        ),
    },
)
async def post_plan(
    body: PlanRequest,
    services: ServicesDep,
    response: Response,
    prefer: PreferHeader = "",
    idempotency_key: KeyHeader = None,
) -> PlanResponse:
    """Plan a command, a contextual query or an LTL formula in an environment.

    What takes longer than the request waits is answered with a job.
    """
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
    wait = wait_of(prefer, default_s=settings.wait_s, longest_s=settings.max_wait_s)
    headers = {} if wait.applied is None else {"Preference-Applied": wait.applied}
    found = await plan(
        services,
        order,
        partial(described, objective=options.objective),
        wait_s=wait.seconds,
        once=once_of(OPERATION, idempotency_key, body),
    )
    response.headers.update(headers)
    if not isinstance(found, StoredJob):
        return plan_out(found, time.perf_counter() - started)
    JOB_ID.set(found.id)
    waited = wait.seconds > 0  # who does not wait gets the job, also one that has ended in the meantime
    if waited and found.state == "succeeded":
        return job_plan_out(found)
    if waited and found.state == "failed":
        return response_of(job_problem(found))  # type: ignore[return-value]  # FastAPI passes responses on
    headers |= {"Location": job_url(found.id), "Retry-After": "1"}
    return JSONResponse(job_out(found).model_dump(mode="json"), status_code=202, headers=headers)  # type: ignore[return-value]
