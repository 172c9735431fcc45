"""Sockets whose clients never finish, and what is not HTTP."""

from __future__ import annotations

import json
import socket
import statistics
import threading
import time
from collections.abc import Iterator
from contextlib import ExitStack, contextmanager

import httpx
import pytest

from benchmarks.server import serving
from benchmarks.slow_clients import HEAD, KINDS, attack, timed
from service.http.protocol import MAX_PROBES

HEAD_S, BODY_S, KEPT_S = 1.0, 2.0, 1
MOST = 60
LIVE, READY = (b"GET /%b HTTP/1.1\r\nHost: x\r\n\r\n" % path for path in (b"livez", b"readyz"))


@pytest.fixture(scope="module")
def server(tmp_path_factory: pytest.TempPathFactory) -> Iterator[httpx.Client]:
    settings = {
        "CQLTL_HEAD_TIMEOUT_S": str(HEAD_S),
        "CQLTL_BODY_TIMEOUT_S": str(BODY_S),
        "CQLTL_KEEP_ALIVE_S": str(KEPT_S),
        "CQLTL_WRITE_TIMEOUT_S": "2",
        "CQLTL_MAX_CONNECTIONS": str(MOST),
    }
    with serving(tmp_path_factory.mktemp("data"), **settings) as found:
        yield found


def connected(client: httpx.Client) -> socket.socket:
    raw = socket.create_connection((client.base_url.host, client.base_url.port))
    raw.settimeout(10)
    return raw


def received(raw: socket.socket) -> bytes:
    """Everything until the server closes."""
    found = b""
    while part := raw.recv(65_536):
        found += part
    return found


def problem(answer: bytes) -> tuple[int, str]:
    """Status and slug of an answer as it came."""
    head, _, body = answer.partition(b"\r\n\r\n")
    assert b"content-type: application/problem+json" in head.lower()
    assert b"connection: close" in head.lower()
    for name in (b"x-request-id: ", b"x-content-type-options: nosniff", b"content-security-policy: default-src 'none'"):
        assert b"\r\n" + name in head.lower()
    found = json.loads(body)
    assert int(head.split()[1]) == found["status"]
    return found["status"], found["type"].rpartition(":")[2]


def test_slow_clients_are_closed_and_slow_down_nobody(server: httpx.Client) -> None:
    found, over = {}, threading.Event()

    def attacked() -> None:
        found.update(attack(server.base_url.host, server.base_url.port or 80, 40))
        over.set()

    attacker = threading.Thread(target=attacked)
    attacker.start()
    meanwhile = timed(server, over, 10)
    attacker.join()
    assert {kind: len(seconds) for kind, seconds in found.items()} == dict.fromkeys(KINDS, 8)
    for kind, seconds in found.items():
        deadline = BODY_S if "body" in kind else HEAD_S
        assert min(seconds) > 0.8 * deadline, kind
        assert max(seconds) < deadline + 3, kind
    assert statistics.median(meanwhile["livez"]) < 100


@pytest.mark.parametrize("kind", ["half head", "half body"])
def test_who_sent_half_a_request_is_told(server: httpx.Client, kind: str) -> None:
    with connected(server) as raw:
        raw.sendall(KINDS[kind][0])
        assert problem(received(raw)) == (408, "request-timeout")


def test_a_connection_that_idles_between_requests_is_closed(server: httpx.Client) -> None:
    with connected(server) as raw:
        for _ in range(2):
            raw.sendall(b"GET /livez HTTP/1.1\r\nHost: x\r\n\r\n")
            time.sleep(0.3)
        began = time.monotonic()
        assert received(raw).count(b"200 OK") == 2
        assert time.monotonic() - began < KEPT_S + 3


def test_a_second_head_that_drips_has_the_deadline_too(server: httpx.Client) -> None:
    with connected(server) as raw:
        raw.sendall(b"GET /livez HTTP/1.1\r\nHost: x\r\n\r\n")
        assert b"200 OK" in raw.recv(65_536)
        began = time.monotonic()
        try:
            while time.monotonic() < began + 10:
                raw.sendall(b"G")
                time.sleep(0.2)
        except OSError:
            pass
        assert time.monotonic() - began < HEAD_S + 3


