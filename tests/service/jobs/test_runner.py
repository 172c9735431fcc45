"""Jobs of a process whose store leaves it waiting."""

from __future__ import annotations

import asyncio
import threading
from types import SimpleNamespace
from typing import Any

from service.jobs.runner import SAFETY, JobRunner

LEASE_S = 0.5


class Hanging:
    """A store that never answers until it is let go."""

    def __init__(self) -> None:
        self.free = threading.Event()

    def read(self) -> Any:
        self.free.wait(10)
        raise RuntimeError("the store was closed")

    write = read


class Endless:
    """A call that ends only by being cancelled."""

    started, progress = True, None

    def __init__(self) -> None:
        self.cancelled = asyncio.Event()

    def cancel(self) -> None:
        self.cancelled.set()


def test_a_job_is_killed_before_its_lease_ends_while_the_store_hangs() -> None:
    async def killed_after() -> float:
        store, call = Hanging(), Endless()
        runner = JobRunner(store, SimpleNamespace(), lease_s=LEASE_S)  # type: ignore[arg-type]  # as far as it is asked
        runner._end_of = lambda *_: asyncio.sleep(60)  # type: ignore[method-assign]
        runner.start()
        began = asyncio.get_running_loop().time()
        runner.follow("job", SimpleNamespace(), call, deadline_s=60, running=True)  # type: ignore[arg-type]
        try:
            await asyncio.wait_for(call.cancelled.wait(), 5)
            return asyncio.get_running_loop().time() - began
        finally:
            store.free.set()
            for task in runner._tasks:
                task.cancel()

    assert SAFETY * LEASE_S <= asyncio.run(killed_after()) < LEASE_S
