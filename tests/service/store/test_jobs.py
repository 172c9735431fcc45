"""Jobs in the store: who owns them, leases, ends that never change; answers under keys."""

from __future__ import annotations

import threading
import time
from collections.abc import Iterator
from pathlib import Path

import pytest

from service.errors import KeyInUseError, UnknownJobError
from service.store import KeptAnswer, NewJob, Once, Store
from service.store.jobs import new_id
from service.store.migrate import migrate

JOB = NewJob(queue="plan", environment="e", ltl="F a", work="{}", told="{}", deadline_s=60.0)


@pytest.fixture(params=["sqlite", "postgresql"])
def store(request: pytest.FixtureRequest, tmp_path: Path) -> Iterator[Store]:
    sqlite = request.param == "sqlite"
    url = f"sqlite:///{tmp_path / 'store.sqlite3'}" if sqlite else request.getfixturevalue("postgres").database()
    migrate(url)
    found = Store(url)
    yield found
    found.close()


def add(store: Store, owner: str | None = None, lease_s: float = 60.0, job: NewJob = JOB, accepted: bool = True) -> str:
    job_id = new_id()
    with store.write() as transaction:
        transaction.jobs.add(job_id, job, accepted=accepted, owner=owner, lease_s=lease_s)
    return job_id


def claim(store: Store, owner: str, most: int = 9) -> list[str]:
    with store.write() as transaction:
        return transaction.jobs.claim(owner, 60.0, most=most)


def test_ids_are_in_the_order_of_time() -> None:
    first = new_id()
    time.sleep(0.002)
    assert first < new_id()
    assert len({new_id() for _ in range(1000)}) == 1000


def test_a_job_comes_back_as_it_was_stored(store: Store) -> None:
    before = time.time()
    job_id = add(store, "me")
    with store.read() as transaction:
        job = transaction.jobs.get(job_id)
        with pytest.raises(UnknownJobError, match="nobody"):
            transaction.jobs.get("nobody")
    assert (job.state, job.accepted, job.owner, job.attempts, job.ended) == ("queued", True, "me", 1, False)
    assert (job.queue, job.environment, job.ltl, job.work, job.told) == ("plan", "e", "F a", "{}", "{}")
    assert before - 1 < job.created_at < time.time() + 1  # the clock of SQLite counts milliseconds
    assert job.deadline == pytest.approx(job.created_at + 60, abs=0.1)
    assert job.lease_until == pytest.approx(job.created_at + 60, abs=0.1)


def test_only_what_nobody_runs_can_be_claimed_oldest_first(store: Store) -> None:
    free = [add(store), add(store)]
    add(store, "other")
    lapsed = add(store, "dead", lease_s=-1.0)
    assert claim(store, "me", most=1) == sorted(free)[:1]
    assert sorted(claim(store, "me")) == sorted([*free, lapsed])[1:]
    assert claim(store, "third") == []
    with store.read() as transaction:
        assert transaction.jobs.get(lapsed).attempts == 2


