"""How soon a plan stops that is cancelled, or whose time is up, whatever it is at.

    python -m benchmarks.stopping [--times 12] [--seed 0]

Plans that each take a while at something else are ordered from a server of its own, `--times` times each:

- *cancelled*: as jobs, at moments spread over the first seconds of each. From the request to cancel until the process
  that planned is gone; and the memory of the service with all below it before and after, once all were cancelled.
- *out of time*: with a `timeout_s` spread over the same seconds. By how much the answer is late, be it a plan with
  bounds or the refusal.

Prints for each stage of planning (docs/http.md) how often it was hit, and the median and the longest of the times. Ends
with status 1 where one is beyond a second, or more than 5 % of memory does not come back.
"""

from __future__ import annotations

import argparse
import random
import statistics
import sys
import tempfile
import time
from collections import defaultdict
from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import Any

import httpx

from benchmarks.hostile import HOSTILE
from benchmarks.processes import alive, busiest, grandchildren, usage
from benchmarks.server import address, started
from models.world import toys_spec

MOST_S = 1.0
"""What is promised."""
LEAST_TIME_S = 0.2
"""The shortest `timeout_s` that is tried."""
Times = dict[str, list[float]]
"""Seconds by stage."""


def world(columns: int, rows: int, slip: float) -> dict[str, Any]:
    """Two toys in a grid."""
    toys = [("sphere", "red"), ("cube", "red")]
    return {**toys_spec(columns=columns, rows=rows, toys=toys, slip=slip), "name": f"grid-{columns}x{rows}"}


GRID = world(7, 6, 0.1)
PLANS: dict[str, tuple[dict[str, Any], float]] = {
    "an automaton that explodes": ({"ltl": HOSTILE[0], "environment": "toys"}, 3.0),
    "again and again": ({"ltl": "G F holding(sphere) & G F holding(cube)", "environment_spec": GRID}, 12.0),
    "one after the other": ({"ltl": "F (holding(sphere) & F holding(cube))", "environment_spec": GRID}, 4.0),
    "often slipping": ({"ltl": "F (holding(sphere) & F holding(cube))", "environment_spec": world(7, 6, 0.9)}, 6.0),
}
"""Requests, and the seconds over which the moments are spread."""


def orders(times: int, seed: int) -> Iterator[tuple[dict[str, Any], float]]:
    """Each plan `times` times, with a moment in each of as many equal parts of its seconds."""
    draw = random.Random(seed)
    for body, seconds in PLANS.values():
        for part in range(times):
            yield body, seconds * (part + draw.random()) / times


def ordered(body: dict[str, Any], **options: Any) -> dict[str, Any]:
    """A request with options; nothing of the world is left out, so that it takes its time."""
    return {**body, "options": {"relevance": False, **options}}


def cancelled(client: httpx.Client, server: int, times: int, seed: int) -> Times:
    """From the request to cancel until the process is gone, by the stage that the job was at."""
    found: Times = defaultdict(list)
    for body, moment in orders(times, seed):
        job = client.post("/plan", json=ordered(body), headers={"Prefer": "respond-async"}).raise_for_status().json()
        if "url" not in job:
            continue  # planned before it could become a job
        time.sleep(moment)
        child = busiest(grandchildren(server), 0.1)
        stage = client.get(job["url"]).json()["progress"]["stage"] or "before"
        began = time.monotonic()
        ended = client.post(f"{job['url']}/cancel").raise_for_status().json()
        if ended["state"] != "cancelled":
            continue  # planned by then
        while alive(child):
            time.sleep(0.001)
        found[stage].append(time.monotonic() - began)
    return found


def out_of_time(client: httpx.Client, times: int, seed: int) -> Times:
    """By how much answers are late, by what they are: a plan, or the refusal."""
    found: Times = defaultdict(list)
    for body, moment in orders(times, seed):
        limit = max(LEAST_TIME_S, moment)
        began = time.monotonic()
        answer = client.post("/plan", json=ordered(body, timeout_s=limit), headers={"Prefer": "wait=60"}).json()
        late = time.monotonic() - began - limit
        found["a plan" if "outcome" in answer else answer["type"].rpartition(":")[2]].append(late)
    return found


def settled(server: int) -> int:
    """Bytes of memory of the service and all below it, once processes have been replaced."""
    time.sleep(4)
    return usage(server).memory


def report(title: str, times: Times) -> bool:
    """Print the times; whether all are within what is promised."""
    for name, seconds in sorted(times.items()):
        print(f"{title}, {name}: {len(seconds)} times, median {statistics.median(seconds):.2f} s, ", end="")
        print(f"longest {max(seconds):.2f} s")
    return max(max(seconds) for seconds in times.values()) <= MOST_S


def main(arguments: Sequence[str] | None = None) -> None:
    """Measure and print."""
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0] if __doc__ else None)
    parser.add_argument("--times", type=int, default=12)
    parser.add_argument("--seed", type=int, default=0)
    options = parser.parse_args(arguments)
    with (
        tempfile.TemporaryDirectory() as folder,
        started(Path(folder), CQLTL_WORKERS="1", CQLTL_POLICY_CACHE_BYTES="0") as process,
        httpx.Client(base_url=address(process), timeout=120) as client,
    ):
        cancelled(client, process.pid, 1, options.seed)  # warms up
        before = settled(process.pid)
        good = report("cancelled", cancelled(client, process.pid, options.times, options.seed))
        after = settled(process.pid)
        print(f"memory of the service and all below it: {before / 1e6:.0f} MB before, {after / 1e6:.0f} MB after")
        good &= after <= 1.05 * before
        good &= report("out of time", out_of_time(client, options.times, options.seed))
    sys.exit(0 if good else 1)


if __name__ == "__main__":
    main()
