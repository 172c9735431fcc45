"""What has plans made, whether somebody waits for them or not: the promises that every executor keeps.

A plan that is answered within the wait need not be a job; one that is answered by a job was stored as one before. A
stored job holds all that it takes to plan, so any process may take it up.
"""

from __future__ import annotations

import asyncio
import threading
import time
from abc import ABC, abstractmethod
from functools import partial
from typing import Any

from anyio.to_thread import run_sync

from service.jobs.commission import Commission, Planned
from service.settings import Settings
from service.store import KeptAnswer, Once, Store, StoredJob, Transaction
from service.store.jobs import new_id

OPERATION = "plan"
"""What the idempotency keys of plans are kept for."""

FIRST_LOOK_S, LONGEST_LOOK_S = 0.005, 0.2
"""How soon a job of another process is looked at again, at first and in the end."""


class Executor(ABC):
    """Has plans made. All waits end when `closing` is set, as if their time were up: the service stops."""

    def __init__(self, store: Store, settings: Settings, closing: threading.Event) -> None:
        self._store, self._settings, self._closing = store, settings, closing

    @abstractmethod
    async def start(self, *, take_up: bool) -> None:
        """Be ready, and `take_up` what other processes left."""

    @abstractmethod
    async def stop(self) -> None:
        """Leave what has not ended to whoever takes it up."""

    @abstractmethod
    async def plan(self, commission: Commission, *, wait_s: float, once: Once | None) -> Planned | StoredJob:
        """Have a plan made: the plan, or after `wait_s` seconds the job that it has become.

        With a key the answer is always a job, which may have ended; with one that came before, the same one.

        Raises:
            OverloadedError: too many plans wait.
            KeyInUseError: the key came with another request before.
            CqltlError: what planning refuses, unless the answer is a job.
        """

    @abstractmethod
    def waiting(self) -> int:
        """How many plans wait for a process to make them."""

    async def cancel(self, job_id: str) -> StoredJob:
        """End a job unless it has ended; raises `UnknownJobError`."""
        return await run_sync(self._cancel, job_id)

    async def record(
        self, commission: Commission, *, wait_s: float, once: Once | None, owner: str | None
    ) -> tuple[str, bool]:
        """Store a job, one of `owner` if there is one: its id, or with False the id of the one stored before."""
        return await run_sync(partial(self._record, commission, wait_s, once, owner))

    async def ended(self, job_id: str, within_s: float) -> StoredJob:
        """The job once it has ended, or when the time is up; then its client is about to be told of it."""
        until, pause = time.monotonic() + within_s, FIRST_LOOK_S
        while True:
            job = await run_sync(self._get, job_id)
            left = until - time.monotonic()
            if job.ended or left <= 0 or self._closing.is_set():
                break
            await asyncio.sleep(min(pause, left))
            pause = min(LONGEST_LOOK_S, 1.3 * pause)
        if not job.ended and not job.accepted:
            await run_sync(self._accept, job_id)
        return job

    async def _done(self, waited: asyncio.Future[Any], within_s: float) -> bool:
        """Whether something is done before the time is up."""
        until = time.monotonic() + within_s
        while not self._closing.is_set() and (left := until - time.monotonic()) > 0:
            done, _ = await asyncio.wait({waited}, timeout=min(LONGEST_LOOK_S, left))
            if done:
                return True
        return False

    @abstractmethod
    def _enqueue(self, transaction: Transaction, job_id: str, queue: str) -> None:
        """Tell whoever runs jobs of a new one, once the transaction is committed."""

    def _record(self, commission: Commission, wait_s: float, once: Once | None, owner: str | None) -> tuple[str, bool]:
        job_id, job = new_id(), commission.job(self._settings.job_deadline_s)
        lease_s = self._settings.job_lease_s
        with self._store.write(exclusive=False) as transaction:
            if once is not None and not transaction.answers.keep(once, KeptAnswer(job_id=job_id)):
                return self._known(transaction, once), False
            transaction.jobs.add(job_id, job, accepted=wait_s <= 0, owner=owner, lease_s=lease_s)
            if owner is None:
                self._enqueue(transaction, job_id, job.queue)
        return job_id, True

    def _known(self, transaction: Transaction, once: Once) -> str:
        kept = transaction.answers.find(once)
        assert kept is not None
        assert kept.job_id is not None
        return kept.job_id

    def _find(self, once: Once) -> str | None:
        """The job that was stored under a key; raises `KeyInUseError`."""
        with self._store.read() as transaction:
            kept = transaction.answers.find(once)
        return None if kept is None else kept.job_id

    def _get(self, job_id: str) -> StoredJob:
        with self._store.read() as transaction:
            return transaction.jobs.get(job_id)

    def _accept(self, job_id: str) -> None:
        with self._store.write(exclusive=False) as transaction:
            transaction.jobs.accept(job_id)

    def _cancel(self, job_id: str) -> StoredJob:
        with self._store.write(exclusive=False) as transaction:
            transaction.jobs.cancel(job_id)
            return transaction.jobs.get(job_id)
