"""How much the service serves, beside an empty endpoint of FastAPI on the same machine in the same run.

    python -m benchmarks.load [--seconds 20] [--connections 16] [--json FILE]

For `/translate` with texts that differ, in an environment and without one, and for `/policies/{id}/step`: requests a
second at saturation by wrk, the share of what the empty endpoint serves right before, and then the latency at half of
that load. Translations are measured twice. "Heard before" is a fleet that repeats itself: each text was sent once, and
the service gives its answer again. "Never heard" is the other end: the service keeps no answer
(CQLTL_TRANSLATION_CACHE_BYTES=0), and the networks read every text.

For the latency, requests are sent at fixed times, whatever became of those before (an open loop); each is timed from
when it was due, so a queue that builds up is seen. Load generator and service share the machine's cores.

The exit status is 1 where a request failed, or where a share or a latency is not what `PROMISED` says.
"""

from __future__ import annotations

import argparse
import asyncio
import itertools
import json
import os
import platform
import re
import shutil
import statistics
import subprocess
import sys
import tempfile
from collections import deque
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from dataclasses import asdict, dataclass
from pathlib import Path
from urllib.parse import urlsplit

import httpx

from benchmarks.server import serving

THINGS = ("sphere", "cylinder", "bag", "ball", "cube", "box")
ROOMS = ("kitchen", "bedroom", "bathroom", "living room")
WORDINGS = (
    "pick up the {thing}",
    "go to the {room}",
    "please go and get the {thing}",
    "put the {thing} in the box, then put the box in the {room}",
    "I would like you to visit the {room}",
    "go to the {room} but never touch the {thing}",
    "fetch the {thing} and then go to the {room}",
)
PLACES = (("/translate", None), ("/translate in an environment", "toys"))
PROMISED = {"/policies/{id}/step": (0.70, 10.0), "/translate, heard before": (0.40, 50.0)}
"""The least share of what the empty endpoint serves, and the most milliseconds of the 99th percentile at half load."""
WRK = """
local bodies = {}
for line in io.lines("BODIES") do bodies[#bodies + 1] = line end
wrk.method = "POST"
wrk.headers["Content-Type"] = "application/json"
local number = 0
request = function()
  number = number % #bodies + 1
  return wrk.format(nil, nil, nil, bodies[number])
end
done = function(summary, latency, requests)
  local errors = summary.errors
  io.write(string.format("CQLTL %d %d %d\\n", summary.requests, summary.duration,
    errors.status + errors.connect + errors.read + errors.write + errors.timeout))
end
"""


@dataclass(frozen=True)
class Row:
    """What was measured of one kind of request."""

    request: str
    served: float
    """Requests a second at saturation."""
    empty: float
    """The same of the empty endpoint, right before."""
    errors: int
    half_p50_ms: float
    half_p99_ms: float
    empty_p99_ms: float
    """The same of the empty endpoint at that very rate."""


def bodies(environment: str | None) -> list[str]:
    """Translations of every wording with every thing and room, in an order that mixes them."""
    texts = {w.format(thing=t, room=r) for t, r, w in itertools.product(THINGS, ROOMS, WORDINGS)}
    named = {} if environment is None else {"environment": environment}
    return [json.dumps({"text": text, **named}) for text in sorted(texts, key=lambda text: hash_of(text))]


def hash_of(text: str) -> int:
    """The same in every run, unlike `hash`."""
    return int.from_bytes(text.encode(), "big") % 10_007


@contextmanager
def empty_endpoint() -> Iterator[str]:
    """The address of the yardstick."""
    command = [sys.executable, "-m", "benchmarks.empty"]
    with subprocess.Popen(command, stdout=subprocess.PIPE, text=True) as process:
        try:
            assert process.stdout is not None
            yield process.stdout.readline().split()[1]
        finally:
            process.terminate()


