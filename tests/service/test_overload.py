"""A writer from elsewhere holds the store: what needs it is refused for now, the process answers all the same."""

from __future__ import annotations

import concurrent.futures
import sqlite3
import statistics
import time
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

import httpx

from tests.service.conftest import check_problem


@contextmanager
def locked(folder: Path) -> Iterator[None]:
    """The store of a folder held by another writer."""
    lock = sqlite3.connect(folder / "cqltl.sqlite3", isolation_level=None)
    lock.execute("BEGIN IMMEDIATE")
    try:
        yield
    finally:
        lock.execute("ROLLBACK")
        lock.close()


def test_livez_needs_no_thread(server: httpx.Client, folder: Path) -> None:
    """Every request that writes holds a thread for seconds."""
    with concurrent.futures.ThreadPoolExecutor(80) as pool:
        with locked(folder):
            stuck = [pool.submit(server.delete, f"/environments/none{number}") for number in range(80)]
            time.sleep(1.5)
            assert not any(request.done() for request in stuck)
            waits = []
            for path in ("/livez", "/metrics") * 15:
                began = time.monotonic()
                assert server.get(path).status_code == 200
                waits.append(time.monotonic() - began)
            assert not any(request.done() for request in stuck), "it was measured after they had ended"
        assert {request.result().status_code for request in stuck} <= {404, 503}
    assert statistics.median(waits) < 0.1
    assert max(waits) < 1.0


def test_a_locked_store_is_not_ready_and_not_broken(server: httpx.Client, folder: Path) -> None:
    lesson = {"contextual_query": "hold(sphere)", "ltl": "F holding(sphere)", "environment": "toys"}
    with locked(folder):
        check_problem(server.post("/learn", json=lesson), "not-ready", 503)
    assert server.post("/learn", json=lesson).status_code == 201
