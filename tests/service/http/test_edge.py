"""Ids, headers and failures, around any app."""

from __future__ import annotations

import asyncio
import logging

import httpx
import pytest
from starlette.responses import HTMLResponse, PlainTextResponse
from starlette.types import Receive, Scope, Send

from service.http.edge import Edge
from service.metrics import Metrics
from tests.service.conftest import check_problem


async def _app(scope: Scope, receive: Receive, send: Send) -> None:
    if scope["path"] == "/fail":
        raise RuntimeError("secret")
    kind = HTMLResponse if scope["path"] == "/page" else PlainTextResponse
    await kind("in")(scope, receive, send)


def ask(path: str, **headers: str) -> httpx.Response:
    async def asked() -> httpx.Response:
        transport = httpx.ASGITransport(app=Edge(_app, metrics=Metrics()))
        async with httpx.AsyncClient(transport=transport, base_url="http://cqltl") as client:
            return await client.get(path, headers=headers)

    return asyncio.run(asked())


@pytest.mark.parametrize("sent", ["a", "7c9e6679-7425-40de-944b", "x" * 100])
def test_a_request_keeps_its_id(sent: str) -> None:
    assert ask("/", **{"X-Request-Id": sent}).headers["x-request-id"] == sent


@pytest.mark.parametrize("sent", ["", "a b", "x" * 101, 'a"b'])
def test_an_id_that_would_break_a_line_is_replaced(sent: str) -> None:
    found = ask("/", **{"X-Request-Id": sent})
    assert len(found.headers["x-request-id"]) == 32


def test_ids_differ() -> None:
    assert ask("/").headers["x-request-id"] != ask("/").headers["x-request-id"]


def test_headers_for_browsers() -> None:
    for path in ("/", "/page", "/fail"):
        headers = ask(path).headers
        assert headers["x-content-type-options"] == "nosniff"
        assert "frame-ancestors 'none'" in headers["content-security-policy"]
        assert ("'self'" in headers["content-security-policy"]) == (path == "/page")


def test_a_failure_is_told_to_the_log_and_not_to_the_client(caplog: pytest.LogCaptureFixture) -> None:
    with caplog.at_level(logging.INFO, "cqltl"):
        response = ask("/fail", **{"X-Request-Id": "r1"})
    problem = check_problem(response, "internal", 500)
    assert "secret" not in str(problem)
    assert response.headers["x-request-id"] == "r1"
    failure, line = caplog.records
    assert failure.exc_info is not None
    assert (line.levelname, line.fields["status"]) == ("WARNING", 500)  # type: ignore[attr-defined]
