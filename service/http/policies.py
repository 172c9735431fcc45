"""`/policies`: what a robot asks while it acts."""

from __future__ import annotations

import gzip
import json
import math
from typing import TYPE_CHECKING, Annotated

from fastapi import APIRouter, Header, Query, Response

from service.acting import AutomatonFormat, automaton, image, run, simulate
from service.http.dependencies import BODY, Cursor, Limit, ServicesDep, page_of, refusals
from service.http.schemas import (
    PolicyList,
    PolicyOut,
    PolicyRow,
    RunRequest,
    RunResponse,
    RunStepOut,
    SimulateRequest,
    SimulateResponse,
    StepCounts,
    StepRequest,
    StepResponse,
)
from service.places import at

if TYPE_CHECKING:  # planning loads SciPy
    from models.planning import Step

router = APIRouter(prefix="/policies", tags=["policies"])

MEDIA_TYPES: dict[AutomatonFormat, str] = {"hoa": "text/plain", "dot": "text/vnd.graphviz", "svg": "image/svg+xml"}


@router.get("", operation_id="listPolicies", responses=refusals("validation"))
def get_policies(services: ServicesDep, cursor: Cursor = "", limit: Limit = 50) -> PolicyList:
    """List the stored policies in order of id."""
    with services.store.read() as transaction:
        found = transaction.policies.page(after=cursor, limit=limit + 1)
    page, cursor_after = page_of(found, limit, lambda entry: entry.id)
    items = [
        PolicyRow(id=entry.id, environment=entry.environment, ltl=entry.ltl, objective=entry.objective)
        for entry in page
    ]
    return PolicyList(items=items, next=cursor_after)


@router.delete(
    "/{policy_id}",
    operation_id="deletePolicy",
    status_code=204,
    response_class=Response,
    responses=refusals("unknown-policy"),
)
def delete_policy(policy_id: str, services: ServicesDep) -> None:
    """Forget a policy. Planning the same again brings it back under the same id."""
    services.forget_policy(policy_id)


@router.get(
    "/{policy_id}",
    operation_id="getPolicy",
    response_model=PolicyOut,
    responses=refusals("unknown-policy"),
)
def get_policy(
    policy_id: str,
    services: ServicesDep,
    accept_encoding: Annotated[str, Header(include_in_schema=False)] = "",
) -> Response:
    """The whole policy as flat arrays."""
    from models.planning import to_json

    stored, policy = services.policy(policy_id)
    asked = {"id": stored.id, "environment": stored.environment, "ltl": stored.ltl, "objective": stored.objective}
    # Straight to text: checking millions of numbers against the schema would cost more than all the rest.
    text = json.dumps(asked | to_json(policy), separators=(",", ":"), ensure_ascii=False, allow_nan=False)
    if "gzip" not in accept_encoding:
        return Response(text, media_type="application/json")
    # Here, in a thread: the middleware would compress megabytes on the event loop.
    packed = gzip.compress(text.encode(), compresslevel=5, mtime=0)
    headers = {"Content-Encoding": "gzip", "Vary": "Accept-Encoding"}
    return Response(packed, media_type="application/json", headers=headers)


@router.get(
    "/{policy_id}/automaton",
    operation_id="getPolicyAutomaton",
    response_class=Response,
    responses={
        200: {
            "content": {media_type: {"schema": {"type": "string"}} for media_type in MEDIA_TYPES.values()},
            "description": "The automaton, in the format that was asked for.",
        },
        **refusals("unknown-policy", "validation", "drawing-too-large", "out-of-time", "overloaded", "spot-missing"),
    },
)
async def get_policy_automaton(
    policy_id: str,
    services: ServicesDep,
    format: Annotated[  # noqa: A002
        AutomatonFormat,
        Query(
            description="`hoa`: Hanoi omega-automata format; `dot`: for Graphviz; `svg`: a picture of up to 20 states"
        ),
    ] = "hoa",
) -> Response:
    """The automaton whose states are the policy's memory."""
    return Response(await automaton(services, policy_id, format), media_type=MEDIA_TYPES[format])


@router.get(
    "/{policy_id}/image",
    operation_id="getPolicyImage",
    response_class=Response,
    responses={
        200: {
            "content": {MEDIA_TYPES["svg"]: {"schema": {"type": "string"}}},
            "description": "A picture that needs nothing else.",
        },
        **refusals("unknown-policy", "validation", "drawing-too-large", "out-of-time", "overloaded", "spot-missing"),
    },
)
async def get_policy_image(
    policy_id: str,
    services: ServicesDep,
    step: Annotated[
        int | None, Query(ge=0, description="Draw things as they are at this step of the run; by default at its end.")
    ] = None,
) -> Response:
    """The most probable run of a policy, drawn as SVG in the world that it was planned in."""
    return Response(await image(services, policy_id, step=step), media_type=MEDIA_TYPES["svg"])


@router.post(
    "/{policy_id}/step",
    operation_id="stepPolicy",
    responses=refusals(*BODY, "unknown-policy", "invalid-state", "invalid-memory"),
)
def post_step(policy_id: str, body: StepRequest, services: ServicesDep) -> StepResponse:
    """What to do now: send the state observed and the memory the last step returned, once per step."""
    _, policy = services.policy(policy_id)
    with at("/state", only={"invalid-state"}), at("/memory", only={"invalid-memory"}):
        return step_out(policy.step(body.state, body.memory))


def step_out(step: Step) -> StepResponse:
    """What to do, as it is answered."""
    return StepResponse(
        action=step.action,
        memory=step.memory,
        probability=step.probability,
        expected_steps=step.expected_steps if math.isfinite(step.expected_steps) else None,
        done=step.done,
        status=step.status,
    )


@router.post(
    "/{policy_id}/simulate",
    operation_id="simulatePolicy",
    responses=refusals(*BODY, "unknown-policy", "invalid-state", "out-of-time", "overloaded"),
)
async def post_simulate(policy_id: str, body: SimulateRequest, services: ServicesDep) -> SimulateResponse:
    """Run the policy many times in the world that it was planned in, whatever its environment has become since."""
    found = await simulate(
        services, policy_id, runs=body.runs, seed=body.seed, max_steps=body.max_steps, state=body.state
    )
    return SimulateResponse(
        runs=body.runs,
        seed=body.seed,
        satisfied=found.satisfied,
        lost=found.lost,
        undecided=found.undecided,
        success_rate=found.success_rate,
        mean_steps=found.mean_steps,
        steps=StepCounts(histogram=[list(bar) for bar in found.steps]),
    )


@router.post(
    "/{policy_id}/run",
    operation_id="runPolicy",
    responses=refusals(*BODY, "unknown-policy", "invalid-state", "invalid-memory", "out-of-time", "overloaded"),
)
async def post_run(policy_id: str, body: RunRequest, services: ServicesDep) -> RunResponse:
    """One run of the policy, step by step, in the world that it was planned in: to be looked at, or replayed."""
    found = await run(
        services, policy_id, seed=body.seed, max_steps=body.max_steps, state=body.state, memory=body.memory
    )
    steps = [
        RunStepOut(
            state={name: dict(attributes) for name, attributes in moment.state.items()},
            memory=moment.memory,
            memory_after=moment.memory_after,
            action=moment.action,
            probability=moment.probability,
            expected_steps=moment.expected_steps if math.isfinite(moment.expected_steps) else None,
            status=moment.status,
        )
        for moment in found
    ]
    return RunResponse(seed=body.seed, status=steps[-1].status, steps=steps)
