"""The executor that needs nothing but the store: the service's own worker processes."""

from __future__ import annotations

import asyncio
import logging
import threading
import time

from anyio.to_thread import run_sync
from sqlalchemy.exc import SQLAlchemyError

from service.jobs.commission import Commission, Planned, answer_of, policy_of
from service.jobs.executor import Executor
from service.jobs.housekeeping import fail_overdue, forget
from service.jobs.runner import JobRunner
from service.settings import Settings
from service.store import Once, Store, StoredJob, StoredPolicy, Transaction
from service.store.jobs import new_id
from service.worker import Workers

CLAIM_S = 0.5
"""How often jobs are looked for that a dead process left."""

FORGET_S = 60.0
"""How often it is forgotten what has been kept long enough."""

_log = logging.getLogger("cqltl")


class EmbeddedExecutor(Executor):
    """Plans in the processes of this service; a plan becomes a job when the wait is over, and goes on.

    Several services on one store take up what one of them leaves: none runs what another holds a lease on.
    """

    def __init__(self, store: Store, workers: Workers, settings: Settings, closing: threading.Event) -> None:
        super().__init__(store, settings, closing)
        self._workers = workers
        self._runner = JobRunner(store, workers, lease_s=settings.job_lease_s)
        self._keeper: asyncio.Task[None] | None = None

    async def start(self, *, take_up: bool) -> None:
        """Take up the jobs that nobody runs, now and from time to time."""
        self._runner.start()
        if take_up:
            self._keeper = asyncio.create_task(self._keep())

    async def stop(self) -> None:
        """Kill what runs; the next service takes it up at once."""
        if self._keeper is not None:
            self._keeper.cancel()
            await asyncio.gather(self._keeper, return_exceptions=True)
        await self._runner.stop()
        try:
            await run_sync(self._release)
        except SQLAlchemyError as error:
            _log.warning("jobs wait for their leases to end: %s", error)

    async def plan(self, commission: Commission, *, wait_s: float, once: Once | None) -> Planned | StoredJob:
        """Plan here and now; store a job only where that is needed to keep a promise."""
        if once is not None or wait_s <= 0:
            return await self._plan_as_job(commission, wait_s, once)
        call = self._runner.begin(commission)
        waiting = asyncio.ensure_future(answer_of(call, commission))
        if await self._done(waiting, wait_s):
            answer = waiting.result()
            policy = policy_of(commission, answer)
            if policy is not None:
                await run_sync(self._keep_policy, policy)
            return Planned(commission.told, answer, None if policy is None else policy.id)
        waiting.cancel()
        try:
            job = await run_sync(self._promote, commission, call.started)
        except BaseException:
            call.cancel()
            raise
        self._runner.follow(
            job.id, commission, call, deadline_s=self._settings.job_deadline_s, running=job.state == "running"
        )
        return job

    def waiting(self) -> int:
        """Those of this service."""
        return self._workers.waiting

    async def cancel(self, job_id: str) -> StoredJob:
        """End a job, and kill what runs for it at once where that is here."""
        job = await super().cancel(job_id)
        self._runner.drop(job_id)
        return job

    async def ended(self, job_id: str, within_s: float) -> StoredJob:
        """Without asking the store meanwhile where the job runs here."""
        started = time.monotonic()
        ending = asyncio.ensure_future(self._runner.ended(job_id))
        if not await self._done(ending, within_s):
            ending.cancel()
        return await super().ended(job_id, within_s - (time.monotonic() - started))

    def _enqueue(self, transaction: Transaction, job_id: str, queue: str) -> None:
        """Nobody has to be told: a job has its owner from the start."""

    async def _plan_as_job(self, commission: Commission, wait_s: float, once: Once | None) -> StoredJob:
        job_id = None if once is None else await run_sync(self._find, once)
        if job_id is None:
            self._workers.check_room()
            job_id, new = await self.record(commission, wait_s=wait_s, once=once, owner=self._runner.owner)
            if new:
                call = self._runner.begin(commission, always=True)
                deadline_s = self._settings.job_deadline_s
                self._runner.follow(job_id, commission, call, deadline_s=deadline_s, running=False)
        return await self.ended(job_id, wait_s)

    def _promote(self, commission: Commission, running: bool) -> StoredJob:
        """Store a plan that is being made as a job of this process."""
        job_id = new_id()
        with self._store.write(exclusive=False) as transaction:
            transaction.jobs.add(
                job_id,
                commission.job(self._settings.job_deadline_s),
                accepted=True,
                owner=self._runner.owner,
                lease_s=self._settings.job_lease_s,
                running=running,
            )
            return transaction.jobs.get(job_id)

    def _keep_policy(self, policy: StoredPolicy) -> None:
        with self._store.write(exclusive=False) as transaction:
            transaction.policies.add(policy)

    async def _keep(self) -> None:
        forget_at = 0.0
        while True:
            try:
                await self._claim()
                await self._runner.blocking(lambda: fail_overdue(self._store))
                if time.monotonic() > forget_at:
                    await self._runner.blocking(lambda: forget(self._store, self._settings))
                    forget_at = time.monotonic() + FORGET_S
            except SQLAlchemyError as error:
                _log.warning("the store does not answer: %s", error)
            except Exception:  # jobs of others must not wait for what is wrong with one
                _log.exception("jobs could not be looked after")
            await asyncio.sleep(CLAIM_S)

    async def _claim(self) -> None:
        """Take up as many jobs as there are processes for them."""
        free = self._workers.free
        if free:
            for job in await self._runner.blocking(lambda: self._claimed(free)):
                self._runner.run(job)

    def _claimed(self, most: int) -> list[StoredJob]:
        with self._store.read() as transaction:
            if not transaction.jobs.unowned(limit=1):
                return []
        with self._store.write(exclusive=False) as transaction:
            found = transaction.jobs.claim(self._runner.owner, self._settings.job_lease_s, most=most)
            return [transaction.jobs.get(job_id) for job_id in found if job_id not in self._runner.ids]

    def _release(self) -> None:
        with self._store.write(exclusive=False) as transaction:
            transaction.jobs.release(self._runner.owner)
