"""HTTP/1.1 over sockets: uvicorn's protocol, with an end to every wait for a client.

uvicorn closes connections that idle after an answer; it waits for ever for a first request, for the rest of a head or a
body, and for a client that does not read. Here each of these has a deadline, which bytes that drip in do not move.
"""

from __future__ import annotations

import asyncio
import sys
import uuid
from dataclasses import dataclass
from http import HTTPStatus
from typing import Any, Literal

from starlette.responses import Response
from uvicorn.config import Config
from uvicorn.protocols.http.h11_impl import H11Protocol, RequestResponseCycle
from uvicorn.server import ServerState

from service.http.edge import complete
from service.http.problems import problem_response
from service.settings import Settings

LINGER_S = 1.0
"""How long a connection that was refused is still read, since a reset would take the answer from the client."""

MAX_PROBES = 16
"""Connections beyond the most, only to ask whether the service lives: it does, and nobody shall restart it."""

PROBE_S = 1.0
"""How long such a connection may take to ask."""

Phase = Literal["head", "body"]


@dataclass(frozen=True, slots=True)
class Patience:
    """Seconds for a head and for a body to arrive, and for an answer to be read; how many connections there may be."""

    head_s: float
    body_s: float
    write_s: float
    connections: int


class PatientProtocol(H11Protocol):
    """One connection. `patience` is set by `protocol_of`."""

    patience: Patience

    def __init__(
        self,
        config: Config,
        server_state: ServerState,
        app_state: dict[str, Any],
        _loop: asyncio.AbstractEventLoop | None = None,
    ) -> None:
        super().__init__(config, server_state, app_state, _loop)
        self._phase: Phase | None = None
        self._deadline: asyncio.TimerHandle | None = None
        self._unread: asyncio.TimerHandle | None = None
        self._refused = self._probe = False

    def connection_made(self, transport: asyncio.Transport) -> None:  # type: ignore[override]  # as uvicorn's
        """Wait for a head from now on."""
        super().connection_made(transport)
        beyond = len(self.connections) - self.patience.connections
        self._probe = beyond > 0
        if beyond > MAX_PROBES:
            self._refuse_one_more()
        else:
            self._enter("head")

    def connection_lost(self, exc: Exception | None) -> None:
        """Wait for nothing any more."""
        self._enter(None)
        self.resume_writing()
        super().connection_lost(exc)

    def data_received(self, data: bytes) -> None:
        """Go on reading, by the deadline of what is being read."""
        if self._refused:
            return
        if self._probe and not _asks_for_life(data):
            self._refuse_one_more()
            return
        super().data_received(data)
        if not self._refused:
            cycle = self._unanswered
            if cycle is None:  # the next head, or a body that nobody wants
                self._enter("head")
            else:
                self._enter("body" if cycle.more_body else None)

    def on_response_complete(self) -> None:
        """uvicorn waits for the next request, or has begun with one that was sent already."""
        super().on_response_complete()
        cycle = self._unanswered
        self._enter("body" if cycle is not None and cycle.more_body else None)

    def pause_writing(self) -> None:
        """The client does not read as fast as it is answered."""
        super().pause_writing()
        if self._unread is None:
            self._unread = self.loop.call_later(self.patience.write_s, self.transport.abort)

    def resume_writing(self) -> None:
        """It has read."""
        super().resume_writing()
        if self._unread is not None:
            self._unread.cancel()
            self._unread = None

    def send_400_response(self, msg: str) -> None:
        """What is not HTTP; uvicorn calls this where h11 says so."""
        error = sys.exception()
        status = getattr(error, "error_status_hint", 400)
        self._refuse(problem_response("http-error", f"this is not HTTP: {error or msg}", status=status))

    @property
    def _unanswered(self) -> RequestResponseCycle | None:
        """The request that is being answered; uvicorn has none before the first, and keeps the last."""
        found: RequestResponseCycle | None = self.cycle
        return None if found is None or found.response_complete else found

    def _should_upgrade(self) -> bool:
        return False

    def _enter(self, phase: Phase | None) -> None:
        """Begin to wait; to go on waiting for the same changes no deadline."""
        if phase == self._phase:
            return
        if self._deadline is not None:
            self._deadline.cancel()
            self._deadline = None
        self._phase = phase
        if phase is not None:
            seconds = self.patience.head_s if phase == "head" else self.patience.body_s
            seconds = min(seconds, PROBE_S) if self._probe else seconds
            self._deadline = self.loop.call_later(seconds, self._too_late)

    def _too_late(self) -> None:
        if self.transport.is_closing():
            return
        waited_for, started = self._phase, self.conn.trailing_data[0]
        if waited_for == "head" and not started:
            self.transport.close()  # it has not asked for anything
        else:
            self._refuse(problem_response("request-timeout", f"the {waited_for} of the request did not arrive in time"))

    def _refuse_one_more(self) -> None:
        self._refuse(problem_response("overloaded", "too many connections are open"))

    def _refuse(self, response: Response) -> None:
        """Answer past the app, and end the connection."""
        self._refused = True
        self._enter(None)
        self._unset_keepalive_if_required()
        cycle = self._unanswered
        if cycle is not None:
            answering = cycle.response_started
            cycle.disconnected = True
            cycle.message_event.set()
            if answering:
                self.transport.abort()
                return
        complete(response.headers, uuid.uuid4().hex)
        self.transport.write(_raw(response))
        self.transport.write_eof()
        self.flow.resume_reading()
        self.loop.call_later(LINGER_S, self.transport.abort)


def protocol_of(settings: Settings) -> type[PatientProtocol]:
    """The protocol with the limits of the settings."""
    patience = Patience(
        head_s=settings.head_timeout_s,
        body_s=settings.body_timeout_s,
        write_s=settings.write_timeout_s,
        connections=settings.max_connections,
    )
    return type("ServedProtocol", (PatientProtocol,), {"patience": patience})


def _asks_for_life(data: bytes) -> bool:
    """Whether this is one whole request for /livez, and nothing else."""
    return data.startswith(b"GET /livez ") and data.find(b"\r\n\r\n") == len(data) - 4


def _raw(response: Response) -> bytes:
    """A response as it goes over the wire."""
    lines = [f"HTTP/1.1 {response.status_code} {HTTPStatus(response.status_code).phrase}".encode()]
    lines += [name + b": " + value for name, value in response.raw_headers]
    return b"\r\n".join([*lines, b"connection: close", b"", bytes(response.body)])
