"""Plans that are made while nobody waits: who runs which, and what became of it.

A job belongs to the process that runs it as long as that process renews its lease, on the clock of the database. Every
change asks for the owner, so a process that lost a job cannot change it any more. States go from queued to running to
one of the ends, and ends never change.
"""

from __future__ import annotations

import secrets
import time
from collections.abc import Collection, Mapping
from dataclasses import dataclass
from typing import Any, Literal

from sqlalchemy import ColumnElement, Connection, Select, and_, delete, func, insert, or_, select, update

from service.errors import UnknownJobError
from service.store.dialect import epoch
from service.store.tables import jobs

JobState = Literal["queued", "running", "succeeded", "failed", "cancelled"]
Ending = Literal["succeeded", "failed"]

_ACTIVE = jobs.c.state.in_(("queued", "running"))


@dataclass(frozen=True, slots=True)
class NewJob:
    """What is known of a job when it is accepted; `work` and `told` are JSON texts."""

    queue: str
    environment: str
    ltl: str
    work: str
    told: str
    deadline_s: float  # from now


@dataclass(frozen=True, slots=True)
class StoredJob:
    """A job; `progress`, `answer` and `error` are JSON texts. Times are seconds since 1970."""

    id: str
    state: JobState
    accepted: bool
    queue: str
    environment: str
    ltl: str
    work: str
    told: str
    progress: str | None
    answer: str | None
    policy_id: str | None
    error: str | None
    attempts: int
    owner: str | None
    lease_until: float | None
    created_at: float
    deadline: float
    ended_at: float | None

    @property
    def ended(self) -> bool:
        """Its state will not change any more."""
        return self.state not in ("queued", "running")


@dataclass(frozen=True, slots=True)
class JobEntry:
    """What a list says of a job."""

    id: str
    state: JobState
    environment: str
    ltl: str


def new_id() -> str:
    """An id that nobody guesses; ids of later milliseconds are greater."""
    return f"{time.time_ns() // 1_000_000:012x}{secrets.token_hex(10)}"


