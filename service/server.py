"""Serving over HTTP with uvicorn."""

from __future__ import annotations

import socket
import threading

import uvicorn
from sqlalchemy.engine import make_url

from service.app import create_app
from service.settings import Settings

_TRY = """
cqltl serves {url}  (documentation: {url}/docs; store: {store}). Try:

  curl --json '{{"text": "Put the cylinder in the box, then put the box in the bedroom", "environment": "toys"}}' \\
    {url}/translate
"""


class CannotListenError(Exception):
    """The address cannot be bound."""


class _Server(uvicorn.Server):
    """Says where it listens once it does, and tells open streams when it is about to stop."""

    def __init__(self, config: uvicorn.Config, said: str, closing: threading.Event) -> None:
        super().__init__(config)
        self._said, self._closing = said, closing

    async def startup(self, sockets: list[socket.socket] | None = None) -> None:
        await super().startup(sockets)
        if self.started:
            print(self._said, flush=True)  # noqa: T201 - what `cqltl serve` is for

    async def shutdown(self, sockets: list[socket.socket] | None = None) -> None:
        self._closing.set()
        await super().shutdown(sockets)


def serve(settings: Settings, *, host: str, port: int) -> None:
    """Serve until interrupted; raises `CannotListenError`."""
    # asyncio turns Nagle's algorithm off only for sockets that name TCP; with it, every answer waits some 40 ms.
    family = socket.AF_INET6 if ":" in host else socket.AF_INET
    listener = socket.socket(family, socket.SOCK_STREAM, socket.IPPROTO_TCP)
    try:
        listener.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
        listener.bind((host, port))
        listener.listen(2048)
    except OSError as error:
        listener.close()
        reason = error.strerror or error
        raise CannotListenError(
            f"cannot listen on {host} port {port} ({reason}); --port or CQLTL_PORT chooses another"
        ) from error
    with listener:
        shown = f"[{host}]" if ":" in host else host
        said = _TRY.format(
            url=f"http://{shown}:{listener.getsockname()[1]}",
            store=make_url(settings.url).render_as_string(hide_password=True),
        )
        app = create_app(settings)
        config = uvicorn.Config(app, log_level="warning", timeout_graceful_shutdown=10)
        _Server(config, said, app.state.closing).run(sockets=[listener])
