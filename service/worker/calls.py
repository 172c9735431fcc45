"""One call of a function in some child process."""

from __future__ import annotations

import asyncio
import threading
import time
from collections.abc import Callable
from concurrent.futures import Future
from typing import Any, Generic, TypeVar

from service.worker.child import Child
from service.worker.progress import Progress, read

T = TypeVar("T")
A = TypeVar("A")


class CallCancelled(Exception):
    """Somebody ended the call."""


class Call(Generic[T]):
    """A call that waits, runs or has ended: its result, how far it is, and how to end it."""

    def __init__(self, function: Callable[[A], T], argument: A, timeout_s: float) -> None:
        self.future: Future[T] = Future()
        self.cancelled = False
        self.function: Callable[[Any], T] = function
        self._argument: Any = argument
        self._timeout_s = timeout_s
        self._lock = threading.Lock()
        self._child: Child | None = None
        self._started_at: float | None = None
        self._ended_at: float | None = None

    @property
    def started(self) -> bool:
        """A process has begun with it."""
        return self._started_at is not None

    @property
    def progress(self) -> Progress | None:
        """How far it is; None where nothing is known yet, or any more."""
        with self._lock:
            if self._child is None or self._started_at is None:
                return None
            return read(self._child.board, time.monotonic() - self._started_at)

    @property
    def seconds(self) -> float:
        """How long it has run, or ran, in the last process that began with it."""
        began, ended = self._started_at, self._ended_at
        return 0.0 if began is None else (time.monotonic() if ended is None else ended) - began

    def cancel(self) -> None:
        """End it now, with its process; its result is then `CallCancelled`. Nothing happens where it has ended."""
        with self._lock:
            self.cancelled = True
            if self._child is not None:
                self._child.kill()
        self.future.cancel()  # succeeds only while it waits for a process

    async def result(self) -> T:
        """Wait for the result, or raise what the function or its process did, or `CallCancelled`.

        To cancel the waiting is not to cancel the call.
        """
        waiting = asyncio.wrap_future(self.future)
        try:
            return await asyncio.shield(waiting)
        except asyncio.CancelledError:
            if waiting.cancelled() and self.cancelled:
                raise CallCancelled from None
            raise

    def attempt(self, child: Child) -> T:
        """Run it in that process; raises what `Child.call` does, and `CallCancelled`."""
        with self._lock:
            if self.cancelled:
                raise CallCancelled
            self._child = child
        try:
            child.prepare()
            self._started_at, self._ended_at = time.monotonic(), None
            found: T = child.call(self.function, self._argument, self._timeout_s)
            return found
        finally:
            self._ended_at = time.monotonic()
            with self._lock:
                self._child = None
