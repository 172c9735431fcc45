"""`/policies`: what a robot asks while it acts."""

from __future__ import annotations

import gzip
import json
import math
from typing import Annotated, Literal

from fastapi import APIRouter, Header, Query, Response

from service.http.dependencies import BODY, Cursor, Limit, ServicesDep, page_of, refusals
from service.http.schemas import PolicyList, PolicyOut, PolicyRow, StepRequest, StepResponse
from service.places import at

router = APIRouter(prefix="/policies", tags=["policies"])


@router.get("", operation_id="listPolicies", responses=refusals("validation"))
def get_policies(services: ServicesDep, cursor: Cursor = "", limit: Limit = 50) -> PolicyList:
    """List the stored policies in order of id."""
    with services.store.read() as transaction:
        found = transaction.policies.page(after=cursor, limit=limit + 1)
    page, cursor_after = page_of(found, limit, lambda entry: entry.id)
    items = [PolicyRow(id=entry.id, environment=entry.environment, ltl=entry.ltl) for entry in page]
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
    content = {"id": stored.id, "environment": stored.environment, **to_json(policy)}
    # Straight to text: checking millions of numbers against the schema would cost more than all the rest.
    text = json.dumps(content, separators=(",", ":"), ensure_ascii=False, allow_nan=False)
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
        200: {"content": {"text/plain": {"schema": {"type": "string"}}}, "description": "The automaton."},
        **refusals("unknown-policy", "validation"),
    },
)
def get_policy_automaton(
    policy_id: str,
    services: ServicesDep,
    format: Annotated[Literal["hoa"], Query(description="`hoa`: Hanoi omega-automata format.")] = "hoa",  # noqa: A002
) -> Response:
    """The automaton whose states are the policy's memory."""
    _, policy = services.policy(policy_id)
    return Response({"hoa": policy.hoa}[format], media_type="text/plain")


@router.post(
    "/{policy_id}/step",
    operation_id="stepPolicy",
    responses=refusals(*BODY, "unknown-policy", "invalid-state", "invalid-memory"),
)
def post_step(policy_id: str, body: StepRequest, services: ServicesDep) -> StepResponse:
    """What to do now: send the state observed and the memory the last step returned, once per step."""
    _, policy = services.policy(policy_id)
    with at("/state", only={"invalid-state"}), at("/memory", only={"invalid-memory"}):
        step = policy.step(body.state, body.memory)
    return StepResponse(
        action=step.action,
        memory=step.memory,
        probability=step.probability,
        expected_steps=step.expected_steps if math.isfinite(step.expected_steps) else None,
        done=step.done,
        status=step.status,
    )
