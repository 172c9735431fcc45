"""Runs jobs that belong to this process, and renews their leases, until each has ended or is somebody else's."""

from __future__ import annotations

import asyncio
import json
import logging
import math
import time
import uuid
from collections.abc import Callable, Coroutine
from dataclasses import asdict, dataclass, field
from typing import Any, TypeVar

from anyio import CapacityLimiter
from anyio.to_thread import run_sync
from sqlalchemy.exc import SQLAlchemyError

from models.errors import CqltlError
from service.errors import OutOfTimeError
from service.jobs.commission import Commission, answer_of, policy_of
from service.logs import JOB_ID
from service.refusals import failure_data, refusal_data
from service.store import Store, StoredJob
from service.worker import Call, CallCancelled, PlanAnswer, Progress, Workers, run_plan
from service.worker.records import answer_text

T = TypeVar("T")

TICK_S = 0.1
"""How often it is looked whether jobs were cancelled."""

RENEWALS = 10
"""Times that a lease is renewed before it would end."""

SAFETY = 0.7
"""Share of a lease after which a process that cannot renew it stops its job: nobody else runs it yet."""

_log = logging.getLogger("cqltl")


@dataclass(slots=True)
class _Followed:
    """A job that this process runs."""

    commission: Commission
    call: Call[PlanAnswer]
    ends_at: float  # on this process's clock, as `renewed_at`
    renewed_at: float
    told_running: bool
    overdue: bool = False
    ended: asyncio.Event = field(default_factory=asyncio.Event)