class JobRepository:
    """Jobs by id, within one transaction."""

    def __init__(self, connection: Connection) -> None:
        self._connection = connection

    def add(
        self,
        job_id: str,
        job: NewJob,
        *,
        accepted: bool,
        owner: str | None = None,
        lease_s: float = 0.0,
        running: bool = False,
    ) -> None:
        """Store a job, as one of `owner` if there is one."""
        self._connection.execute(
            insert(jobs).values(
                id=job_id,
                state="running" if running else "queued",
                accepted=accepted,
                queue=job.queue,
                environment=job.environment,
                ltl=job.ltl,
                work=job.work,
                told=job.told,
                attempts=0 if owner is None else 1,
                owner=owner,
                lease_until=None if owner is None else epoch() + lease_s,
                created_at=epoch(),
                deadline=epoch() + job.deadline_s,
            )
        )

    def get(self, job_id: str) -> StoredJob:
        """The job; raises `UnknownJobError`."""
        row = self._connection.execute(select(jobs).where(jobs.c.id == job_id)).first()
        if row is None:
            raise UnknownJobError(f'no job has the id "{job_id[:100]}"')
        return StoredJob(**row._mapping)

    def page(self, *, after: str = "", limit: int) -> list[JobEntry]:
        """Up to `limit` jobs in the order they were accepted, from the first whose id is greater than `after`."""
        columns = (jobs.c.id, jobs.c.state, jobs.c.environment, jobs.c.ltl)
        rows = self._connection.execute(
            select(*columns).where(jobs.c.accepted, jobs.c.id > after).order_by(jobs.c.id).limit(limit)
        )
        return [JobEntry(**row._mapping) for row in rows]

    def unowned(self, *, limit: int) -> list[str]:
        """Ids of jobs that nobody runs, oldest first."""
        return list(self._connection.scalars(_free().order_by(jobs.c.id).limit(limit)))

    def waiting(self) -> int:
        """How many jobs no process has taken up."""
        found = self._connection.scalar(
            select(func.count()).select_from(jobs).where(jobs.c.state == "queued", jobs.c.owner.is_(None))
        )
        return int(found or 0)

    def accept(self, job_id: str) -> None:
        """Note that a client was told of the job."""
        self._connection.execute(update(jobs).where(jobs.c.id == job_id).values(accepted=True))

    def claim(self, owner: str, lease_s: float, *, among: Collection[str] | None = None, most: int = 1) -> list[str]:
        """Take up to `most` jobs that nobody runs, oldest first; `among` these ids, or any."""
        free = _free()
        if among is not None:
            free = free.where(jobs.c.id.in_(among))
        found = self._connection.scalars(free.order_by(jobs.c.id).limit(most).with_for_update(skip_locked=True)).all()
        if found:
            self._connection.execute(
                update(jobs)
                .where(jobs.c.id.in_(found))
                .values(owner=owner, lease_until=epoch() + lease_s, attempts=jobs.c.attempts + 1)
            )
        return list(found)

    def abandoned(self) -> list[StoredJob]:
        """Jobs whose owner has not renewed its lease."""
        rows = self._connection.execute(select(jobs).where(_ACTIVE, jobs.c.lease_until <= epoch()))
        return [StoredJob(**row._mapping) for row in rows]

    def renew(self, job_id: str, owner: str, lease_s: float, *, running: bool, progress: str | None) -> bool:
        """Go on owning a job, and say how far it is; False where it is not this owner's any more, or has ended."""
        values: dict[str, Any] = {"lease_until": epoch() + lease_s}
        if running:
            values["state"] = "running"
        if progress is not None:
            values["progress"] = progress
        return self._change(job_id, owner, values)

    def lost(self, owner: str, ids: Collection[str]) -> set[str]:
        """Those of the jobs that are not this owner's any more, or have ended."""
        kept = self._connection.scalars(
            select(jobs.c.id).where(jobs.c.id.in_(ids), jobs.c.owner == owner, _ACTIVE)
        ).all()
        return set(ids) - set(kept)

    def release(self, owner: str) -> list[str]:
        """Give up all jobs of an owner, for others to take up; their ids."""
        mine = and_(jobs.c.owner == owner, _ACTIVE)
        found = list(self._connection.scalars(select(jobs.c.id).where(mine)))
        self._connection.execute(update(jobs).where(mine).values(owner=None, lease_until=None))
        return found

    def abandon(self, job_id: str) -> bool:
        """Take a job from the owner that has not renewed its lease, for others to take up; False where that was done
        already.
        """
        found = self._connection.execute(
            update(jobs)
            .where(jobs.c.id == job_id, _ACTIVE, jobs.c.lease_until <= epoch())
            .values(owner=None, lease_until=None)
        )
        return found.rowcount > 0

    def finish(
        self,
        job_id: str,
        owner: str,
        state: Ending,
        *,
        answer: str | None = None,
        policy_id: str | None = None,
        error: str | None = None,
    ) -> bool:
        """End a job; False where it is not this owner's any more, or has ended."""
        return self._change(job_id, owner, _end(state) | {"answer": answer, "policy_id": policy_id, "error": error})

    def fail(self, job_id: str, error: str) -> bool:
        """End a job that nobody runs; False where somebody does, or it has ended."""
        found = self._connection.execute(
            update(jobs).where(jobs.c.id == job_id, _ACTIVE, _unowned()).values(_end("failed") | {"error": error})
        )
        return found.rowcount > 0

    def cancel(self, job_id: str) -> None:
        """End a job that has not ended; raises `UnknownJobError`."""
        self.get(job_id)
        self._connection.execute(update(jobs).where(jobs.c.id == job_id, _ACTIVE).values(_end("cancelled")))

    def overdue(self) -> list[str]:
        """Ids of jobs beyond their deadline that nobody runs."""
        return list(self._connection.scalars(select(jobs.c.id).where(_ACTIVE, _unowned(), jobs.c.deadline <= epoch())))

    def delete(self, job_id: str) -> None:
        """Forget a job, if it is there."""
        self._connection.execute(delete(jobs).where(jobs.c.id == job_id))

    def purge(self, *, ended_s: float, unaccepted_s: float) -> int:
        """Forget jobs that ended so long ago, sooner those of which no client was told; how many."""
        old = or_(
            jobs.c.ended_at < epoch() - ended_s,
            and_(jobs.c.accepted.is_(False), jobs.c.ended_at < epoch() - unaccepted_s),
        )
        return self._connection.execute(delete(jobs).where(old)).rowcount

    def _change(self, job_id: str, owner: str, values: Mapping[str, Any]) -> bool:
        found = self._connection.execute(
            update(jobs).where(jobs.c.id == job_id, jobs.c.owner == owner, _ACTIVE).values(values)
        )
        return found.rowcount > 0


def _unowned() -> ColumnElement[bool]:
    return or_(jobs.c.owner.is_(None), jobs.c.lease_until <= epoch())


def _free() -> Select[str]:
    return select(jobs.c.id).where(_ACTIVE, _unowned(), jobs.c.deadline > epoch())


def _end(state: JobState) -> dict[str, Any]:
    return {"state": state, "ended_at": epoch(), "owner": None, "lease_until": None}
