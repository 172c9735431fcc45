"""Where a service listens, and what it takes to."""

from __future__ import annotations

import ipaddress
import resource
import socket

from service.errors import CannotStartError
from service.settings import Settings

SPARE_FILES = 256
"""Files that are open besides connections, at most."""


class CannotListenError(CannotStartError):
    """The address cannot be bound, or must not be."""


def listen(settings: Settings, host: str, port: int) -> socket.socket:
    """A socket that listens there; raises `CannotListenError`, also where everybody could use the service."""
    if settings.api_keys_file is None and not settings.allow_unauthenticated and not is_loopback(host):
        raise CannotListenError(
            f"whoever reaches {host or 'this machine'} could use the service: make API keys with `cqltl keys add` and "
            "name their file in CQLTL_API_KEYS_FILE, or set CQLTL_ALLOW_UNAUTHENTICATED=true"
        )
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
    return listener


def is_loopback(host: str) -> bool:
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


def _allow_files(count: int) -> None:
    """A connection is an open file, of which a process may often have 1024 only unless it asks for more."""
    soft, hard = resource.getrlimit(resource.RLIMIT_NOFILE)
    wanted = count if hard == resource.RLIM_INFINITY else min(count, hard)
    if soft != resource.RLIM_INFINITY and soft < wanted:
        resource.setrlimit(resource.RLIMIT_NOFILE, (wanted, hard))
