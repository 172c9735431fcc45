"""Requests that mean harm, or nothing: always 4xx with a problem, never 5xx, never a hang."""

from __future__ import annotations

import concurrent.futures
import gzip
import socket
import time

import httpx
import pytest

from tests.service.conftest import check_problem

ROUTES = [
    "/translate",
    "/translate/batch",
    "/learn",
    "/ground",
    "/explain",
    "/plan",
    "/environments",
    "/policies/x/step",
    "/policies/x/simulate",
]
LESSON = {"contextual_query": "hold(sphere)", "environment": "toys"}


def deep(text: str, depth: int) -> str:
    return "(" * depth + text + ")" * depth


HOSTILE = {
    "megabyte-name": "F " + "a" * 1_000_000,
    "megabyte-conjunction": " & ".join(["a"] * 250_000),
    "ten-thousand-parentheses": deep("a", 10_000),
    "unclosed-parentheses": "(" * 10_000,
    "ten-thousand-nots": "!" * 10_000 + "a",
    "sixty-thousand-nots": "!" * 60_000 + "a",
    "long-chain": " -> ".join(["a"] * 9_000),
    "nested-untils": " U ".join(["a"] * 9_000),
    "prefix-bomb": "& " * 20_000 + "a " * 20_001,
    "nul": "F \x00",
    "only-space": " " * 60_000,
    "latex-bomb": r"\left(" * 5_000,
    "quotes": '"' * 9_999,
}


@pytest.mark.parametrize("name", HOSTILE)
@pytest.mark.parametrize("route", ["/plan", "/learn", "/explain"])
def test_hostile_formulas(client: httpx.Client, route: str, name: str) -> None:
    body = {"ltl": HOSTILE[name], "environment": "toys"} | (LESSON if route == "/learn" else {})
    started = time.monotonic()
    response = client.post(route, json=body)
    assert 400 <= response.status_code < 500, response.text[:500]
    slug = response.json()["type"].removeprefix("urn:cqltl:problem:")
    check_problem(response, slug, response.status_code)
    assert slug in {"formula-syntax", "formula-too-large", "validation", "body-too-large", "unknown-proposition"}
    assert time.monotonic() - started < 10


def test_a_formula_whose_automaton_explodes_is_stopped(client: httpx.Client) -> None:
    """A deterministic automaton for this needs some 2^(2^n) states."""
    toys = ("cylinder", "sphere", "orange", "bag")
    nested = " & ".join(
        f"F (holding({a}) & (X in({b}, box) U (in({a}, box) & X X X F holding({b}))))"
        for a in toys
        for b in toys
        if a != b
    )
    started = time.monotonic()
    response = client.post("/plan", json={"ltl": nested, "environment": "toys", "options": {"timeout_s": 2}})
    assert 400 <= response.status_code < 500, response.text
    assert time.monotonic() - started < 15
    assert client.get("/livez").status_code == 200


@pytest.mark.parametrize("route", ROUTES)
@pytest.mark.parametrize(
    "body",
    [b"", b"{", b"nonsense", b'{"text": }', b"\xff\xfe", b"[" * 100_000, b'{"a":' * 50_000, b'{"text": "\\ud800"}'],
    ids=["empty", "brace", "word", "gap", "not-utf8", "deep-array", "deep-object", "lone-surrogate"],
)
def test_malformed_json(client: httpx.Client, route: str, body: bytes) -> None:
    response = client.post(route, content=body, headers={"content-type": "application/json"})
    assert 400 <= response.status_code < 500, response.text[:500]
    slug = response.json()["type"].removeprefix("urn:cqltl:problem:")
    check_problem(response, slug, response.status_code)


@pytest.mark.parametrize("route", ROUTES)
@pytest.mark.parametrize("body", [None, 7, "text", [], {"unknown": 1}, {"text": ["a"]}, {"text": {}}, float(10**300)])
def test_wrong_types(client: httpx.Client, route: str, body: object) -> None:
    response = client.post(route, json=body)
    assert response.status_code in (404, 422), response.text[:500]
    check_problem(response, "validation", 422)


@pytest.mark.parametrize("number", ["NaN", "Infinity", "-Infinity", "1e999"])
def test_numbers_that_are_none(client: httpx.Client, number: str) -> None:
    text = '{"ltl": "F holding(sphere)", "environment": "toys", "options": {"epsilon": %s}}' % number  # noqa: UP031
    response = client.post("/plan", content=text, headers={"content-type": "application/json"})
    if number == "1e999":  # it is JSON
        check_problem(response, "validation", 422, ["/options/epsilon"])
    else:
        assert number in check_problem(response, "malformed-json", 400)["detail"]


