"""Who comes in: keys and scopes, rates, how many at a time, and the pages of others."""

from __future__ import annotations

import asyncio
from pathlib import Path

import httpx
import pytest
from fastapi.routing import APIRoute
from starlette.responses import PlainTextResponse
from starlette.types import Receive, Scope, Send

from benchmarks.server import serving
from service.app import create_app
from service.http.gate import Gate
from service.http.scopes import OPEN, first_part, scope_of
from service.keys import KeyRing, add_key
from service.metrics import Metrics
from service.rates import TokenBuckets
from service.settings import Settings
from tests.service.conftest import check_problem

ROBOT = "read,translate,plan"


async def _app(scope: Scope, receive: Receive, send: Send) -> None:
    await PlainTextResponse("in")(scope, receive, send)


def client_of(gate: Gate, address: str = "192.0.2.1") -> httpx.AsyncClient:
    transport = httpx.ASGITransport(app=gate, client=(address, 5))
    return httpx.AsyncClient(transport=transport, base_url="http://cqltl")


def statuses(gate: Gate, *requests: tuple[str, str, str], address: str = "192.0.2.1") -> list[int]:
    async def ask() -> list[int]:
        async with client_of(gate, address) as client:
            return [
                (await client.request(method, path, headers={"authorization": sent} if sent else {})).status_code
                for method, path, sent in requests
            ]

    return asyncio.run(ask())


def test_every_route_has_its_scope() -> None:
    for path, item in create_app(Settings(), warm=False).openapi()["paths"].items():
        for method in item:
            needed = scope_of(method.upper(), path)
            assert (needed is None) == (first_part(path) in OPEN), (
                f"{method} {path} is in no table of service.http.scopes"
            )


@pytest.mark.parametrize(
    ("method", "path", "scope"),
    [
        ("POST", "/translate/batch", "translate"),
        ("POST", "/learn", "teach"),
        ("GET", "/templates/ship/examples", "read"),
        ("DELETE", "/templates/ship/examples/1", "teach"),
        ("PUT", "/environments/toys", "teach"),
        ("POST", "/policies/1/step", "plan"),
        ("DELETE", "/policies/1", "admin"),
        ("POST", "/jobs/1/cancel", "plan"),
        ("GET", "/jobs/1/events", "read"),
        ("POST", "//plan", "plan"),
    ],
)
def test_scopes(method: str, path: str, scope: str) -> None:
    assert scope_of(method, path) == scope


def test_keys(tmp_path: Path) -> None:
    path = tmp_path / "keys"
    reader, boss = (f"Bearer {add_key(path, name, [name])}" for name in ("read", "admin"))
    gate = Gate(_app, keys=KeyRing(path), rates=None, most=9, metrics=Metrics())
    asked = {
        ("GET", "/templates", ""): 401,
        ("GET", "/templates", "Bearer wrong"): 401,
        ("GET", "/templates", reader.replace("Bearer", "Basic")): 401,
        ("GET", "/templates", reader): 200,
        ("GET", "/templates", reader.replace("Bearer", "bearer")): 200,
        ("POST", "/learn", reader): 403,
        ("POST", "/learn", boss): 200,
        ("GET", "/nowhere", ""): 401,
        ("GET", "/nowhere", reader): 200,
        ("GET", "/livez", ""): 200,
        ("GET", "/readyz", ""): 200,
        ("GET", "/docs", ""): 200,
        ("GET", "/metrics", ""): 401,
        ("GET", "/metrics", reader): 200,
    }
    assert statuses(gate, *asked) == list(asked.values())