def saturate(url: str, sent: Sequence[str], seconds: float, connections: int) -> tuple[float, int]:
    """Requests a second that wrk gets answered, and how many were not answered 2xx."""
    with tempfile.TemporaryDirectory() as folder:
        lines, script = Path(folder) / "bodies", Path(folder) / "post.lua"
        lines.write_text("\n".join(sent) + "\n", encoding="utf-8")
        script.write_text(WRK.replace("BODIES", str(lines)), encoding="utf-8")
        command = ["wrk", "--threads", "1", "--connections", str(connections), "--duration", f"{seconds:.0f}s"]
        said = subprocess.run([*command, "--timeout", "30s", "--script", script, url], check=True, capture_output=True)
    found = re.search(r"^CQLTL (\d+) (\d+) (\d+)$", said.stdout.decode(), re.MULTILINE)
    assert found is not None, said.stdout.decode()
    requests, microseconds, errors = map(int, found.groups())
    return requests / microseconds * 1e6, errors


class _Asker(asyncio.Protocol):
    """A connection that asks one thing at a time; plain, so that asking costs less than answering."""

    def __init__(self, taken: list[float], answered: Callable[[_Asker], None]) -> None:
        self._taken, self._answered = taken, answered
        self._loop = asyncio.get_running_loop()
        self._due, self._received = 0.0, b""
        self.lost = False

    def connection_made(self, transport: asyncio.BaseTransport) -> None:
        assert isinstance(transport, asyncio.Transport)
        self._transport = transport

    def ask(self, due: float, request: bytes) -> None:
        """Send a request that was due at a time of the loop."""
        self._due = due
        self._transport.write(request)

    def data_received(self, data: bytes) -> None:
        self._received += data
        head, found, body = self._received.partition(b"\r\n\r\n")
        if not found:
            return
        length = re.search(rb"(?i)content-length: (\d+)", head)
        assert length is not None, head
        if len(body) < int(length.group(1)):
            return
        assert head.split(b" ", 2)[1] == b"200", self._received
        self._taken.append((self._loop.time() - self._due) * 1000)
        self._received = b""
        self._answered(self)

    def connection_lost(self, exc: Exception | None) -> None:  # noqa: ARG002 - asyncio's
        self.lost = True

    def close(self) -> None:
        self._transport.close()


async def paced(url: str, sent: Sequence[str], seconds: float, rate: float, connections: int = 16) -> list[float]:
    """Milliseconds from when each request was due until it was answered, at so many a second.

    What finds every connection busy waits for one, and that counts.
    """
    parts = urlsplit(url)
    host, port = parts.hostname or "", parts.port or 80
    head = f"POST {parts.path} HTTP/1.1\r\nHost: {parts.netloc}\r\nContent-Type: application/json\r\n"
    requests = [f"{head}Content-Length: {len(body.encode())}\r\n\r\n{body}".encode() for body in sent]
    loop = asyncio.get_running_loop()
    taken: list[float] = []
    waiting: deque[tuple[float, bytes]] = deque()
    idle: list[_Asker] = []
    opening: set[asyncio.Task[None]] = set()

    def answered(asker: _Asker) -> None:
        if waiting:
            asker.ask(*waiting.popleft())
        else:
            idle.append(asker)

    async def another() -> None:
        _, asker = await loop.create_connection(lambda: _Asker(taken, answered), host, port)
        answered(asker)

    await asyncio.gather(*(another() for _ in range(connections)))
    count, began = int(seconds * rate), loop.time()
    for number in range(count):
        due = began + number / rate
        if due > loop.time():
            await asyncio.sleep(due - loop.time())
        while idle and idle[-1].lost:  # not used for so long that the service closed it
            idle.pop()
            opening.add(task := asyncio.create_task(another()))
            task.add_done_callback(opening.discard)
        request = requests[number % len(requests)]
        if idle:
            idle.pop().ask(due, request)
        else:
            waiting.append((due, request))
    while len(taken) < count:
        assert loop.time() < began + seconds + 60, f"{count - len(taken)} requests were not answered"
        await asyncio.sleep(0.01)
    for asker in idle:
        asker.close()
    return taken


