"""The command line's requests: to a running server, or to the app within this process. One path for both."""

from __future__ import annotations

import asyncio
from typing import Any

import httpx

from service.settings import Settings

TIMEOUT_S = 120.0


class UnreachableError(Exception):
    """The server does not answer."""


def post(path: str, body: dict[str, Any], *, server: str | None, settings: Settings) -> tuple[int, Any]:
    """POST a JSON body; status and decoded answer.

    Raises:
        UnreachableError: no server answers at that address, or what answers does not speak JSON.
    """
    try:
        if server is not None:
            response = httpx.post(server.rstrip("/") + path, json=body, timeout=TIMEOUT_S)
        else:
            response = asyncio.run(_post_here(path, body, settings))
        return response.status_code, response.json()
    except (httpx.HTTPError, httpx.InvalidURL, ValueError) as error:
        raise UnreachableError(f"{server}{path}: {error}") from error


async def _post_here(path: str, body: dict[str, Any], settings: Settings) -> httpx.Response:
    from service.app import create_app
    from service.asgi import running

    async with running(create_app(settings, warm=False)) as client:
        return await client.post(path, json=body, timeout=TIMEOUT_S)
