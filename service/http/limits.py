"""Request bodies: read whole within their limit, and refused when they are not what they say they are."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

from starlette.datastructures import Headers
from starlette.responses import Response
from starlette.types import ASGIApp, Message, Receive, Scope, Send

from service.http.problems import problem_response, response_of
from service.http.strict_json import Flawed, read_json

DRAINED = 16
"""How many times the limit is still read and thrown away before the answer."""


@dataclass(frozen=True, slots=True)
class ReadBody:
    """A body of JSON as it was read, in the scope as `cqltl.body`; `plain` is `application/json`, and nothing +json."""

    data: bytes
    value: Any
    plain: bool


class _Gone(Exception):
    """The client went away amid its body."""


class BodyLimit:
    """ASGI middleware: the app behind it gets bodies whole, of `limit` bytes at most, uncompressed, and where they are
    marked as JSON, as JSON nested no deeper than `depth`.
    """

    def __init__(self, app: ASGIApp, limit: int, depth: int) -> None:
        self._app, self._limit, self._depth = app, limit, depth

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        """Pass the request on with its body, or refuse it."""
        if scope["type"] != "http":
            await self._app(scope, receive, send)
            return
        headers = Headers(scope=scope)
        if "transfer-encoding" not in headers and headers.get("content-length", "0") == "0":
            await self._app(scope, receive, send)
            return
        if (refused := self._refused_unread(headers)) is not None:
            await _drain(receive, DRAINED * self._limit)
            await refused(scope, receive, send)
            return
        try:
            body = await self._read(receive)
        except _Gone:
            return
        if body is None:
            await self._too_large()(scope, receive, send)
            return
        kind = headers.get("content-type", "").partition(";")[0].strip().lower()
        if body and _is_json(kind):
            try:
                value = read_json(body, self._depth)
            except Flawed as flawed:
                await response_of(flawed.problem)(scope, receive, send)
                return
            scope["cqltl.body"] = ReadBody(body, value, kind == "application/json")
        await self._app(scope, _replaying(body, receive), send)

    def _refused_unread(self, headers: Headers) -> Response | None:
        declared = headers.get("content-length", "0")
        if declared.isdigit() and int(declared) > self._limit:
            return self._too_large()
        if headers.get("content-encoding", "identity").lower() != "identity":
            # What a few bytes unpack to has no limit, and no client of ours packs.
            return _closing(problem_response("unsupported-media-type", "the body is compressed: send it as it is"))
        return None

    async def _read(self, receive: Receive) -> bytes | None:
        """The body; None where it is too large, and then most of the rest is read too."""
        body, more = bytearray(), True
        while more:
            message = await receive()
            if message["type"] != "http.request":
                raise _Gone
            body += message.get("body", b"")
            more = message.get("more_body", False)
            if len(body) > self._limit:
                if more:
                    await _drain(receive, DRAINED * self._limit)
                return None
        return bytes(body)

    def _too_large(self) -> Response:
        return _closing(problem_response("body-too-large", f"the body has more than {self._limit} bytes"))


def _closing(response: Response) -> Response:
    response.headers["Connection"] = "close"
    return response


async def _drain(receive: Receive, most: int) -> None:
    """Read on: a client that still sends when the connection closes would see a reset and not the answer."""
    read = 0
    while read <= most:
        message = await receive()
        read += len(message.get("body", b""))
        if message["type"] != "http.request" or not message.get("more_body", False):
            return


def _is_json(kind: str) -> bool:
    return kind == "application/json" or (kind.startswith("application/") and kind.endswith("+json"))


def _replaying(body: bytes, receive: Receive) -> Receive:
    """What gives the body in one piece, and then whatever comes."""
    given = False

    async def replayed() -> Message:
        nonlocal given
        if given:
            return await receive()
        given = True
        return {"type": "http.request", "body": body, "more_body": False}

    return replayed
