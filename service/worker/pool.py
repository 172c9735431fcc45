"""Pools of child processes with a deadline per call: one pool plans, one checks formulas."""

from __future__ import annotations

import asyncio
import logging
import threading
import time
from collections.abc import Callable
from concurrent.futures import Future
from multiprocessing.context import ForkServerContext
from queue import SimpleQueue
from typing import Any, TypeVar

from service.errors import CannotStartError, OverloadedError, WorkerDiedError
from service.forkserver import context
from service.worker.calls import Call, CallCancelled
from service.worker.child import Child
from service.worker.jobs import warm_logic, warm_planning

T = TypeVar("T")
A = TypeVar("A")

ATTEMPTS = 3
"""Times that a call is begun whose process dies; what it computes is the same each time."""

RETRY_S = 0.2
"""Pause after a process could not be started."""

LOAD_S = 120.0
"""Longest time for a process to load; a machine on which it takes more is of no use."""

_log = logging.getLogger("cqltl")


class Pool:
    """Some processes, each with a thread that gives it one call after the other."""

    def __init__(
        self, size: int, *, initializer: Callable[[], None], context: ForkServerContext, memory_bytes: int = 0
    ) -> None:
        self._size = size
        self._context, self._initializer, self._memory_bytes = context, initializer, memory_bytes
        self._calls: SimpleQueue[Call[Any] | None] = SimpleQueue()
        self._running: set[Call[Any]] = set()
        self._stopped = False
        self._threads: list[threading.Thread] = []
        self._loaded: list[Future[None]] = []
        self._loading: set[Child] = set()

    def start(self, *, warm: bool) -> None:
        """Start the threads. Processes start with the first call of each, or now when `warm`."""
        self._loaded = [Future() for _ in range(self._size if warm else 0)]
        for number in range(self._size):
            arguments = (self._loaded[number] if warm else None,)
            self._threads.append(threading.Thread(target=self._work, args=arguments, name="cqltl-pool", daemon=True))
            self._threads[-1].start()

    def loaded(self) -> None:
        """Wait until the processes that were started at once can work; raises what kept one of them from it."""
        for future in self._loaded:
            future.result(LOAD_S)

    def submit(self, call: Call[Any]) -> None:
        """Have it run when a process is free."""
        if not self._threads or self._stopped:
            raise RuntimeError("the workers are not started")
        self._calls.put(call)

    def stop(self) -> None:
        """Kill the processes and whatever they do; calls that wait are cancelled."""
        self._stopped = True
        for child in list(self._loading):
            child.kill()
        for call in list(self._running):
            call.cancel()
        for _ in self._threads:
            self._calls.put(None)
        for thread in self._threads:
            thread.join()

    def _work(self, loaded: Future[None] | None) -> None:
        child = None if loaded is None else self._first(loaded)
        while (call := self._calls.get()) is not None:
            if self._stopped:
                call.cancel()
            if not call.future.set_running_or_notify_cancel():
                continue
            self._running.add(call)
            child = self._run(call, child)
            self._running.discard(call)
        if child is not None:
            child.close()

    def _first(self, loaded: Future[None]) -> Child | None:
        """A process that can work; None where it cannot be had, and why is the result of `loaded`."""
        child: Child | None = None
        try:
            child = Child(self._context, self._initializer, self._memory_bytes)
            self._loading.add(child)
            if self._stopped:
                child.kill()
            child.prepare()
            loaded.set_result(None)
        except Exception as error:  # whatever it is, somebody waits to be told
            loaded.set_exception(error)
        finally:
            self._loading.discard(child)
        return child

    def _run(self, call: Call[Any], child: Child | None) -> Child | None:
        """Run the call to its end; the process for the next one, None where none could be started."""
        for attempt in range(1, ATTEMPTS + 1):
            child = child if child is not None and child.usable else self._replaced(child)
            try:
                if child is None:
                    raise WorkerDiedError("no process could be started to work on this")
                call.future.set_result(call.attempt(child))
                break
            except WorkerDiedError as error:
                if call.cancelled:
                    call.future.set_exception(CallCancelled())
                    break
                if attempt == ATTEMPTS or self._stopped:
                    call.future.set_exception(error)
                    break
            except BaseException as error:
                call.future.set_exception(error)
                break
        return child if child is not None and child.usable else self._replaced(child)

    def _replaced(self, child: Child | None) -> Child | None:
        """A new process in place of one that is of no use any more; None where none can be started now."""
        if child is not None:
            child.close()
        try:
            return None if self._stopped else Child(self._context, self._initializer, self._memory_bytes)
        except Exception as error:  # the fork server was killed, the system has no more processes; the next try may do
            _log.warning("no worker process could be started: %r", error)
            time.sleep(RETRY_S)
            return None


