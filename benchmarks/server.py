"""A server of its own for a benchmark: a child process on a free port, with a new store."""

from __future__ import annotations

import os
import subprocess
import sys
import tempfile
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from pathlib import Path

import httpx


@contextmanager
def serving(folder: Path | None = None, **environment: str) -> Iterator[httpx.Client]:
    """A client of a new server with its store in `folder`, by default a new one; it stops when the context ends."""
    with (
        tempfile.TemporaryDirectory() as fresh,
        started(folder or Path(fresh), **environment) as process,
        httpx.Client(base_url=address(process), timeout=300) as client,
    ):
        yield client


@contextmanager
def started(
    folder: Path, *, cqltl: Sequence[str] = (sys.executable, "-m", "service"), **environment: str
) -> Iterator[subprocess.Popen[str]]:
    """The process of a server that may not listen yet; terminated when the context ends.

    `cqltl` is the command to run; another one than this code's is run in `folder`, as after an installation.
    """
    ours = cqltl[0] == sys.executable
    with subprocess.Popen(
        [*cqltl, "serve", "--port", "0"],
        cwd=None if ours else folder,
        env={**os.environ, "CQLTL_DATA_DIR": str(folder), "CQLTL_DATABASE_URL": "", **environment},
        stdout=subprocess.PIPE,
        text=True,
    ) as process:
        try:
            yield process
        finally:
            process.terminate()


def address(process: subprocess.Popen[str]) -> str:
    """The address that the server prints once it listens."""
    assert process.stdout is not None
    for line in process.stdout:
        if line.startswith("cqltl serves "):
            return line.split()[2]
    raise RuntimeError(f"the server ended with status {process.wait()} before it listened")