def test_rates_are_of_keys_and_else_of_addresses(tmp_path: Path) -> None:
    path = tmp_path / "keys"
    one, two = (f"Bearer {add_key(path, name, ['read'])}" for name in ("one", "two"))
    gate = Gate(_app, keys=KeyRing(path), rates=TokenBuckets(0.01, 2), most=9, metrics=Metrics())
    get = ("GET", "/jobs")
    assert statuses(gate, (*get, one), (*get, one), (*get, one)) == [200, 200, 429]
    assert statuses(gate, (*get, two), address="192.0.2.9") == [200]
    assert statuses(gate, (*get, ""), (*get, ""), (*get, "")) == [401, 401, 429]
    assert statuses(gate, (*get, ""), address="192.0.2.2") == [401]
    assert statuses(gate, (*get, ""), (*get, ""), address="2001:db8::1") == [401, 401]
    assert statuses(gate, (*get, ""), address="2001:db8::2") == [429], "a network of IPv6 is one client"
    assert statuses(gate, *[("GET", "/livez", "")] * 9) == [200] * 9


def test_only_so_many_at_a_time() -> None:
    async def crowd() -> None:
        leave = asyncio.Event()

        async def slow(scope: Scope, receive: Receive, send: Send) -> None:
            if scope["path"] == "/plan":
                await leave.wait()
            await _app(scope, receive, send)

        metrics = Metrics()
        async with client_of(Gate(slow, keys=None, rates=None, most=2, metrics=metrics)) as client:
            waiting = [asyncio.create_task(client.post("/plan")) for _ in range(2)]
            await asyncio.sleep(0.05)
            refused = await client.post("/plan")
            check_problem(refused, "overloaded", 503)
            assert metrics.requests_in_flight == 2
            assert int(refused.headers["retry-after"]) >= 1
            assert (await client.get("/livez")).status_code == 200
            leave.set()
            assert [response.status_code for response in await asyncio.gather(*waiting)] == [200, 200]
            assert (await client.post("/plan")).status_code == 200
            assert metrics.requests_in_flight == 0

    asyncio.run(crowd())


def test_a_server_with_keys_rates_and_an_origin(tmp_path: Path) -> None:
    path = tmp_path / "keys"
    robot = add_key(path, "robot", ROBOT.split(","))
    origin = "https://robots.example"
    settings = {"CQLTL_API_KEYS_FILE": str(path), "CQLTL_RATE_LIMIT": "0.5", "CQLTL_ALLOWED_ORIGINS": origin}
    with serving(tmp_path / "data", CQLTL_HOST="0.0.0.0", CQLTL_RATE_BURST="8", **settings) as client:
        client.base_url = httpx.URL(str(client.base_url).replace("0.0.0.0", "127.0.0.1"))
        refused = client.post("/translate", content=b"x" * 500_000)
        check_problem(refused, "unauthorized", 401)
        assert refused.headers["www-authenticate"].startswith("Bearer")
        client.headers["authorization"] = f"Bearer {robot}"
        answer = client.post("/translate", json={"text": "Pickup the sphere"}, headers={"origin": origin})
        assert answer.status_code == 200
        assert answer.headers["access-control-allow-origin"] == origin
        problem = check_problem(client.delete("/environments/toys"), "forbidden", 403)
        assert "robot" in problem["detail"]
        assert "teach" in problem["detail"]
        asked = {"origin": origin, "access-control-request-method": "POST", "authorization": ""}
        assert client.options("/plan", headers=asked).headers["access-control-allow-origin"] == origin
        other = client.get("/jobs", headers={"origin": "https://evil.example"})
        assert "access-control-allow-origin" not in other.headers
        refused = next(found for found in (client.get("/jobs") for _ in range(20)) if found.status_code != 200)
        check_problem(refused, "rate-limited", 429)
        assert 1 <= int(refused.headers["retry-after"]) <= 2
        assert client.get("/livez").status_code == 200


def test_without_the_setting_no_origin_reads_answers(client: httpx.Client) -> None:
    response = client.get("/livez", headers={"origin": "https://robots.example"})
    assert "access-control-allow-origin" not in response.headers
    asked = {"origin": "https://robots.example", "access-control-request-method": "POST"}
    assert client.options("/plan", headers=asked).status_code == 405


def test_routes_are_those_of_the_document() -> None:
    app = create_app(Settings(), warm=False)
    hidden = [route.path for route in app.routes if isinstance(route, APIRoute) and not route.include_in_schema]
    assert all(first_part(path) in OPEN for path in hidden)
