"""A service as it is deployed, for the contract that both executors keep: processes that can be killed."""

from __future__ import annotations

import os
import signal
import subprocess
import sys
import time
from abc import ABC, abstractmethod
from contextlib import ExitStack
from pathlib import Path
from typing import Any

import httpx

from benchmarks.processes import busiest, grandchildren
from benchmarks.server import address, started
from models.world import toys_spec

LEASE_S = 2.0
PATIENCE_S = 600.0
"""Longest time for a plan: one that ran short of it on a busy machine would have other bounds than the next one."""
FORMULA = "G F holding(sphere) & G F holding(cube)"


def task(columns: int, rows: int, **options: Any) -> dict[str, Any]:
    """A request that plans in a world of that many cells, for some seconds from 5 x 4 on."""
    toys = [("sphere", "red"), ("cube", "red")]
    spec = {**toys_spec(columns=columns, rows=rows, toys=toys, slip=0.1), "name": f"grid-{columns}x{rows}"}
    options = {"relevance": False, "timeout_s": PATIENCE_S, **options}
    return {"ltl": FORMULA, "environment_spec": spec, "options": options}


QUICK = task(2, 1)
SLOW = task(6, 4)  # some 2 seconds
ENDLESS = task(7, 6)  # some 15 seconds: the tests do not wait for it


class Deployment(ABC):
    """Services on one store, and whoever plans for them."""

    def __init__(self, folder: Path, **environment: str) -> None:
        self.folder = folder
        self.environment = {
            "CQLTL_JOB_LEASE_S": str(LEASE_S),
            "CQLTL_PLAN_TIMEOUT_S": str(PATIENCE_S),
            **environment,
        }
        self._open = ExitStack()
        self.server = self.serve()
        self.client = self.connect(self.server)

    def serve(self) -> subprocess.Popen[str]:
        """Start a further service."""
        return self._open.enter_context(started(self.folder, **self.environment))

    def connect(self, server: subprocess.Popen[str]) -> httpx.Client:
        """A client of a service."""
        return self._open.enter_context(httpx.Client(base_url=address(server), timeout=60))

    @property
    @abstractmethod
    def planners(self) -> list[subprocess.Popen[str]]:
        """The processes below which plans are made, and that are still there."""

    @abstractmethod
    def add_planner(self) -> None:
        """Start a further one."""

    def kill_planners(self, number: int = signal.SIGKILL) -> None:
        """End all of them, so that new ones are needed."""
        for process in self.planners:
            process.send_signal(number)
            process.wait(30)

    def recover(self) -> None:
        """After `kill_planners`: serve again."""
        self.add_planner()

    def busy_child(self) -> int:
        """The process that plans just now."""
        return busiest(self.children)

    @property
    def children(self) -> set[int]:
        """The processes that plans are made in."""
        return {pid for process in self.planners for pid in grandchildren(process.pid)}

    def close(self) -> None:
        """End everything."""
        self._open.close()


class Embedded(Deployment):
    """Services on one SQLite file, which plan themselves."""

    def __init__(self, folder: Path, **environment: str) -> None:
        self._servers: list[subprocess.Popen[str]] = []
        super().__init__(folder, **environment)

    def serve(self) -> subprocess.Popen[str]:
        """Each service is a planner too."""
        server = super().serve()
        self._servers.append(server)
        return server

    @property
    def planners(self) -> list[subprocess.Popen[str]]:
        """The services."""
        return [server for server in self._servers if server.poll() is None]

    def add_planner(self) -> None:
        """A further service, which answers from now on."""
        self.server = self.serve()
        self.client = self.connect(self.server)


class Queued(Deployment):
    """Services on PostgreSQL, and workers that plan for them."""

    def __init__(self, folder: Path, queues: str = "plan,gpu", **environment: str) -> None:
        self.queues = queues
        self._workers: list[subprocess.Popen[str]] = []
        super().__init__(folder, **environment)
        self.add_planner()

    @property
    def planners(self) -> list[subprocess.Popen[str]]:
        """The workers."""
        return [worker for worker in self._workers if worker.poll() is None]

    def add_planner(self) -> None:
        """A further worker."""
        worker = subprocess.Popen(
            [sys.executable, "-m", "service", "worker", "--queues", self.queues],
            env={**os.environ, **self.environment},
            stdout=subprocess.PIPE,
            text=True,
        )
        self._workers.append(worker)
        self._open.callback(_end, worker)
        assert worker.stdout is not None
        assert worker.stdout.readline().startswith("cqltl works on ")


def _end(process: subprocess.Popen[str]) -> None:
    process.terminate()
    process.wait(30)
    if process.stdout is not None:
        process.stdout.close()


def order(client: httpx.Client, body: dict[str, Any], **headers: str) -> str:
    """The address of the job that a plan is made as, at once."""
    response = client.post("/plan", json=body, headers={"Prefer": "respond-async", **headers})
    assert response.status_code == 202, response.text
    return str(response.headers["location"])


def wait_for(client: httpx.Client, url: str, *states: str, within_s: float = 180.0) -> dict[str, Any]:
    """The job once it is in one of the states."""
    until = time.monotonic() + within_s
    while True:
        job: dict[str, Any] = client.get(url).json()
        if job["state"] in states:
            return job
        assert time.monotonic() < until, job
        time.sleep(0.05)


def await_requests(client: httpx.Client, number: int, within_s: float = 30.0) -> None:
    """Return once the service is answering that many requests at a time."""
    until = time.monotonic() + within_s
    while f"\ncqltl_requests_in_flight {number:.1f}\n" not in client.get("/metrics").text:
        assert time.monotonic() < until
        time.sleep(0.05)


def kill(pid: int) -> None:
    """End a process without asking it."""
    os.kill(pid, signal.SIGKILL)
