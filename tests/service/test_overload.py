"""The process answers although everything that requests wait for is taken."""

from __future__ import annotations

import concurrent.futures
import sqlite3
import statistics
import time
from pathlib import Path

from benchmarks.server import serving


def test_livez_needs_no_thread(tmp_path: Path) -> None:
    """A writer from elsewhere holds the store, so every request that writes holds a thread for seconds."""
    with serving(tmp_path) as client, concurrent.futures.ThreadPoolExecutor(80) as pool:
        lock = sqlite3.connect(tmp_path / "cqltl.sqlite3", isolation_level=None)
        lock.execute("BEGIN IMMEDIATE")
        stuck = [pool.submit(client.delete, f"/environments/none{number}") for number in range(80)]
        time.sleep(1.5)
        assert not any(request.done() for request in stuck)
        waits = []
        for path in ("/livez", "/metrics") * 15:
            began = time.monotonic()
            assert client.get(path).status_code == 200
            waits.append(time.monotonic() - began)
        assert not any(request.done() for request in stuck), "it was measured after they had ended"
        lock.execute("ROLLBACK")
        lock.close()
        assert {request.result().status_code for request in stuck} <= {404, 503}
    assert statistics.median(waits) < 0.1
    assert max(waits) < 1.0
