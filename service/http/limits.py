"""Refuses request bodies that are too large, before they are read whole."""

from __future__ import annotations

from starlette.types import ASGIApp, Message, Receive, Scope, Send

from service.http.problems import problem_response

DRAINED = 16
"""How many times the limit is still read and thrown away before the answer."""


class _TooLarge(Exception):
    pass


async def _drain(receive: Receive, most: int) -> None:
    """Read on: a client that still sends when the connection closes would see a reset and not the answer."""
    read = 0
    while read <= most:
        message = await receive()
        read += len(message.get("body", b""))
        if message["type"] != "http.request" or not message.get("more_body", False):
            return


class BodyLimit:
    """ASGI middleware: a body of more than `limit` bytes is answered 413, whatever its declared length."""

    def __init__(self, app: ASGIApp, limit: int) -> None:
        self._app, self._limit = app, limit

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        """Pass the request on, counting the bytes of its body."""
        if scope["type"] != "http":
            await self._app(scope, receive, send)
            return
        received, more, exceeded, started = 0, True, False, False

        async def counted() -> Message:
            nonlocal received, more, exceeded
            message = await receive()
            received += len(message.get("body", b""))
            more = message.get("more_body", False)
            if received > self._limit:
                exceeded = True
                raise _TooLarge
            return message

        async def noted(message: Message) -> None:
            nonlocal started
            if exceeded and not started:
                return  # the framework's own answer to the interrupted body
            started = True
            await send(message)

        declared = dict(scope["headers"]).get(b"content-length", b"0")
        exceeded = declared.isdigit() and int(declared) > self._limit
        if not exceeded:
            try:
                await self._app(scope, counted, noted)
            except _TooLarge:
                if started:
                    raise
        if exceeded and not started:
            if more:
                await _drain(receive, DRAINED * self._limit)
            response = problem_response("body-too-large", f"the body has more than {self._limit} bytes")
            response.headers["Connection"] = "close"
            await response(scope, receive, send)
