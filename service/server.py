"""Serving over HTTP with uvicorn."""

from __future__ import annotations

import gc
import logging
import os
import socket
import threading

import uvicorn
from sqlalchemy.engine import make_url

from service.app import create_app
from service.http.protocol import protocol_of
from service.logs import configure
from service.settings import Settings

_TRY = """
cqltl serves {url}  (open it in a browser; documentation: {url}/docs; store: {store}). Try:

  curl --json '{{"text": "Put the cylinder in the box, then put the box in the bedroom", "environment": "toys"}}' \\
    {url}/translate
"""


GRACE_S = 3
"""Seconds that requests get to end where the service stops; those that wait for a plan are told at once of its job."""


class _Server(uvicorn.Server):
    """Says where it listens once it does, and tells streams and those who wait when it is about to stop."""

    def __init__(self, config: uvicorn.Config, said: str, closing: threading.Event) -> None:
        super().__init__(config)
        self._said, self._closing = said, closing

    async def startup(self, sockets: list[socket.socket] | None = None) -> None:
        await super().startup(sockets)
        gc.collect()
        gc.freeze()  # networks and grammars stay: to look through them again and again would hold up requests
        gc.enable()
        if self.started:
            print(self._said, flush=True)  # noqa: T201 - what `cqltl serve` is for

    async def shutdown(self, sockets: list[socket.socket] | None = None) -> None:
        self._closing.set()
        await super().shutdown(sockets)


def serve(settings: Settings, listener: socket.socket) -> None:
    """Serve on a socket that listens, until interrupted; raises `CannotStartError`."""
    configure(settings.log_format, settings.log_level)
    os.environ.setdefault("OTEL_SERVICE_NAME", "cqltl")
    host, port = listener.getsockname()[:2]
    said = _TRY.format(
        url=f"http://[{host}]:{port}" if ":" in host else f"http://{host}:{port}",
        store=make_url(settings.url).render_as_string(hide_password=True),
    )
    app = create_app(settings)
    config = uvicorn.Config(
        app,
        log_config=None,
        access_log=False,
        timeout_graceful_shutdown=GRACE_S,
        timeout_keep_alive=settings.keep_alive_s,
        h11_max_incomplete_event_size=settings.max_head_bytes,
        http=protocol_of(settings),
        proxy_headers=bool(settings.trusted_proxies),
        forwarded_allow_ips=settings.trusted_proxies,
        ws="none",
        server_header=False,
    )
    logging.getLogger("uvicorn.error").addFilter(lambda _: app.state.cannot_start is None)  # it is said once
    try:
        _Server(config, said, app.state.closing).run(sockets=[listener])
    except SystemExit:  # uvicorn's end where the app does not start
        if app.state.cannot_start is not None:
            raise app.state.cannot_start from None
        raise
