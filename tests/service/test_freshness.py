"""One read of the versions serves all who wait, and nobody gets one that began before they asked."""

from __future__ import annotations

import asyncio
import time
from typing import cast

import pytest

from service.freshness import Freshness
from service.store import Store, Versions


class Slow:
    """A store whose version is the number of reads that began, each of which takes a while."""

    def __init__(self) -> None:
        self.begun = 0

    def versions(self) -> Versions:
        self.begun += 1
        mine = self.begun
        time.sleep(0.05)
        if mine == 3:
            raise OSError("gone")
        return Versions(mine, 0)


def test_reads_are_shared_and_never_old() -> None:
    async def ask() -> None:
        store = Slow()
        fresh = Freshness(cast(Store, store))
        first = [asyncio.create_task(fresh.versions()) for _ in range(5)]
        await asyncio.sleep(0.02)
        assert store.begun == 1
        later = [asyncio.create_task(fresh.versions()) for _ in range(5)]  # the first read runs: it may be too old
        later[0].cancel()  # a client that goes away takes nobody's answer with it
        assert {(await task).lessons for task in first} == {1}
        assert {(await task).lessons for task in later[1:]} == {2}
        with pytest.raises(OSError, match="gone"):
            await fresh.versions()
        assert (await fresh.versions()).lessons == 4

    asyncio.run(ask())