BODIES = {
    "twice": (b'{"text": "go", "text": "stay"}', "malformed-json", 400),
    "deep": (b'{"text":' + b"[" * 65 + b"]" * 65 + b"}", "body-too-deep", 422),
    "nul": (rb'{"text": "go\u0000"}', "validation", 422),
    "surrogate": (rb'{"text": "go\udc00"}', "validation", 422),
    "utf-16": ('{"text": "go"}'.encode("utf-16"), "malformed-json", 400),
}


@pytest.mark.parametrize("name", BODIES)
@pytest.mark.parametrize("route", ROUTES)
def test_bodies_that_are_unclear(client: httpx.Client, route: str, name: str) -> None:
    body, slug, status = BODIES[name]
    check_problem(client.post(route, content=body, headers={"content-type": "application/json"}), slug, status)


@pytest.mark.parametrize("encoding", ["gzip", "deflate", "br", "identity, gzip"])
def test_a_compressed_body_is_refused_unread(client: httpx.Client, encoding: str) -> None:
    bomb = gzip.compress(b'{"text": "' + b"a" * 200_000_000 + b'"}', compresslevel=1)
    headers = {"content-type": "application/json", "content-encoding": encoding}
    check_problem(client.post("/translate", content=bomb, headers=headers), "unsupported-media-type", 415)


def test_a_body_beyond_the_limit_is_refused_whole(client: httpx.Client) -> None:
    check_problem(client.post("/translate", json={"text": "a" * 1_100_000}), "body-too-large", 413)


def test_a_body_of_unknown_length_is_counted(client: httpx.Client) -> None:
    chunks = (b'{"text": "' if number == 0 else b"a" * 10_000 for number in range(200))
    response = client.post("/translate", content=chunks, headers={"content-type": "application/json"})
    check_problem(response, "body-too-large", 413)


def test_a_body_whose_last_chunk_is_too_much(client: httpx.Client) -> None:
    chunks = iter([b'{"text": "' + b"a" * 1_048_000, b"a" * 1_000])
    response = client.post("/translate", content=chunks, headers={"content-type": "application/json"}, timeout=20)
    check_problem(response, "body-too-large", 413)


def test_unknown_paths_and_methods(client: httpx.Client) -> None:
    check_problem(client.get("/nowhere"), "not-found", 404)
    for path, methods in {"/translate": "POST", "/environments": "GET, POST", "/jobs": "GET"}.items():
        refused = client.patch(path)
        check_problem(refused, "method-not-allowed", 405)
        assert refused.headers["allow"] == methods
    assert client.patch("/environments/toys").headers["allow"] == "DELETE, GET, PUT"
    check_problem(client.get("/environments/" + "x" * 5_000), "unknown-environment", 404)
    check_problem(client.get("/environments/%00"), "unknown-environment", 404)


def test_a_body_that_is_not_marked_as_json(client: httpx.Client) -> None:
    text = '{"text": "Pickup the sphere"}'
    for media_type in ("application/x-www-form-urlencoded", "text/plain"):
        response = client.post("/translate", content=text, headers={"content-type": media_type})
        check_problem(response, "unsupported-media-type", 415)


def test_malformed_json_has_line_and_column(client: httpx.Client) -> None:
    text = '{"text": "Pickup the sphere",\n "environment" "toys"}'
    response = client.post("/translate", content=text, headers={"content-type": "application/json"})
    problem = check_problem(response, "malformed-json", 400)
    assert (problem["line"], problem["column"]) == (2, 16)
    assert problem["caret"] == ' "environment" "toys"}\n               ^'


def test_the_server_answers_while_it_plans(client: httpx.Client) -> None:
    body = {
        "ltl": "G F in(cylinder, box) & G F !in(cylinder, box) & G F holding(sphere)",
        "environment": "toys",
        "options": {"timeout_s": 20, "relevance": False},
    }
    with concurrent.futures.ThreadPoolExecutor() as pool:
        plans = [pool.submit(client.post, "/plan", json=body) for _ in range(4)]
        waits = []
        while not all(plan.done() for plan in plans):
            started = time.monotonic()
            assert client.get("/livez").status_code == 200
            waits.append(time.monotonic() - started)
            time.sleep(0.02)
    assert all(plan.result().status_code == 200 for plan in plans)
    assert len(waits) > 3
    assert max(waits) < 2


def test_a_client_that_hangs_up_harms_nobody(client: httpx.Client) -> None:
    host, port = client.base_url.host, client.base_url.port
    for _ in range(5):
        with socket.create_connection((host, port)) as raw:
            raw.sendall(
                b"POST /plan HTTP/1.1\r\nHost: x\r\nContent-Type: application/json\r\nContent-Length: 100\r\n\r\n{"
            )
    assert client.get("/readyz").json() == {"status": "ok"}
