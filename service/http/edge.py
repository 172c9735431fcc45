"""What every request passes first and every response last: its id, the log, the metrics, and headers for browsers."""

from __future__ import annotations

import logging
import re
import time
import uuid

from starlette.datastructures import Headers, MutableHeaders
from starlette.types import ASGIApp, Message, Receive, Scope, Send

from service.http.problems import problem_response
from service.logs import JOB_ID, REQUEST_ID
from service.metrics import Metrics

_ID = re.compile(r"[A-Za-z0-9._:-]{1,100}")
"""Ids that are taken over; a log line must not be broken by one."""

_METHODS = frozenset({"GET", "HEAD", "POST", "PUT", "DELETE", "OPTIONS"})

_HEADERS = {
    "X-Content-Type-Options": "nosniff",
    "X-Frame-Options": "DENY",
    "Referrer-Policy": "no-referrer",
    "Cross-Origin-Resource-Policy": "same-origin",
}
_DATA_POLICY = "default-src 'none'; style-src 'unsafe-inline'; frame-ancestors 'none'"
"""Content-Security-Policy of what is no page; automata as SVG have styles."""
_PAGE_POLICY = (
    "default-src 'self'; script-src 'self' 'unsafe-inline'; style-src 'self' 'unsafe-inline'; img-src 'self' data:; "
    "base-uri 'none'; form-action 'self'; frame-ancestors 'none'"
)
"""That of pages, which load nothing from elsewhere; those of /docs have a script within."""

_log = logging.getLogger("cqltl")


class Edge:
    """ASGI middleware, the outermost; what fails behind it is answered as `internal`."""

    def __init__(self, app: ASGIApp, *, metrics: Metrics) -> None:
        self._app, self._metrics = app, metrics

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        """Pass the request on, and say how it went."""
        if scope["type"] != "http":
            await self._app(scope, receive, send)
            return
        sent = Headers(scope=scope).get("x-request-id", "")
        request_id = sent if _ID.fullmatch(sent) else uuid.uuid4().hex
        REQUEST_ID.set(request_id)
        JOB_ID.set(None)
        began, status = time.perf_counter(), 0

        async def noted(message: Message) -> None:
            nonlocal status
            if message["type"] == "http.response.start":
                status = message["status"]
                complete(MutableHeaders(scope=message), request_id)
            await send(message)

        try:
            await self._app(scope, receive, noted)
        except Exception:
            _log.exception("%s %s failed", scope["method"], scope["path"])
            if status:
                raise  # too late to say so
            await problem_response("internal", "the service failed on this request; the failure is in its log")(
                scope, receive, noted
            )
        finally:
            self._told(scope, status, time.perf_counter() - began)

    def _told(self, scope: Scope, status: int, seconds: float) -> None:
        method = scope["method"] if scope["method"] in _METHODS else "other"
        self._metrics.answered(method, getattr(scope.get("route"), "path", "none"), status, seconds)
        level = logging.WARNING if status >= 500 else logging.INFO
        if _log.isEnabledFor(level):
            client, ms = (scope.get("client") or ("",))[0], round(1_000 * seconds, 1)
            fields = {"method": method, "path": scope["path"], "status": status, "ms": ms, "client": client}
            _log.log(level, "%s %s %d in %.1f ms", *list(fields.values())[:4], extra={"fields": fields})


def complete(headers: MutableHeaders, request_id: str) -> None:
    """Put in what every answer has."""
    headers["X-Request-Id"] = request_id
    for name, value in _HEADERS.items():
        headers.setdefault(name, value)
    page = headers.get("content-type", "").startswith("text/html")
    headers.setdefault("Content-Security-Policy", _PAGE_POLICY if page else _DATA_POLICY)