def test_a_body_that_nobody_wants_is_not_read_for_ever(server: httpx.Client) -> None:
    with connected(server) as raw:
        raw.sendall(b"GET /livez HTTP/1.1\r\nHost: x\r\nTransfer-Encoding: chunked\r\n\r\n")
        began = time.monotonic()
        try:
            while time.monotonic() < began + 10:
                raw.sendall(b"1\r\nx\r\n")
                time.sleep(0.2)
        except OSError:
            pass
        assert time.monotonic() - began < BODY_S + HEAD_S + 3


def test_requests_in_a_row_are_answered_in_order(server: httpx.Client) -> None:
    with connected(server) as raw:
        body = b'{"text": "Pickup the sphere"}'
        one = HEAD.replace(b"50000", str(len(body)).encode()) + b"\r\n" + body
        raw.sendall(one + b"GET /livez HTTP/1.1\r\nHost: x\r\n\r\n" + one)
        answer = received(raw)
        assert answer.count(b"HTTP/1.1 200 OK") == 3
        assert answer.index(b"pickup") < answer.index(b'{"status":"ok"}') < answer.rindex(b"pickup")


def test_a_client_that_does_not_read_is_closed(server: httpx.Client) -> None:
    with connected(server) as raw:
        raw.setsockopt(socket.SOL_SOCKET, socket.SO_RCVBUF, 4_096)
        began = time.monotonic()
        try:
            while time.monotonic() < began + 20:
                raw.sendall(b"GET /openapi.json HTTP/1.1\r\nHost: x\r\n\r\n" * 50)
        except OSError:
            pass
        assert time.monotonic() - began < 15


@pytest.mark.parametrize(
    ("sent", "status"),
    [
        (b"nonsense\r\n\r\n", 400),
        (b"GET /livez HTTP/1.1\r\n\r\n", 400),
        (b"GET /livez HTTP/1.1\r\nHost: x\r\nX: " + b"a" * 40_000, 431),
        (b"POST /plan HTTP/1.1\r\nHost: x\r\nContent-Length: 1\r\nTransfer-Encoding: gzip\r\n\r\n", 501),
        (b"POST /plan HTTP/1.1\r\nHost: x\r\nContent-Length: 1, 2\r\n\r\n", 400),
        (b"POST /plan HTTP/1.1\r\nHost: x\r\nTransfer-Encoding: chunked\r\n\r\nzz\r\n", 400),
        (b"\x16\x03\x01\x02\x00\x01\x00\x01\xfc\x03\x03" + b"\r\n\r\n", 400),
    ],
    ids=["word", "no-host", "long-head", "encoding", "two-lengths", "chunk", "tls"],
)
def test_what_is_not_http(server: httpx.Client, sent: bytes, status: int) -> None:
    with connected(server) as raw:
        raw.sendall(sent)
        assert problem(received(raw)) == (status, "http-error")


@contextmanager
def crowd(server: httpx.Client, size: int) -> Iterator[socket.socket]:
    """One more connection than there are others, which are held for HEAD_S."""
    with ExitStack() as held:
        for _ in range(size):
            held.enter_context(connected(server))
        yield held.enter_context(connected(server))


def test_beyond_the_most_connections_livez_is_answered(server: httpx.Client) -> None:
    with crowd(server, MOST) as raw:
        for _ in range(2):
            raw.sendall(LIVE)
            answer = b""
            while not answer.endswith(b'{"status":"ok"}'):
                answer += raw.recv(65_536)
            assert answer.startswith(b"HTTP/1.1 200 OK")


@pytest.mark.parametrize(
    ("size", "asked"),
    [(MOST, READY), (MOST, LIVE + READY), (MOST, b"GET /livez"), (MOST + MAX_PROBES, b"")],
    ids=["something else", "something else too", "a part", "too late"],
)
def test_beyond_the_most_connections_nothing_else_is_answered(server: httpx.Client, size: int, asked: bytes) -> None:
    with crowd(server, size) as raw:
        raw.sendall(asked)
        answer = received(raw)
    assert problem(answer) == (503, "overloaded")
    assert b"retry-after:" in answer.lower()


def test_when_they_are_gone_all_is_answered(server: httpx.Client) -> None:
    with crowd(server, MOST):
        pass
    time.sleep(0.2)
    assert server.get("/readyz").status_code == 200
