"""The threads that share the rows of a large world.

Kernels let go of the interpreter, so threads run side by side. What each writes no other reads before all are done, or
it is a search whose end does not depend on the order: the result is the same for any number of threads.
"""

from __future__ import annotations

import os
from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor
from types import TracebackType
from typing import Self, TypeVar

T = TypeVar("T")

TOGETHER_FROM = 200_000
"""Product states from which threads pay."""


class Team:
    """Runs a function over the parts of a range, one part for each thread; use it as a context."""

    def __init__(self, size: int) -> None:
        """`size` is the number of product states."""
        cores = len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else os.cpu_count() or 1
        self.members = cores if size >= TOGETHER_FROM else 1
        self._pool = ThreadPoolExecutor(self.members) if self.members > 1 else None

    def __enter__(self) -> Self:
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        if self._pool is not None:
            self._pool.shutdown()

    def share(self, work: Callable[[int, int], T], first: int, last: int) -> list[T]:
        """The results of `work` on consecutive parts of the range, in order."""
        if self._pool is None or last - first < self.members:
            return [work(first, last)]
        ends = [first + (last - first) * member // self.members for member in range(self.members + 1)]
        return list(self._pool.map(work, ends[:-1], ends[1:]))
