"""The load benchmark: what it sends differs, and its clock starts when a request is due."""

from __future__ import annotations

import asyncio
import json
import shutil
import time

import httpx
import pytest

from benchmarks.load import Row, bodies, broken, empty_endpoint, paced, saturate


def test_the_texts_differ_and_are_the_same_in_every_run() -> None:
    found = [json.loads(body) for body in bodies("toys")]
    assert len({body["text"] for body in found}) == len(found) > 50
    assert {body["environment"] for body in found} == {"toys"}
    assert bodies("toys") == bodies("toys")
    assert "environment" not in json.loads(bodies(None)[0])


def test_the_yardstick_answers_and_can_be_saturated() -> None:
    if shutil.which("wrk") is None:
        pytest.skip("no wrk (Debian and Ubuntu: apt install wrk)")
    with empty_endpoint() as url:
        assert httpx.post(f"{url}/empty").json() == {"done": True}
        served, errors = saturate(f"{url}/empty", ["{}", '{"a": 1}'], seconds=1, connections=4)
    assert served > 10
    assert errors == 0


@pytest.mark.parametrize(
    ("served", "errors", "p99_ms", "faults"),
    [(4_000, 0, 20, 0), (3_000, 0, 20, 1), (4_000, 1, 20, 1), (4_000, 0, 60, 1), (3_000, 2, 60, 3)],
)
def test_what_is_not_as_promised_is_told(served: float, errors: int, p99_ms: float, faults: int) -> None:
    row = Row("/translate, heard before", served, 8_000, errors, 1.0, p99_ms, 1.0)
    assert len(broken([row])) == faults


def test_latency_counts_from_when_a_request_was_due() -> None:
    """One answer at a time, 50 ms each, at 40 a second: the queue grows by 25 ms with every request."""

    async def measure() -> list[float]:
        lock = asyncio.Lock()

        async def serve(reader: asyncio.StreamReader, writer: asyncio.StreamWriter) -> None:
            while head := await reader.readuntil(b"\r\n\r\n") if not reader.at_eof() else b"":
                assert b"Content-Length: 2" in head
                await reader.readexactly(2)
                async with lock:
                    await asyncio.sleep(0.05)
                writer.write(b"HTTP/1.1 200 OK\r\ncontent-length: 2\r\n\r\n{}")

        async def connected(reader: asyncio.StreamReader, writer: asyncio.StreamWriter) -> None:
            try:
                await serve(reader, writer)
            except asyncio.IncompleteReadError:
                pass
            finally:
                writer.close()

        server = await asyncio.start_server(connected, "127.0.0.1", 0)
        async with server:
            port = server.sockets[0].getsockname()[1]
            return await paced(f"http://127.0.0.1:{port}/x", ["{}"], seconds=0.5, rate=40)

    began = time.monotonic()
    taken = asyncio.run(measure())
    assert len(taken) == 20
    assert time.monotonic() - began >= 1.0
    assert max(taken) >= 20 * 50 - 500 - 1
    assert min(taken) < max(taken) / 2
