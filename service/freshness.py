"""What the store's versions are, asked once for all who ask at the same time."""

from __future__ import annotations

import asyncio

from anyio.to_thread import run_sync

from service.store import Store, Versions


class Freshness:
    """Reads versions for the tasks of one event loop. A read serves all who asked before it began, never one who asked
    later: what was committed before a request came is seen by it, whichever process committed it.
    """

    def __init__(self, store: Store) -> None:
        self._store = store
        self._running: asyncio.Task[Versions] | None = None
        self._next: asyncio.Task[Versions] | None = None

    async def versions(self) -> Versions:
        """The versions, read after this was called; raises what the store raises."""
        if self._next is None:
            self._next = asyncio.create_task(self._read_after(self._running))
        return await asyncio.shield(self._next)

    async def _read_after(self, before: asyncio.Task[Versions] | None) -> Versions:
        if before is not None:
            await asyncio.wait([before])
        self._running, self._next = self._next, None  # who asks from now on waits for the next one
        return await run_sync(self._store.versions)
