"""Worker processes: answers, refusals, deadlines, overload."""

from __future__ import annotations

import asyncio
import os
import signal
import time
from collections.abc import Coroutine, Iterator
from pathlib import Path
from typing import Any, TypeVar

import pytest

from models.errors import Place
from models.logic import FormulaSyntaxError
from service.errors import CannotStartError, OutOfMemoryError, OutOfTimeError, OverloadedError, WorkerDiedError
from service.worker import CallCancelled, Workers
from service.worker.child import board
from service.worker.progress import Meter

T = TypeVar("T")


@pytest.fixture(scope="module")
def workers() -> Iterator[Workers]:
    found = Workers(planners=1, max_waiting=2)
    found.start(warm=True)
    yield found
    found.stop()


def double(number: int) -> int:
    return 2 * number


def refuse(detail: str) -> None:
    error = FormulaSyntaxError(detail, line=1, column=2, caret="x")
    error.places = (Place("/a", "b"),)
    raise error


def die(status: int) -> None:
    os._exit(status)


def run(coroutine: Coroutine[Any, Any, T]) -> T:
    return asyncio.run(coroutine)


def test_answers(workers: Workers) -> None:
    assert run(workers.plan(double, 21, timeout_s=30)) == 42
    assert run(workers.check(double, 4, timeout_s=30)) == 8


def test_a_refusal_arrives_whole(workers: Workers) -> None:
    with pytest.raises(FormulaSyntaxError) as caught:
        run(workers.check(refuse, "wrong", timeout_s=30))
    error = caught.value
    assert (error.detail, error.line, error.column, error.caret) == ("wrong", 1, 2, "x")
    assert error.places == (Place("/a", "b"),)


def test_a_job_beyond_its_time_is_killed_and_the_next_one_runs(workers: Workers) -> None:
    started = time.monotonic()
    with pytest.raises(OutOfTimeError):
        run(workers.plan(time.sleep, 60, timeout_s=0.3))
    assert time.monotonic() - started < 10
    assert run(workers.plan(double, 1, timeout_s=30)) == 2


def test_a_process_that_dies_takes_nobody_with_it(workers: Workers) -> None:
    with pytest.raises(WorkerDiedError, match="died"):
        run(workers.plan(die, 3, timeout_s=30))
    assert run(workers.plan(double, 1, timeout_s=30)) == 2


def test_too_many_waiting_are_refused(workers: Workers) -> None:
    async def crowd() -> list[object]:
        jobs = [workers.plan(time.sleep, 0.3, timeout_s=30) for _ in range(6)]
        return await asyncio.gather(*jobs, return_exceptions=True)

    outcomes = run(crowd())
    assert sum(isinstance(outcome, OverloadedError) for outcome in outcomes) == 3
    assert outcomes.count(None) == 3
    assert run(workers.plan(double, 1, timeout_s=30)) == 2


def spin(_: None) -> None:
    """Native code that holds the interpreter and never looks at signals."""
    sum(range(10**12))


def hoard(count: int) -> int:
    return len(bytearray(count))


def die_once(mark: str) -> int:
    if not Path(mark).exists():
        Path(mark).touch()
        os.kill(os.getpid(), signal.SIGKILL)
    return 7


def report(_: None) -> None:
    Meter(board())("steps", 3, 1.5, 2.5, 99)
    time.sleep(60)


@pytest.mark.parametrize("function", [time.sleep, spin], ids=["sleeping", "native"])
def test_cancelling_kills_at_once(workers: Workers, function: Any) -> None:
    async def cancelled() -> float:
        call = workers.begin(function, 60 if function is time.sleep else None, timeout_s=60)
        while not call.started:
            await asyncio.sleep(0.01)
        await asyncio.sleep(0.1)
        began = time.monotonic()
        call.cancel()
        with pytest.raises(CallCancelled):
            await call.result()
        return time.monotonic() - began

    assert run(cancelled()) < 1.0
    assert run(workers.plan(double, 1, timeout_s=30)) == 2


def test_a_call_that_waits_can_be_cancelled(workers: Workers) -> None:
    async def cancelled() -> None:
        first, second = workers.begin(time.sleep, 1, timeout_s=9), workers.begin(double, 1, timeout_s=9)
        second.cancel()
        with pytest.raises(CallCancelled):
            await second.result()
        assert not first.future.done()
        assert await first.result() is None

    run(cancelled())


