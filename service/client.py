"""The command line's requests: to a running server, or to the app within this process. One path for both."""

from __future__ import annotations

import asyncio
import time
from typing import Any

import httpx

from service.settings import Settings

TIMEOUT_S = 120.0

POLL_S = 0.5
"""How often a server is asked whether a job has ended."""


class UnreachableError(Exception):
    """The server does not answer."""


def post(path: str, body: dict[str, Any], *, server: str | None, settings: Settings) -> tuple[int, Any]:
    """POST a JSON body; status and decoded answer. What is made as a job is waited for.

    Raises:
        UnreachableError: no server answers at that address, or what answers does not speak JSON.
    """
    return _ask("POST", path, body, server, settings)


def put(path: str, body: dict[str, Any], *, server: str | None, settings: Settings) -> tuple[int, Any]:
    """PUT a JSON body; as `post`."""
    return _ask("PUT", path, body, server, settings)


def get(path: str, *, server: str | None, settings: Settings) -> tuple[int, Any]:
    """GET JSON; status and decoded answer. Raises as `post`."""
    return _ask("GET", path, None, server, settings)


def _ask(
    method: str, path: str, body: dict[str, Any] | None, server: str | None, settings: Settings
) -> tuple[int, Any]:
    if server is not None:
        key = settings.api_key.get_secret_value()
        status, answer = _send(method, server, path, body, key)
        return _ended(server, answer, key) if status == 202 else (status, answer)
    response = asyncio.run(_ask_here(method, path, body, settings))
    return response.status_code, response.json()


def document(*, server: str | None, settings: Settings) -> dict[str, Any]:
    """The OpenAPI document; raises as `post`."""
    if server is None:
        from service.app import create_app

        return create_app(settings, warm=False).openapi()
    status, found = _send("GET", server, "/openapi.json", None, "")
    if status != 200 or not isinstance(found, dict):
        raise UnreachableError(f"{server} has no OpenAPI document: status {status}")
    return found


def _send(method: str, server: str, path: str, body: dict[str, Any] | None, key: str) -> tuple[int, Any]:
    headers = {"Authorization": f"Bearer {key}"} if key else {}
    url = server.rstrip("/") + path
    try:
        response = httpx.request(method, url, json=body, headers=headers, timeout=TIMEOUT_S)
        return response.status_code, response.json()
    except (httpx.HTTPError, httpx.InvalidURL, ValueError) as error:
        raise UnreachableError(f"{url}: {error}") from error


def _ended(server: str, job: dict[str, Any], key: str) -> tuple[int, Any]:
    """What became of a job, as if its request had waited."""
    while job["state"] in ("queued", "running"):
        time.sleep(POLL_S)
        status, job = _send("GET", server, job["url"], None, key)
        if status != 200:
            return status, job
    if job["state"] == "succeeded":
        return 200, job["plan"]
    return (400, job["error"]) if job["state"] == "failed" else (400, job)


async def _ask_here(method: str, path: str, body: dict[str, Any] | None, settings: Settings) -> httpx.Response:
    from service.forkserver import launch
    from service.store.migrate import migrate

    migrate(settings.url)  # first: what is refused loads nothing
    launch()  # it loads while this process does
    from service.app import create_app
    from service.asgi import running

    # Nobody could fetch a job from a process that has ended.
    patient = settings.model_copy(update=dict.fromkeys(("wait_s", "max_wait_s"), settings.job_deadline_s))
    async with running(create_app(patient, warm=False)) as client:
        return await client.request(method, path, json=body, timeout=TIMEOUT_S)
