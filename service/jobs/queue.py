"""The executor for many machines: jobs are put into a queue in PostgreSQL, from which workers take them.

Procrastinate is the queue. A job is put there in the transaction that stores it, so neither is without the other; who
runs it, and what becomes of it, is as with every executor in the table of jobs. The queue only wakes workers: what it
says twice is done once, since a worker has to claim the job.
"""

from __future__ import annotations

import asyncio
import logging
import threading
import time
from functools import lru_cache

import procrastinate
from anyio.to_thread import run_sync
from sqlalchemy import text
from sqlalchemy.engine import make_url
from sqlalchemy.exc import SQLAlchemyError

from service.errors import OverloadedError
from service.jobs.commission import Commission
from service.jobs.executor import Executor
from service.jobs.housekeeping import fail_overdue, forget
from service.settings import Settings
from service.store import Once, Store, StoredJob, Transaction

TASK = "cqltl.plan"
"""The name of the task in the queue; its argument is the id of a job."""

QUEUES = ("plan", "gpu")
"""Queues of jobs: those that ask for the device `cuda` are in the second."""

SWEEP_S = 0.5
"""How often jobs are looked for whose worker died."""

FORGET_S = 60.0
"""How often it is forgotten what has been kept long enough."""

_FORGOTTEN = text(
    """
    SELECT jobs.id, jobs.queue FROM jobs
    WHERE jobs.ended_at IS NULL AND jobs.owner IS NULL AND NOT EXISTS (
        SELECT 1 FROM procrastinate_jobs AS entries
        WHERE entries.args ->> 'job_id' = jobs.id AND entries.status IN ('todo', 'doing')
    )
    FOR UPDATE OF jobs SKIP LOCKED
    """
)
"""Jobs that nobody runs and that are not in the queue."""

_log = logging.getLogger("cqltl")


def conninfo(url: str) -> str:
    """A SQLAlchemy URL as PostgreSQL's own library reads it."""
    return make_url(url).set(drivername="postgresql").render_as_string(hide_password=False)


@lru_cache(maxsize=1)
def _application() -> procrastinate.App:
    """Puts jobs into the queue over the connections of others; it opens none."""
    return procrastinate.App(connector=procrastinate.SyncPsycopgConnector())


def enqueue(transaction: Transaction, job_id: str, queue: str) -> None:
    """Put a job into its queue, as part of the transaction."""
    connection = transaction.connection.connection.driver_connection
    _application().configure_task(TASK, queue=queue, connection=connection).defer(job_id=job_id)


def sweep(store: Store) -> None:
    """Put jobs into the queue again whose workers died or were taken from it in vain, and end those beyond their
    deadline.

    A worker that loses the database while it claims a job takes it from the queue all the same.
    """
    with store.read() as transaction:
        found = transaction.jobs.abandoned()
    for job in found:
        with store.write(exclusive=False) as transaction:
            if transaction.jobs.abandon(job.id):
                enqueue(transaction, job.id, job.queue)
    with store.write(exclusive=False) as transaction:
        for job_id, queue in transaction.connection.execute(_FORGOTTEN):
            enqueue(transaction, job_id, queue)
    fail_overdue(store)


class QueueExecutor(Executor):
    """Puts plans into the queue, and waits for workers to make them; keeps nothing itself."""

    def __init__(self, store: Store, settings: Settings, closing: threading.Event) -> None:
        super().__init__(store, settings, closing)
        self._keeper: asyncio.Task[None] | None = None
        self._deletions: set[asyncio.Task[None]] = set()

    async def start(self, *, take_up: bool) -> None:
        """See from time to time to the jobs of workers that died."""
        if take_up:
            self._keeper = asyncio.create_task(self._keep())

    async def stop(self) -> None:
        """Workers go on with what was ordered."""
        tasks = [*self._deletions] if self._keeper is None else [*self._deletions, self._keeper]
        if self._keeper is not None:
            self._keeper.cancel()
        await asyncio.gather(*tasks, return_exceptions=True)

    async def plan(self, commission: Commission, *, wait_s: float, once: Once | None) -> StoredJob:
        """Order a plan; a job that is answered within the wait and has no key is forgotten then."""
        job_id = None if once is None else await run_sync(self._find, once)
        if job_id is None:
            await run_sync(self._check_room)
            job_id, _ = await self.record(commission, wait_s=wait_s, once=once, owner=None)
        job = await self.ended(job_id, wait_s)
        if once is None and job.ended and not job.accepted:
            deletion = asyncio.create_task(run_sync(self._forget, job_id))
            self._deletions.add(deletion)
            deletion.add_done_callback(self._deletions.discard)
        return job

    def waiting(self) -> int:
        """Those of all services."""
        with self._store.read() as transaction:
            return transaction.jobs.waiting()

    def _enqueue(self, transaction: Transaction, job_id: str, queue: str) -> None:
        """A worker hears of it when the transaction is committed."""
        enqueue(transaction, job_id, queue)

    def _check_room(self) -> None:
        waiting = self.waiting()
        if waiting >= self._settings.max_waiting:
            raise OverloadedError(f"{waiting} requests wait for a worker; try again later")

    def _forget(self, job_id: str) -> None:
        try:
            with self._store.write(exclusive=False) as transaction:
                transaction.jobs.delete(job_id)
        except SQLAlchemyError as error:  # it is forgotten later
            _log.warning("the store does not answer: %s", error)

    async def _keep(self) -> None:
        forget_at = 0.0
        while True:
            try:
                await run_sync(sweep, self._store)
                if time.monotonic() > forget_at:
                    await run_sync(forget, self._store, self._settings)
                    forget_at = time.monotonic() + FORGET_S
            except SQLAlchemyError as error:
                _log.warning("the store does not answer: %s", error)
            except Exception:  # jobs of others must not wait for what is wrong with one
                _log.exception("jobs could not be looked after")
            await asyncio.sleep(SWEEP_S)
