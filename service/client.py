"""The command line's requests: to a running server, or to the app within this process. One path for both."""

from __future__ import annotations

import asyncio
import time
from collections.abc import Iterator
from contextlib import AbstractAsyncContextManager, AsyncExitStack, contextmanager
from typing import Any, Protocol

import httpx

from service.settings import Settings

TIMEOUT_S = 120.0

POLL_S = 0.5
"""How often a server is asked whether a job has ended."""


class UnreachableError(Exception):
    """The server does not answer."""


class Client(Protocol):
    """Asks for the command line."""

    def ask(self, method: str, path: str, body: dict[str, Any] | None = None) -> tuple[int, Any]:
        """Send a JSON body, or nothing; status and decoded answer. What is made as a job is waited for.

        Raises:
            UnreachableError: no server answers at that address, or what answers does not speak JSON.
        """


@contextmanager
def client(server: str | None, settings: Settings) -> Iterator[Client]:
    """A client of a server; without one, of the app within this process, which starts when it is first asked, and stops
    when the context ends.
    """
    if server is not None:
        yield _Remote(server, settings.api_key.get_secret_value())
        return
    here = _Here(settings)
    try:
        yield here
    finally:
        here.close()


def document(*, server: str | None, settings: Settings) -> dict[str, Any]:
    """The OpenAPI document; raises `UnreachableError`."""
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


class _Remote:
    def __init__(self, server: str, key: str) -> None:
        self._server, self._key = server, key

    def ask(self, method: str, path: str, body: dict[str, Any] | None = None) -> tuple[int, Any]:
        status, answer = _send(method, self._server, path, body, self._key)
        return self._ended(answer) if status == 202 else (status, answer)

    def _ended(self, job: dict[str, Any]) -> tuple[int, Any]:
        """What became of a job, as if its request had waited."""
        while job["state"] in ("queued", "running"):
            time.sleep(POLL_S)
            status, job = _send("GET", self._server, job["url"], None, self._key)
            if status != 200:
                return status, job
        if job["state"] == "succeeded":
            return 200, job["plan"]
        return (400, job["error"]) if job["state"] == "failed" else (400, job)


class _Here:
    def __init__(self, settings: Settings) -> None:
        self._settings = settings
        self._loop = asyncio.Runner()
        self._app = AsyncExitStack()
        self._client: httpx.AsyncClient | None = None

    def ask(self, method: str, path: str, body: dict[str, Any] | None = None) -> tuple[int, Any]:
        response = self._loop.run(self._asked(method, path, body))
        return response.status_code, response.json()

    def close(self) -> None:
        self._loop.run(self._app.aclose())
        self._loop.close()

    async def _asked(self, method: str, path: str, body: dict[str, Any] | None) -> httpx.Response:
        if self._client is None:
            self._client = await self._app.enter_async_context(_started(self._settings))
        return await self._client.request(method, path, json=body, timeout=TIMEOUT_S)


def _started(settings: Settings) -> AbstractAsyncContextManager[httpx.AsyncClient]:
    from service.forkserver import launch
    from service.store.migrate import migrate

    migrate(settings.url)  # first: what is refused loads nothing
    launch()  # it loads while this process does
    from service.app import create_app
    from service.asgi import running

    # Nobody could fetch a job from a process that has ended.
    patient = settings.model_copy(update=dict.fromkeys(("wait_s", "max_wait_s"), settings.job_deadline_s))
    return running(create_app(patient, warm=False))
