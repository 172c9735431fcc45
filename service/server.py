"""Serving over HTTP with uvicorn."""

from __future__ import annotations

import socket

import uvicorn

from service.app import create_app
from service.settings import Settings

_TRY = """
cqltl serves {url}  (documentation: {url}/docs). Try:

  curl --json '{{"text": "Put the cylinder in the box, then put the box in the bedroom", "environment": "toys"}}' \\
    {url}/translate
"""


class _Server(uvicorn.Server):
    """Says where it listens once it does."""

    async def startup(self, sockets: list[socket.socket] | None = None) -> None:
        await super().startup(sockets)
        if self.started:
            host, port = self.servers[0].sockets[0].getsockname()[:2]
            shown = f"[{host}]" if ":" in host else host
            print(_TRY.format(url=f"http://{shown}:{port}"), flush=True)  # noqa: T201 - what `cqltl serve` is for


def serve(settings: Settings, *, host: str, port: int) -> None:
    """Serve until interrupted."""
    config = uvicorn.Config(
        create_app(settings), host=host, port=port, log_level="warning", timeout_graceful_shutdown=10
    )
    _Server(config).run()