class Workers:
    """Runs calls in child processes, and kills the process of a call whose time is spent.

    Formula checks have a pool of their own, so that `/learn` never waits behind a long plan.
    """

    def __init__(
        self,
        *,
        planners: int,
        max_waiting: int,
        memory_bytes: int = 0,
        ended: Callable[[Call[Any]], None] | None = None,
    ) -> None:
        """`ended` is told of every call that has."""
        found = context()
        self._told = ended
        self.planners = planners
        self._most = planners + max_waiting
        self._pools = {
            "plan": Pool(planners, initializer=warm_planning, context=found, memory_bytes=memory_bytes),
            "check": Pool(1, initializer=warm_logic, context=found, memory_bytes=memory_bytes),
        }
        self._pending = dict.fromkeys(self._pools, 0)
        self._lock = threading.Lock()

    def start(self, *, warm: bool) -> None:
        """Open the pools; processes start with the first call, or now and with everything loaded when `warm`."""
        for pool in self._pools.values():
            pool.start(warm=warm)

    def loaded(self) -> None:
        """Wait until the processes that were started at once can work; raises `CannotStartError`."""
        for pool in self._pools.values():
            try:
                pool.loaded()
            except Exception as error:
                said = str(error).partition("\n")[0] or type(error).__name__
                raise CannotStartError(f"the worker processes cannot be started: {said}") from error

    def stop(self) -> None:
        """Kill the processes and whatever they do."""
        for pool in self._pools.values():
            pool.stop()

    async def plan(self, function: Callable[[A], T], argument: A, *, timeout_s: float) -> T:
        """Run `function(argument)` in a planning process.

        Raises:
            OutOfTimeError: it took longer than `timeout_s` seconds, from its start.
            OutOfMemoryError: it needed more memory than a process may have.
            WorkerDiedError: its process died, and so did those in which it was tried again.
            OverloadedError: too many calls wait already.
        """
        return await _finished(self._begin("plan", function, argument, timeout_s))

    async def check(self, function: Callable[[A], T], argument: A, *, timeout_s: float) -> T:
        """Run `function(argument)` in the process for formula checks; raises like `plan`."""
        return await _finished(self._begin("check", function, argument, timeout_s))

    def begin(self, function: Callable[[A], T], argument: A, *, timeout_s: float, always: bool = False) -> Call[T]:
        """Have `function(argument)` run in a planning process, for the caller to follow.

        Raises `OverloadedError`, but not where it was accepted earlier and has to run: `always`.
        """
        return self._begin("plan", function, argument, timeout_s, always=always)

    def check_room(self) -> None:
        """Raise `OverloadedError` where no further plan can wait."""
        self._check_room("plan")

    @property
    def free(self) -> int:
        """Planning processes that have nothing to do."""
        return max(0, self.planners - self._pending["plan"])

    @property
    def running(self) -> int:
        """Planning processes that are at work."""
        return min(self.planners, self._pending["plan"])

    @property
    def waiting(self) -> int:
        """Calls that wait for a planning process."""
        return max(0, self._pending["plan"] - self.planners)

    def _begin(
        self, name: str, function: Callable[[A], T], argument: A, timeout_s: float, *, always: bool = False
    ) -> Call[T]:
        call = Call(function, argument, timeout_s)
        with self._lock:
            if not always:
                self._check_room(name)
            self._pending[name] += 1
        call.future.add_done_callback(lambda _: self._ended(name, call))
        try:
            self._pools[name].submit(call)
        except BaseException:
            call.cancel()
            raise
        return call

    def _check_room(self, name: str) -> None:
        if self._pending[name] >= self._most:
            raise OverloadedError(f"{self._pending[name]} requests wait for a worker; try again later")

    def _ended(self, name: str, call: Call[Any]) -> None:
        with self._lock:
            self._pending[name] -= 1
        if self._told is not None:
            self._told(call)


async def _finished(call: Call[T]) -> T:
    try:
        return await call.result()
    except asyncio.CancelledError:
        call.cancel()
        raise
