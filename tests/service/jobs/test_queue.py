"""The queue in PostgreSQL and the table of jobs: what is in one and not in the other."""

from __future__ import annotations

import asyncio
from collections.abc import Iterator
from typing import Any

import pytest
from sqlalchemy import text
from sqlalchemy.exc import OperationalError

from service.jobs.queue import enqueue, sweep
from service.jobs.queue_worker import _QueueWorker
from service.settings import Settings
from service.store import Store
from service.store.jobs import NewJob
from service.store.migrate import migrate
from tests.service.postgres import Postgres

JOB = NewJob(queue="plan", environment="e", ltl="F a", work="{}", told="{}", deadline_s=60.0)


@pytest.fixture
def store(postgres: Postgres) -> Iterator[Store]:
    """An empty one."""
    url = postgres.database()
    migrate(url)
    found = Store(url)
    yield found
    found.close()


def add(store: Store, *job_ids: str) -> None:
    with store.write() as transaction:
        for job_id in job_ids:
            transaction.jobs.add(job_id, JOB, accepted=True)
            enqueue(transaction, job_id, JOB.queue)


def entries(store: Store) -> list[tuple[str, str]]:
    with store.read() as transaction:
        found = transaction.connection.execute(
            text("SELECT args ->> 'job_id', queue_name FROM procrastinate_jobs WHERE status IN ('todo', 'doing')")
        )
        return sorted((job_id, queue) for job_id, queue in found)


def change(store: Store, statement: str) -> None:
    with store.write() as transaction:
        transaction.connection.execute(text(statement))


@pytest.mark.parametrize("state", ["queued", "running"])  # one that ran is "running" still when its worker gave it up
@pytest.mark.parametrize("loss", ["DELETE FROM procrastinate_jobs", "UPDATE procrastinate_jobs SET status = 'failed'"])
def test_a_job_that_was_taken_from_the_queue_in_vain_is_put_there_again_once(
    store: Store, loss: str, state: str
) -> None:
    add(store, "a", "b")
    change(store, f"UPDATE jobs SET state = '{state}'")
    sweep(store)
    assert entries(store) == [("a", "plan"), ("b", "plan")]
    change(store, f"{loss} WHERE args ->> 'job_id' = 'a'")
    for _ in range(2):
        sweep(store)
        assert entries(store) == [("a", "plan"), ("b", "plan")]


def test_a_job_is_stored_and_queued_together_or_not_at_all(store: Store) -> None:
    def fails() -> None:
        with store.write() as transaction:
            transaction.jobs.add("a", JOB, accepted=True)
            enqueue(transaction, "a", JOB.queue)
            raise OSError("the machine fails")

    with pytest.raises(OSError, match="the machine fails"):
        fails()
    assert entries(store) == []
    with store.read() as transaction:
        assert transaction.connection.execute(text("SELECT count(*) FROM jobs")).scalar_one() == 0
    add(store, "a")
    assert entries(store) == [("a", "plan")]


@pytest.mark.parametrize("status", ["todo", "doing"])
def test_what_is_in_the_queue_stays_there_once(store: Store, status: str) -> None:
    add(store, "a")
    change(store, f"UPDATE procrastinate_jobs SET status = '{status}'")
    sweep(store)
    assert entries(store) == [("a", "plan")]


def test_what_somebody_runs_and_what_has_ended_is_not_put_into_the_queue(store: Store) -> None:
    add(store, "claimed", "cancelled")
    with store.write() as transaction:
        assert transaction.jobs.claim("worker", 60.0, among=["claimed"]) == ["claimed"]
        transaction.jobs.cancel("cancelled")
    change(store, "DELETE FROM procrastinate_jobs")
    sweep(store)
    assert entries(store) == []


def test_a_worker_that_cannot_claim_a_job_leaves_it_to_the_sweep(
    store: Store, monkeypatch: pytest.MonkeyPatch, caplog: pytest.LogCaptureFixture
) -> None:
    """As when the database is killed at that moment: the queue's own entry ends, and the job is nobody's."""
    workers: Any = None
    worker = _QueueWorker(Settings(), store, workers)

    def lose(*_: object) -> None:
        raise OperationalError("SELECT", {}, Exception("server closed the connection"))

    monkeypatch.setattr(worker, "_claim", lose)
    asyncio.run(worker._run("a"))
    assert "job a could not be claimed" in caplog.text