def measure(request: str, url: str, sent: Sequence[str], empty: str, seconds: float, connections: int) -> Row:
    """One row; the empty endpoint gets the same bodies."""
    idle, _ = saturate(f"{empty}/empty", sent, seconds / 2, connections)
    served, errors = saturate(url, sent, seconds, connections)
    # The yardstick at the same rate shows what of the latency is the machine's and the load generator's.
    nothing = asyncio.run(paced(f"{empty}/empty", sent, seconds / 2, served / 2, connections))
    taken = asyncio.run(paced(url, sent, seconds, served / 2, connections))
    return Row(request, served, idle, errors, statistics.median(taken), _p99(taken), _p99(nothing))


def broken(rows: Sequence[Row]) -> list[str]:
    """What is not as promised."""
    found = [f"{row.request}: {row.errors} errors" for row in rows if row.errors]
    for row in rows:
        share, p99_ms = PROMISED.get(row.request, (0.0, float("inf")))
        if row.served < share * row.empty:
            found.append(f"{row.request}: {row.served / row.empty:.0%} of an empty endpoint, not {share:.0%}")
        if row.half_p99_ms > p99_ms:
            found.append(f"{row.request}: p99 of {row.half_p99_ms:.0f} ms at half load, not {p99_ms:.0f} ms")
    return found


def _p99(taken: Sequence[float]) -> float:
    return statistics.quantiles(taken, n=100)[98]


def main(arguments: Sequence[str] | None = None) -> None:
    """Measure and print the table."""
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0] if __doc__ else None)
    parser.add_argument("--seconds", type=float, default=20.0, help="of each measurement")
    parser.add_argument("--connections", type=int, default=16)
    parser.add_argument("--json", type=Path)
    options = parser.parse_args(arguments)
    if shutil.which("wrk") is None:
        sys.exit("wrk is missing (Debian and Ubuntu: apt install wrk)")
    with empty_endpoint() as empty:

        def measured(client: httpx.Client, name: str, path: str, sent: Sequence[str]) -> Row:
            for body in sent:
                client.post(path, content=body, headers={"Content-Type": "application/json"}).raise_for_status()
            url = str(client.base_url).rstrip("/") + path
            return measure(name, url, sent, empty, options.seconds, options.connections)

        with serving() as client:
            rows = [measured(client, "/policies/{id}/step", *step(client))]
            rows += [measured(client, f"{name}, heard before", "/translate", bodies(place)) for name, place in PLACES]
        with serving(CQLTL_TRANSLATION_CACHE_BYTES="0") as client:
            rows += [measured(client, f"{name}, never heard", "/translate", bodies(place)) for name, place in PLACES]
    print(f"{os.cpu_count()} cores; Python {platform.python_version()}, {platform.machine()}\n")
    print(
        "| request | served | empty endpoint | share | errors | median at half load | p99 at half load "
        "| p99 of the empty endpoint at that rate |"
    )
    print("|---" * 8 + "|")
    for row in rows:
        print(
            f"| {row.request} | {row.served:.0f}/s | {row.empty:.0f}/s | {row.served / row.empty:.0%} | {row.errors} "
            f"| {row.half_p50_ms:.1f} ms | {row.half_p99_ms:.1f} ms | {row.empty_p99_ms:.1f} ms |"
        )
    if options.json:
        options.json.write_text(json.dumps([asdict(row) for row in rows], indent=1) + "\n", encoding="utf-8")
    if found := broken(rows):
        sys.exit("\n".join(found))


def step(client: httpx.Client) -> tuple[str, list[str]]:
    """A policy's path, and the states of its run."""
    said = {"text": "Put the cylinder in the box, then put the box in the bedroom", "environment": "toys-4x1-cylinder"}
    plan = client.post("/plan", json=said, headers={"Prefer": "wait=60"}).raise_for_status().json()
    observed = [{"state": place["state"], "memory": place["memory"]} for place in plan["trajectory"]]
    return f"{plan['policy']['url']}/step", [json.dumps(body) for body in observed]


if __name__ == "__main__":
    main()
