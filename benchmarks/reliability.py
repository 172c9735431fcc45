"""What a service loses, and what it gathers: kills under load, concurrent writers, a long run.

    python -m benchmarks.reliability [--kills 200] [--writes 300] [--requests 10000] [--jobs 500] [--seed 0]

- *kills*: SIGKILL at random moments while four clients write, and every tenth time while it starts. Each record whose
  request was answered (environment, template, job) is asked for at the end, and the file checked by SQLite each time.
- *writers*: eight clients on two services with one file, each with `--writes` writes; answers that are not 2xx count.
- *soak*: file descriptors, threads and memory of the service, before and after `--requests` requests and `--jobs` jobs.

Prints a line each and ends with status 1 if one is not as it should be. 0 leaves one out.
"""

from __future__ import annotations

import argparse
import random
import shutil
import sqlite3
import sys
import tempfile
import threading
import time
from collections.abc import Callable, Sequence
from contextlib import ExitStack
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import httpx

from benchmarks.processes import Usage, usage
from benchmarks.server import address, serving, started

FILE = "cqltl.sqlite3"
LONGEST_S = 1.0
"""Of writing before a kill."""
WARM = 0.1
"""The share of a soak that is run before the first look."""

Record = tuple[str, dict[str, Any]]
"""Where an acknowledged record is found, and what it is there with."""
Write = Callable[[httpx.Client, str], Record]


def world(name: str) -> dict[str, Any]:
    """An environment of two states, with a name."""
    go = {"from": 0, "action": "go", "to": [[1, 0.9], [0, 0.1]]}
    return {"kind": "explicit", "name": name, "states": 2, "labels": {"goal": [1]}, "transitions": [go]}


def add_environment(client: httpx.Client, name: str) -> Record:
    """Store an environment."""
    answer = client.post("/environments", json=world(name)).raise_for_status().json()
    return f"/environments/{name}", {"spec": answer["spec"]}


def learn(client: httpx.Client, name: str) -> Record:
    """Teach a task."""
    lesson = {"contextual_query": f"{name}(sphere)", "ltl": "F holding(sphere)", "environment": "toys"}
    answer = client.post("/learn", json=lesson).raise_for_status().json()
    return f"/templates/{name}", {"template": answer["template"]}


def order(client: httpx.Client, name: str) -> Record:
    """Have a plan made as a job."""
    body = {"ltl": "F goal", "environment_spec": world(name)}
    answer = client.post("/plan", json=body, headers={"Prefer": "respond-async"})
    if answer.status_code == 503:  # as many wait as may: nothing was accepted, try again
        time.sleep(0.05)
        return order(client, name)
    made = answer.raise_for_status().json()
    if answer.status_code == 200:  # planned before the service had a look whether it is to wait
        return str(made["policy"]["url"]), {"ltl": "F goal"}
    return str(made["url"]), {"state": "succeeded"}


@dataclass
class Writers:
    """Clients that write until the service is gone."""

    records: list[Record] = field(default_factory=list)
    refused: list[str] = field(default_factory=list)
    _threads: list[threading.Thread] = field(default_factory=list)

    def start(self, url: str, prefix: str, writes: Sequence[Write]) -> None:
        """Each kind of write by a client of its own."""
        for number, write in enumerate(writes):
            thread = threading.Thread(target=self._run, args=(url, f"{prefix}_{number}", write))
            self._threads.append(thread)
            thread.start()

    def join(self) -> None:
        """Wait for all to notice."""
        for thread in self._threads:
            thread.join()
        self._threads.clear()

    def _run(self, url: str, prefix: str, write: Write) -> None:
        with httpx.Client(base_url=url, timeout=30) as client:
            for number in range(1_000_000):
                try:
                    self.records.append(write(client, f"{prefix}_{number}"))
                except httpx.HTTPStatusError as error:
                    self.refused.append(f"{error.response.status_code} {error.response.text[:200]}")
                except httpx.TransportError:
                    return


@dataclass(frozen=True)
class Survival:
    """What became of acknowledged records."""

    kills: int
    acknowledged: int
    lost: list[str]
    refused: list[str]
    corrupt: list[str]

    @property
    def good(self) -> bool:
        """Nothing is lost or broken, and something was written."""
        return self.acknowledged >= self.kills and not (self.lost or self.refused or self.corrupt)


def survive(folder: Path, kills: int, seed: int = 0) -> Survival:
    """Kill services with their store in `folder`, one after the other, and look for what they had acknowledged."""
    draw = random.Random(seed)
    writers, corrupt = Writers(), list[str]()
    start_s = 2.0
    for number in range(kills):
        began = time.monotonic()
        with started(folder, CQLTL_WORKERS="1", CQLTL_JOB_LEASE_S="2") as process:
            if number % 10 == 9:
                time.sleep(draw.uniform(0, start_s))
            else:
                url = address(process)
                start_s = time.monotonic() - began
                writers.start(url, f"w{number}", (add_environment, add_environment, learn, order))
                time.sleep(draw.uniform(0, LONGEST_S))
            process.kill()
            process.wait()
        writers.join()
        corrupt += _problems(folder)
    with serving(folder) as client:
        lost = [path for path, said in writers.records if not _found(client, path, said)]
    return Survival(kills, len(writers.records), lost, writers.refused, corrupt + _problems(folder))


