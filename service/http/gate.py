"""Who may come in: API keys, rates, and how many at a time. Asked before anything of a request's body is read."""

from __future__ import annotations

import ipaddress
import math
from typing import Any

from starlette.datastructures import Headers
from starlette.responses import Response
from starlette.types import ASGIApp, Receive, Scope, Send

from service.http.problems import problem_response
from service.http.scopes import OPEN, UNLIMITED, first_part, scope_of
from service.keys import ApiKey, KeyRing
from service.metrics import Metrics
from service.rates import TokenBuckets


class Gate:
    """ASGI middleware: answers 401, 403, 429 and 503 instead of the app. Without keys everybody has all scopes."""

    def __init__(
        self, app: ASGIApp, *, keys: KeyRing | None, rates: TokenBuckets | None, most: int, metrics: Metrics
    ) -> None:
        self._app, self._keys, self._rates, self._most, self._metrics = app, keys, rates, most, metrics

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        """Let the request in, or refuse it."""
        if scope["type"] != "http":
            await self._app(scope, receive, send)
            return
        part = first_part(scope["path"])
        refused = self._refused(scope, part)
        if refused is not None:
            await refused(scope, receive, send)
        elif part in UNLIMITED:
            await self._app(scope, receive, send)
        else:
            self._metrics.requests_in_flight += 1
            try:
                await self._app(scope, receive, send)
            finally:
                self._metrics.requests_in_flight -= 1

    def _refused(self, scope: Scope, part: str) -> Response | None:
        in_flight = self._metrics.requests_in_flight
        if part not in UNLIMITED and in_flight >= self._most:
            return problem_response("overloaded", f"{in_flight} requests are being answered already")
        key = None if self._keys is None else self._key_of(scope)
        if part not in UNLIMITED and self._rates is not None:
            wait_s = self._rates.take(f"key {key.name}" if key else f"address {_network(scope)}")
            if wait_s > 0:
                response = problem_response("rate-limited", "you ask more often than the service allows")
                response.headers["Retry-After"] = str(math.ceil(wait_s))
                return response
        return None if self._keys is None or part in OPEN else _unauthorised(key, scope)

    def _key_of(self, scope: Scope) -> ApiKey | None:
        assert self._keys is not None
        scheme, _, secret = Headers(scope=scope).get("authorization", "").partition(" ")
        return self._keys.find(secret.strip()) if scheme.lower() == "bearer" else None


def _unauthorised(key: ApiKey | None, scope: Scope) -> Response | None:
    if key is None:
        detail = "this needs an API key: send it as Authorization: Bearer KEY"
        response = problem_response("unauthorized", detail)
        response.headers["WWW-Authenticate"] = 'Bearer realm="cqltl"'
        return response
    needed = scope_of(scope["method"], scope["path"])
    if not key.allows(needed):
        return problem_response("forbidden", f"the key {key.name} is not good for the scope {needed}")
    return None


def _network(scope: Scope) -> str:
    """What one client has of addresses: one of IPv4, or a /64 of IPv6."""
    host = (scope.get("client") or ("",))[0]
    try:
        address = ipaddress.ip_address(host)
    except ValueError:
        return str(host)
    return str(ipaddress.ip_network((address, 64), strict=False)) if address.version == 6 else str(address)


def cors(origins: str) -> dict[str, Any]:
    """What the pages of other origins may do: ask with what this API has of headers, and never with cookies."""
    return {
        "allow_origins": [origin.strip() for origin in origins.split(",") if origin.strip()],
        "allow_methods": ["GET", "POST", "PUT", "DELETE"],
        "allow_headers": ["Authorization", "Content-Type", "Idempotency-Key", "Prefer", "X-Request-Id"],
        "expose_headers": ["Location", "Preference-Applied", "Retry-After", "X-Request-Id"],
    }