class JobRunner:
    """The jobs that belong to one process."""

    def __init__(self, store: Store, workers: Workers, *, lease_s: float) -> None:
        self.owner = uuid.uuid4().hex
        self.lease_s = lease_s
        self._store, self._workers = store, workers
        self._followed: dict[str, _Followed] = {}
        self._tasks: set[asyncio.Task[None]] = set()
        self._threads = CapacityLimiter(2)  # its own: leases must not wait for requests
        self._stopping = False

    @property
    def ids(self) -> set[str]:
        """The jobs that it runs."""
        return set(self._followed)

    def start(self) -> None:
        """Begin to renew leases."""
        self._spawn(self._tend())
        self._spawn(self._guard())

    async def stop(self) -> None:
        """Kill what runs, and leave the jobs to whoever takes them up."""
        self._stopping = True
        for followed in self._followed.values():
            followed.call.cancel()
        await asyncio.gather(*self._tasks, return_exceptions=True)

    def begin(self, commission: Commission, *, always: bool = False) -> Call[PlanAnswer]:
        """Have a plan made that is not a job, or not yet; raises `OverloadedError` unless `always`."""
        return self._workers.begin(run_plan, commission.work, timeout_s=commission.work.timeout_s, always=always)

    def run(self, job: StoredJob) -> None:
        """Run a job that this process has just claimed."""
        try:
            commission = Commission.of(job)
        except Exception:
            _log.exception("job %s cannot be read", job.id)
            self._spawn(self._give_up(job.id))
            return
        left = job.deadline - time.time()
        self.follow(job.id, commission, self.begin(commission, always=True), deadline_s=left, running=False)

    def follow(
        self, job_id: str, commission: Commission, call: Call[PlanAnswer], *, deadline_s: float, running: bool
    ) -> None:
        """See a job of this process to its end, `deadline_s` from now at the latest."""
        now = time.monotonic()
        followed = _Followed(commission, call, now + deadline_s, now, running)
        self._followed[job_id] = followed
        self._spawn(self._follow(job_id, followed))

    def drop(self, job_id: str) -> None:
        """Kill what runs for a job that has ended otherwise."""
        if job_id in self._followed:
            self._followed[job_id].call.cancel()

    async def ended(self, job_id: str) -> None:
        """Wait for a job of this process to end."""
        if job_id in self._followed:
            await self._followed[job_id].ended.wait()

    async def blocking(self, function: Callable[[], T]) -> T:
        """Ask the store, in a thread that requests cannot keep busy."""
        return await run_sync(function, limiter=self._threads)

    def _spawn(self, coroutine: Coroutine[Any, Any, None]) -> None:
        task = asyncio.create_task(coroutine)
        self._tasks.add(task)
        task.add_done_callback(self._tasks.discard)

    async def _follow(self, job_id: str, followed: _Followed) -> None:
        JOB_ID.set(job_id)  # of this task, and of what it logs
        try:
            end = await self._end_of(job_id, followed)
            while end is not None and not await self._written(end):
                if self._stopping or time.monotonic() > followed.renewed_at + self.lease_s:
                    return  # whoever runs it then comes to the same end
                await asyncio.sleep(TICK_S)
        finally:
            del self._followed[job_id]
            followed.ended.set()

    async def _give_up(self, job_id: str) -> None:
        """End a job that would fail like this wherever it is run."""
        await self._written(lambda: self._fail(job_id, json.dumps(failure_data())))

    async def _end_of(self, job_id: str, followed: _Followed) -> Callable[[], None] | None:
        """What writes the end of a job to the store; None where it is not for this process to say."""
        try:
            answer = await answer_of(followed.call, followed.commission)
            return lambda: self._succeed(job_id, followed.commission, answer)
        except CallCancelled:
            if not followed.overdue:
                return None
            error = refusal_data(OutOfTimeError("the job's deadline came before its plan was made"))
        except CqltlError as refusal:
            error = refusal_data(refusal)
        except Exception:
            _log.exception("job %s failed", job_id)
            error = failure_data()
        text = json.dumps(error, ensure_ascii=False)
        return lambda: self._fail(job_id, text)

    def _succeed(self, job_id: str, commission: Commission, answer: PlanAnswer) -> None:
        policy, text = policy_of(commission, answer), answer_text(answer)
        with self._store.write(exclusive=False) as transaction:
            policy_id = None if policy is None else policy.id
            kept = transaction.jobs.finish(job_id, self.owner, "succeeded", answer=text, policy_id=policy_id)
            if kept and policy is not None:
                transaction.policies.add(policy)

    def _fail(self, job_id: str, error: str) -> None:
        with self._store.write(exclusive=False) as transaction:
            transaction.jobs.finish(job_id, self.owner, "failed", error=error)

    async def _written(self, write: Callable[[], None]) -> bool:
        try:
            await self.blocking(write)
        except SQLAlchemyError as error:
            _log.warning("the end of a job could not be stored yet: %s", error)
            return False
        return True

    async def _tend(self) -> None:
        """Renew leases, say how far jobs are, and notice what was cancelled by other processes."""
        while not self._stopping:
            await asyncio.sleep(TICK_S)
            if not self._followed:
                continue
            try:
                for job_id in await self.blocking(self._lost):
                    self.drop(job_id)
                await self.blocking(self._renew_leases)
            except SQLAlchemyError as error:
                _log.warning("the store does not answer: %s", error)

    async def _guard(self) -> None:
        """Kill what is beyond its deadline, and what may soon be another's, also while the store leaves one waiting."""
        while not self._stopping:
            await asyncio.sleep(TICK_S)
            now = time.monotonic()
            for followed in self._followed.values():
                followed.overdue = followed.overdue or now > followed.ends_at
                if followed.overdue or now > followed.renewed_at + SAFETY * self.lease_s:
                    followed.call.cancel()

    def _lost(self) -> set[str]:
        """The jobs that are not this process's any more."""
        with self._store.read() as transaction:
            return transaction.jobs.lost(self.owner, self.ids)

    def _renew_leases(self) -> None:
        now = time.monotonic()
        due = [
            (job_id, followed)
            for job_id, followed in list(self._followed.items())
            if now > followed.renewed_at + self.lease_s / RENEWALS or followed.call.started != followed.told_running
        ]
        if due:
            with self._store.write(exclusive=False) as transaction:
                for job_id, followed in due:
                    self._renew(transaction.jobs.renew, job_id, followed)
            for _, followed in due:
                followed.renewed_at = now

    def _renew(self, renew: Callable[..., bool], job_id: str, followed: _Followed) -> None:
        running = followed.call.started
        progress = followed.call.progress
        text = None if progress is None else progress_text(progress)
        renew(job_id, self.owner, self.lease_s, running=running, progress=text)
        followed.told_running = running


def progress_text(progress: Progress) -> str:
    """Progress as JSON; null for bounds that say nothing."""
    values = asdict(progress)
    if progress.stage in ("compile", "graph"):
        values["lower"] = None
    if math.isinf(progress.upper):
        values["upper"] = None
    return json.dumps(values)