def test_whoever_stops_waiting_for_a_plan_ends_it(workers: Workers) -> None:
    async def given_up() -> None:
        with pytest.raises(TimeoutError):
            await asyncio.wait_for(workers.plan(time.sleep, 60, timeout_s=60), 0.3)

    run(given_up())
    began = time.monotonic()
    assert run(workers.plan(double, 1, timeout_s=30)) == 2
    assert time.monotonic() - began < 20


def test_an_idle_process_that_is_killed_is_replaced(workers: Workers) -> None:
    for _ in range(3):
        os.kill(run(workers.plan(own_id, None, timeout_s=30)), signal.SIGKILL)
    assert run(workers.plan(double, 1, timeout_s=30)) == 2


def own_id(_: None) -> int:
    return os.getpid()


def test_a_call_whose_process_is_killed_is_run_again(workers: Workers, tmp_path: Path) -> None:
    assert run(workers.plan(die_once, str(tmp_path / "mark"), timeout_s=30)) == 7


def test_progress_is_seen_while_a_call_runs(workers: Workers) -> None:
    async def seen() -> None:
        call = workers.begin(report, None, timeout_s=60)
        while call.progress is None:
            await asyncio.sleep(0.01)
        found = call.progress
        assert (found.stage, found.sweep, found.lower, found.upper, found.states) == ("steps", 3, 1.5, 2.5, 99)
        call.cancel()
        with pytest.raises(CallCancelled):
            await call.result()
        assert call.progress is None

    run(seen())


def test_beyond_the_limit_of_memory_is_a_refusal_and_the_memory_comes_back() -> None:
    limit = 4 * 2**30
    limited = Workers(planners=1, max_waiting=2, memory_bytes=limit)
    limited.start(warm=True)
    try:
        before = run(limited.plan(own_id, None, timeout_s=30))
        assert run(limited.plan(hoard, 2**20, timeout_s=30)) == 2**20
        with pytest.raises(OutOfMemoryError, match=str(limit)):
            run(limited.plan(hoard, limit, timeout_s=30))
        assert run(limited.plan(own_id, None, timeout_s=30)) != before, "its memory went with the process"
    finally:
        limited.stop()


def test_stopping_ends_whatever_runs_or_waits() -> None:
    found = Workers(planners=1, max_waiting=2)
    found.start(warm=False)

    async def stopped() -> list[object]:
        calls = [asyncio.ensure_future(found.begin(time.sleep, 60, timeout_s=60).result()) for _ in range(2)]
        await asyncio.sleep(0.2)
        began = time.monotonic()
        await asyncio.to_thread(found.stop)
        assert time.monotonic() - began < 5
        return await asyncio.gather(*calls, return_exceptions=True)

    assert [type(outcome) for outcome in run(stopped())] == [CallCancelled, CallCancelled]


def fail() -> None:
    raise RuntimeError("nothing to load")


def refuse_to_start(*arguments: Any) -> None:
    raise RuntimeError("no room for a process")


@pytest.fixture
def broken(monkeypatch: pytest.MonkeyPatch, request: pytest.FixtureRequest) -> Iterator[Workers]:
    """Workers whose processes cannot be made, or end while they load."""
    if request.param == "made":
        monkeypatch.setattr("service.worker.pool.Child", refuse_to_start)
    else:
        monkeypatch.setattr("service.worker.pool.warm_planning", fail)
    found = Workers(planners=2, max_waiting=2)
    yield found
    found.stop()


@pytest.mark.parametrize(
    ("broken", "said"), [("made", "no room for a process"), ("loaded", "died")], indirect=["broken"]
)
def test_processes_that_cannot_be_started_are_told_of_and_nobody_waits(broken: Workers, said: str) -> None:
    broken.start(warm=True)
    with pytest.raises(CannotStartError, match=said) as caught:
        broken.loaded()
    assert "\n" not in str(caught.value)
    with pytest.raises(WorkerDiedError):
        run(broken.plan(double, 1, timeout_s=30))


def test_stopping_does_not_wait_for_what_loads(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("service.worker.pool.warm_planning", linger)
    found = Workers(planners=1, max_waiting=2)
    found.start(warm=True)
    time.sleep(0.5)
    began = time.monotonic()
    found.stop()
    assert time.monotonic() - began < 5


def linger() -> None:
    time.sleep(60)