def _problems(folder: Path) -> list[str]:
    """What SQLite finds wrong in a copy of the file as it lies there, write-ahead log and all."""
    with tempfile.TemporaryDirectory() as copy:
        for path in folder.glob(f"{FILE}*"):
            shutil.copy(path, copy)
        store = sqlite3.connect(Path(copy) / FILE)
        try:
            found = [str(row[0]) for row in store.execute("PRAGMA integrity_check")]
        except sqlite3.DatabaseError as error:
            found = [str(error)]
        finally:
            store.close()
    return [] if found == ["ok"] else found


def _found(client: httpx.Client, path: str, said: dict[str, Any], within_s: float = 120.0) -> bool:
    """The record is there as it was acknowledged; a job once it has ended."""
    until = time.monotonic() + within_s
    while True:
        answer = client.get(path).json()
        if answer.get("state") not in ("queued", "running") or time.monotonic() > until:
            return all(answer.get(name) == value for name, value in said.items())
        time.sleep(0.05)


def write_at_once(folder: Path, writes: int, writers: int = 8) -> list[str]:
    """What is not answered 2xx of so many writes by each writer, on two services with one store."""
    failures: list[str] = []
    kinds = (add_environment, learn)

    def write(url: str, number: int) -> None:
        with httpx.Client(base_url=url, timeout=60) as client:
            for each in range(writes):
                try:
                    kinds[(number // 2) % 2](client, f"writer{number}_{each}")
                except httpx.HTTPError as error:
                    failures.append(repr(error))

    with ExitStack() as stack:
        urls = [address(stack.enter_context(started(folder, CQLTL_WORKERS="1"))) for _ in range(2)]
        threads = [threading.Thread(target=write, args=(urls[n % 2], n)) for n in range(writers)]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
    return failures


@dataclass(frozen=True)
class Soak:
    """The service's usage before and after."""

    before: Usage
    after: Usage

    @property
    def good(self) -> bool:
        """At most two descriptors and threads more, and 5 % more memory."""
        return (
            self.after.descriptors <= self.before.descriptors + 2
            and self.after.threads <= self.before.threads + 2
            and self.after.memory <= 1.05 * self.before.memory
        )


def soak(folder: Path, requests: int, jobs: int) -> Soak:
    """Run a service for so many requests and jobs, after a tenth as many more that warm it up."""
    with started(folder) as process, httpx.Client(base_url=address(process), timeout=120) as client:
        _use(client, int(requests * WARM), int(jobs * WARM), "warm")
        before = _settled(process.pid)
        _use(client, requests, jobs, "soak")
        return Soak(before, _settled(process.pid))


def _use(client: httpx.Client, requests: int, jobs: int, prefix: str) -> None:
    """Translations of varied texts, steps, reads and refusals; and jobs, waited for."""
    body = {"text": "Pickup the sphere", "environment": "toys-4x1-sphere"}
    plan = client.post("/plan", json=body, headers={"Prefer": "wait=60"}).raise_for_status().json()
    state = {"state": plan["initial"]["state"], "memory": 0}
    for number in range(requests):
        match number % 5:
            case 0:
                text = f"go to the room number {number} and pick up the sphere"
                client.post("/translate", json={"text": text, "environment": "toys"}).raise_for_status()
            case 1 | 2:
                client.post(f"{plan['policy']['url']}/step", json=state).raise_for_status()
            case 3:
                client.get("/templates/ship").raise_for_status()
            case _:
                assert client.post("/ground", json={"contextual_query": "?", "environment": "toys"}).status_code == 422
    for number in range(jobs):
        path, said = order(client, f"{prefix}_{number}")
        assert _found(client, path, said), path


def _settled(pid: int) -> Usage:
    """The usage once connections and caches are done with."""
    time.sleep(3)
    return usage(pid)


def main(arguments: Sequence[str] | None = None) -> None:
    """Run what is asked for, and print what came of it."""
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0] if __doc__ else None)
    parser.add_argument("--kills", type=int, default=200)
    parser.add_argument("--writes", type=int, default=300)
    parser.add_argument("--requests", type=int, default=10_000)
    parser.add_argument("--jobs", type=int, default=500)
    parser.add_argument("--seed", type=int, default=0)
    options = parser.parse_args(arguments)
    good = True
    if options.kills:
        with tempfile.TemporaryDirectory() as folder:
            found = survive(Path(folder), options.kills, options.seed)
        good &= found.good
        print(f"{found.kills} kills: {found.acknowledged} records acknowledged, {len(found.lost)} lost")
        print(*found.lost, *found.refused, *found.corrupt, sep="\n", end="")
    if options.writes:
        with tempfile.TemporaryDirectory() as folder:
            failures = write_at_once(Path(folder), options.writes)
        good &= not failures
        print(f"8 writers, {options.writes} writes each: {len(failures)} errors", *failures[:10], sep="\n")
    if options.requests:
        with tempfile.TemporaryDirectory() as folder:
            long = soak(Path(folder), options.requests, options.jobs)
        good &= long.good
        print(f"{options.requests} requests and {options.jobs} jobs: {long.before} before, {long.after} after")
    sys.exit(0 if good else 1)


if __name__ == "__main__":
    main()
