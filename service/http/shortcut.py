"""A short way for what is asked most: the step of a policy at hand, and translations.

The routes are the contract. What is answered here has the bytes that they give, without the way through the framework;
whatever is not quite plain, errors first of all, goes on to them. A translation is a function of the request, of what
was taught and of the environments; the store counts the changes of these, so an answer is given again only as long as
no process has changed any, and the first request after a change is answered by what holds then.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

from pydantic import ValidationError
from sqlalchemy.exc import SQLAlchemyError
from starlette.types import ASGIApp, Receive, Scope, Send

from models.errors import CqltlError
from service.cache import ByteCache
from service.http.language import translation
from service.http.limits import ReadBody
from service.http.policies import step_out
from service.http.schemas import StepRequest, TranslateRequest
from service.services import Services
from service.store import Versions

OVERHEAD = 400
"""Bytes that a kept answer takes besides its texts."""

_TRANSLATE = "/translate"
_POLICIES, _STEP = "/policies/", "/step"


@dataclass(frozen=True, slots=True)
class _Route:
    """What the metrics call a request by; see `service.http.edge`."""

    path: str


_ROUTES = {"translate": _Route("/translate"), "step": _Route("/policies/{policy_id}/step")}


@dataclass(frozen=True, slots=True)
class _Kept:
    """A translation, and what the metrics are told of it."""

    versions: Versions
    answer: bytes
    translator: str
    outcome: str
    confidence: float | None


class Shortcut:
    """ASGI middleware, the innermost; it keeps up to `most` bytes of translations."""

    def __init__(self, app: ASGIApp, *, most: int) -> None:
        self._app = app
        self._kept: ByteCache[bytes, _Kept] = ByteCache(most)

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        """Answer, or pass the request on."""
        body: ReadBody | None = scope.get("cqltl.body")
        # With tracing, each request is seen on its whole way.
        if body is None or not body.plain or scope["method"] != "POST" or "fastapi.telemetry" in scope:
            await self._app(scope, receive, send)
            return
        path: str = scope["path"]
        services: Services = scope["state"]["services"]
        if path == _TRANSLATE:
            await self._translate(services, body, scope, receive, send)
        elif (
            path.startswith(_POLICIES)
            and path.endswith(_STEP)
            and (answer := _step(services, path[len(_POLICIES) : -len(_STEP)], body)) is not None
        ):
            await _answer(scope, send, "step", answer)
        else:
            await self._app(scope, receive, send)

    async def _translate(self, services: Services, body: ReadBody, scope: Scope, receive: Receive, send: Send) -> None:
        kept = self._kept.get(body.data)
        if kept is not None and await _holds(services, kept):
            services.metrics.translated(kept.translator, kept.outcome, kept.confidence)
            await _answer(scope, send, "translate", kept.answer)
            return
        try:
            asked = TranslateRequest.model_validate(body.value)
            found, said = await translation(services, asked)
        except (ValidationError, CqltlError, SQLAlchemyError):
            await self._app(scope, receive, send)
            return
        answer = said.model_dump_json().encode()
        kept = _Kept(found.versions, answer, asked.translator, said.outcome, said.confidence)
        self._kept.put(body.data, kept, len(body.data) + len(answer) + OVERHEAD)
        await _answer(scope, send, "translate", answer)


async def _holds(services: Services, kept: _Kept) -> bool:
    """Whether nothing has changed since."""
    try:
        return kept.versions == await services.freshness.versions()
    except SQLAlchemyError:  # the route says so
        return False


def _step(services: Services, policy_id: str, body: ReadBody) -> bytes | None:
    """What to do by a policy that is at hand; None where the route has to look, or to refuse."""
    policy = services.policy_at_hand(policy_id)
    if policy is None:
        return None
    try:
        asked = StepRequest.model_validate(body.value)
        return step_out(policy.step(asked.state, asked.memory)).model_dump_json().encode()
    except (ValidationError, CqltlError):
        return None


async def _answer(scope: Scope, send: Send, route: str, body: bytes) -> None:
    scope["route"] = _ROUTES[route]
    headers: list[Any] = [(b"content-length", b"%d" % len(body)), (b"content-type", b"application/json")]
    await send({"type": "http.response.start", "status": 200, "headers": headers})
    await send({"type": "http.response.body", "body": body})