def test_eight_claimers_get_each_job_once(store: Store) -> None:
    wanted = {add(store) for _ in range(40)}
    got: list[str] = []

    def take(name: str) -> None:
        while found := claim(store, name, most=3):
            got.extend(found)

    threads = [threading.Thread(target=take, args=(f"owner {n}",)) for n in range(8)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert len(got) == len(wanted)
    assert set(got) == wanted


def test_only_the_owner_changes_a_job(store: Store) -> None:
    job_id = add(store, "me")
    with store.write() as transaction:
        jobs = transaction.jobs
        assert not jobs.renew(job_id, "other", 60.0, running=True, progress="{}")
        assert not jobs.finish(job_id, "other", "succeeded", answer="{}")
        assert jobs.renew(job_id, "me", 60.0, running=True, progress='{"a": 1}')
        assert jobs.lost("me", [job_id, "gone"]) == {"gone"}
        assert jobs.lost("other", [job_id]) == {job_id}
        assert (jobs.get(job_id).state, jobs.get(job_id).progress) == ("running", '{"a": 1}')
        assert jobs.finish(job_id, "me", "succeeded", answer="{}", policy_id="p")
        job = jobs.get(job_id)
    assert (job.state, job.answer, job.policy_id, job.owner) == ("succeeded", "{}", "p", None)
    assert job.ended_at is not None


@pytest.mark.parametrize("end", ["succeeded", "failed", "cancelled"])
def test_ends_never_change(store: Store, end: str) -> None:
    job_id = add(store, "me")
    with store.write() as transaction:
        jobs = transaction.jobs
        if end == "cancelled":
            jobs.cancel(job_id)
        else:
            jobs.finish(job_id, "me", "succeeded" if end == "succeeded" else "failed")
        ended = jobs.get(job_id)
        assert ended.state == end
        jobs.cancel(job_id)
        assert not jobs.finish(job_id, "me", "failed", error="{}")
        assert not jobs.renew(job_id, "me", 60.0, running=True, progress=None)
        assert not jobs.fail(job_id, "{}")
        jobs.release("me")
        jobs.abandon(job_id)
        assert jobs.claim("me", 60.0) == []
        assert jobs.get(job_id) == ended


def test_what_is_released_or_abandoned_is_free(store: Store) -> None:
    mine, lapsed = add(store, "me"), add(store, "dead", lease_s=-1.0)
    with store.write() as transaction:
        jobs = transaction.jobs
        assert jobs.release("me") == [mine]
        assert [job.id for job in jobs.abandoned()] == [lapsed]
        jobs.abandon(lapsed)
        jobs.abandon(mine)
        assert jobs.abandoned() == []
        assert set(jobs.unowned(limit=9)) == {mine, lapsed}
        assert jobs.waiting() == 2


def test_beyond_its_deadline_a_job_is_not_run_but_failed(store: Store) -> None:
    late = NewJob(queue="plan", environment="e", ltl="F a", work="{}", told="{}", deadline_s=-1.0)
    free, owned = add(store, job=late), add(store, "me", job=late)
    assert claim(store, "me") == []
    with store.write() as transaction:
        assert transaction.jobs.overdue() == [free]  # its owner ends the other one
        assert transaction.jobs.fail(free, '{"slug": "out-of-time"}')
        assert not transaction.jobs.fail(owned, "{}")
        assert transaction.jobs.get(free).error == '{"slug": "out-of-time"}'


def test_lists_have_what_clients_were_told_of(store: Store) -> None:
    told, waited_for = add(store), add(store, accepted=False)
    with store.write() as transaction:
        assert [entry.id for entry in transaction.jobs.page(limit=9)] == [told]
        transaction.jobs.accept(waited_for)
        assert [entry.id for entry in transaction.jobs.page(limit=9)] == sorted([told, waited_for])
        first, second = transaction.jobs.page(limit=9)
        assert transaction.jobs.page(after=first.id, limit=9) == [second]


def test_what_ended_long_ago_is_forgotten(store: Store) -> None:
    active, ended, unaccepted = add(store), add(store, "me"), add(store, "me", accepted=False)
    with store.write() as transaction:
        transaction.jobs.finish(ended, "me", "failed")
        transaction.jobs.finish(unaccepted, "me", "failed")
        assert transaction.jobs.purge(ended_s=60, unaccepted_s=60) == 0
        assert transaction.jobs.purge(ended_s=60, unaccepted_s=-1) == 1
        assert transaction.jobs.get(ended).state == "failed"
        assert transaction.jobs.purge(ended_s=-1, unaccepted_s=-1) == 1
        assert transaction.jobs.get(active).state == "queued"


def test_answers_are_kept_per_operation_and_key(store: Store) -> None:
    once, answer = Once("learn", "k", "digest"), KeptAnswer(status=201, location="/x", body="{}")
    with store.write() as transaction:
        answers = transaction.answers
        assert answers.find(once) is None
        assert answers.keep(once, answer)
        assert not answers.keep(once, KeptAnswer(job_id="j"))
        assert answers.find(once) == answer
        with pytest.raises(KeyInUseError):
            answers.find(Once("learn", "k", "other"))
        assert answers.find(Once("plan", "k", "other")) is None
        assert answers.purge(older_s=60) == 0
        assert answers.purge(older_s=-1) == 1
        assert answers.find(once) is None
