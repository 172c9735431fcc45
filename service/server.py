"""Serving over HTTP with uvicorn."""

from __future__ import annotations

import ipaddress
import logging
import resource
import socket
import threading

import uvicorn
from sqlalchemy.engine import make_url

from service.app import create_app
from service.errors import CannotStartError
from service.http.protocol import protocol_of
from service.logs import configure
from service.settings import Settings

_TRY = """
cqltl serves {url}  (documentation: {url}/docs; store: {store}). Try:

  curl --json '{{"text": "Put the cylinder in the box, then put the box in the bedroom", "environment": "toys"}}' \\
    {url}/translate
"""


SPARE_FILES = 256
"""Files that are open besides connections, at most."""


class CannotListenError(CannotStartError):
    """The address cannot be bound, or must not be."""


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
    """Serve until interrupted; raises `CannotStartError`."""
    if settings.api_keys_file is None and not settings.allow_unauthenticated and not _is_loopback(host):
        raise CannotListenError(
            f"whoever reaches {host or 'this machine'} could use the service: make API keys with `cqltl keys add` and "
            "name their file in CQLTL_API_KEYS_FILE, or set CQLTL_ALLOW_UNAUTHENTICATED=true"
        )
    configure(settings.log_format, settings.log_level)
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
    _allow_files(settings.max_connections + SPARE_FILES)
    with listener:
        shown = f"[{host}]" if ":" in host else host
        said = _TRY.format(
            url=f"http://{shown}:{listener.getsockname()[1]}",
            store=make_url(settings.url).render_as_string(hide_password=True),
        )
        app = create_app(settings)
        config = uvicorn.Config(
            app,
            log_config=None,
            access_log=False,
            timeout_graceful_shutdown=10,
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


def _allow_files(count: int) -> None:
    """A connection is an open file, of which a process may often have 1024 only unless it asks for more."""
    soft, hard = resource.getrlimit(resource.RLIMIT_NOFILE)
    wanted = count if hard == resource.RLIM_INFINITY else min(count, hard)
    if soft != resource.RLIM_INFINITY and soft < wanted:
        resource.setrlimit(resource.RLIMIT_NOFILE, (wanted, hard))


def _is_loopback(host: str) -> bool:
    """Only this machine reaches the address, whatever its name stands for."""
    try:
        return ipaddress.ip_address(host).is_loopback
    except ValueError:
        pass
    try:
        found = {entry[4][0] for entry in socket.getaddrinfo(host, None)} if host else set()
    except OSError:
        return False
    return bool(found) and all(ipaddress.ip_address(address).is_loopback for address in found)
