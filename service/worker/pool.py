"""Pools of processes with a deadline per task: one pool plans, one checks formulas."""

from __future__ import annotations

import asyncio
from collections.abc import Callable
from typing import TypeVar

from pebble import ProcessExpired, ProcessFuture, ProcessPool

from service.errors import OutOfTimeError, OverloadedError
from service.forkserver import context
from service.worker.jobs import warm_logic, warm_planning

T = TypeVar("T")
A = TypeVar("A")


class Workers:
    """Runs jobs in child processes, and kills the process of a job whose time is spent.

    Formula checks have a pool of their own, so that `/learn` never waits behind a long plan.
    """

    def __init__(self, *, planners: int, max_waiting: int) -> None:
        self._context = context()
        self._planners, self._max_waiting = planners, max_waiting
        self._plan_pool: ProcessPool | None = None
        self._logic_pool: ProcessPool | None = None
        self._pending = {"plan": 0, "check": 0}

    def start(self, *, warm: bool) -> None:
        """Open the pools; processes start with the first job, or now and with everything loaded when `warm`."""
        self._plan_pool = ProcessPool(self._planners, initializer=warm_planning, context=self._context)
        self._logic_pool = ProcessPool(1, initializer=warm_logic, context=self._context)
        if warm:
            self._plan_pool.schedule(warm_planning)  # each process also does so as its initializer
            self._logic_pool.schedule(warm_logic)

    def stop(self) -> None:
        """Kill the processes and whatever they do."""
        for pool in (self._plan_pool, self._logic_pool):
            if pool is not None:
                pool.stop()  # type: ignore[no-untyped-call]  # pebble annotates only some of its methods
                pool.join()

    async def plan(self, function: Callable[[A], T], job: A, *, timeout_s: float) -> T:
        """Run `function(job)` in a planning process.

        Raises:
            OutOfTimeError: it took longer than `timeout_s` seconds, from its start.
            OverloadedError: too many jobs wait already.
        """
        return await self._run("plan", self._plan_pool, function, job, timeout_s)

    async def check(self, function: Callable[[A], T], job: A, *, timeout_s: float) -> T:
        """Run `function(job)` in the process for formula checks; raises like `plan`."""
        return await self._run("check", self._logic_pool, function, job, timeout_s)

    async def _run(
        self, queue: str, pool: ProcessPool | None, function: Callable[[A], T], job: A, timeout_s: float
    ) -> T:
        if pool is None:
            raise RuntimeError("the workers are not started")
        if self._pending[queue] >= self._planners + self._max_waiting:
            raise OverloadedError(f"{self._pending[queue]} requests wait for a worker; try again later")
        self._pending[queue] += 1
        try:
            future: ProcessFuture[T] = pool.schedule(function, args=[job], timeout=timeout_s)
            return await asyncio.wrap_future(future)
        except TimeoutError:
            raise OutOfTimeError(f"stopped after {timeout_s:g} s without an answer") from None
        except ProcessExpired as error:
            raise OverloadedError(f"the worker process died ({error}); it may have run out of memory") from None
        finally:
            self._pending[queue] -= 1
