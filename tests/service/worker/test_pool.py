"""Worker processes: answers, refusals, deadlines, overload."""

from __future__ import annotations

import asyncio
import os
import time
from collections.abc import Coroutine, Iterator
from typing import Any, TypeVar

import pytest

from models.errors import Place
from models.logic import FormulaSyntaxError
from service.errors import OutOfTimeError, OverloadedError
from service.worker import Workers

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
    with pytest.raises(OverloadedError, match="died"):
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
