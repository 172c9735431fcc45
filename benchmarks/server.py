"""A server of its own for a benchmark: a child process on a free port, with a new store."""

from __future__ import annotations

import os
import subprocess
import sys
import tempfile
from collections.abc import Iterator
from contextlib import contextmanager

import httpx


@contextmanager
def serving() -> Iterator[httpx.Client]:
    """A client of a fresh server; the server stops when the context ends."""
    with tempfile.TemporaryDirectory() as folder:
        process = subprocess.Popen(
            [sys.executable, "-m", "service", "serve", "--port", "0"],
            env={**os.environ, "CQLTL_DATA_DIR": folder, "CQLTL_DATABASE_URL": ""},
            stdout=subprocess.PIPE,
            text=True,
        )
        try:
            with httpx.Client(base_url=_address(process), timeout=300) as client:
                yield client
        finally:
            process.terminate()
            process.wait(30)


def _address(process: subprocess.Popen[str]) -> str:
    """The address that the server prints once it listens."""
    assert process.stdout is not None
    for line in process.stdout:
        if line.startswith("cqltl serves "):
            return line.split()[2]
    raise RuntimeError(f"the server ended with status {process.wait()} before it listened")
