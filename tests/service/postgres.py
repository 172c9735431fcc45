"""A PostgreSQL server of the tests' own: on a free port, with its data in a new folder."""

from __future__ import annotations

import contextlib
import itertools
import os
import pwd
import shutil
import signal
import socket
import subprocess
import tempfile
from pathlib import Path

import psycopg
import pytest

from benchmarks.processes import children, gone_within

MISSING = (
    "these tests start a PostgreSQL server of their own and found no initdb: install PostgreSQL 13 or newer "
    "(Debian and Ubuntu: apt install postgresql), or put its bin folder on PATH"
)
USERS = ("postgres", "nobody")
"""Who it runs as where the tests run as root, which PostgreSQL refuses to."""


def _bin() -> Path | None:
    """The folder of its programs: of PATH, or the newest where Debian has them."""
    found = shutil.which("initdb")
    if found is not None:
        return Path(found).parent
    folders = sorted(Path("/usr/lib/postgresql").glob("*/bin"), key=lambda path: int(path.parent.name))
    return folders[-1] if folders else None


class Postgres:
    """The server; it can be killed and started again."""

    def __init__(self) -> None:
        folder = _bin()
        if folder is None:
            pytest.skip(MISSING)
        self._bin = folder
        self._user = next((user for user in USERS if _exists(user)), None) if os.geteuid() == 0 else None
        self._data = Path(tempfile.mkdtemp(prefix="cqltl-postgres-"))
        if self._user is not None:
            shutil.chown(self._data, self._user)
        self._call("initdb", "--auth=trust", "--username=cqltl", "--encoding=UTF8", "--no-locale", "--no-sync")
        with socket.socket() as free:
            free.bind(("127.0.0.1", 0))
            self._port = free.getsockname()[1]
        self._numbers = itertools.count(1)
        self.start()

    def start(self) -> None:
        """Start it, and wait until it answers."""
        self._call("pg_ctl", "--wait", "--log", str(self._data / "log"), "--options", self._options(), "start")

    def kill(self) -> None:
        """End it with everything below it, without asking."""
        lock = self._data / "postmaster.pid"
        pid = int(lock.read_text().split()[0])
        found = {pid, *children(pid)}
        for number in found:
            with contextlib.suppress(ProcessLookupError):  # children end with their parent
                os.kill(number, signal.SIGKILL)
        assert all(gone_within(number, 10) for number in found)
        lock.unlink()  # it may name a process that is dead and not yet buried

    def database(self, options: str = "") -> str:
        """The SQLAlchemy URL of a new database, made with some options."""
        name = f"cqltl{next(self._numbers)}"
        with psycopg.connect(f"postgresql://cqltl@127.0.0.1:{self._port}/postgres", autocommit=True) as connection:
            connection.execute(f"CREATE DATABASE {name} {options}")  # type: ignore[arg-type]
        return f"postgresql+psycopg://cqltl@127.0.0.1:{self._port}/{name}"

    def stop(self) -> None:
        """End it, and delete its data."""
        self._call("pg_ctl", "--mode=immediate", "stop", check=False)
        shutil.rmtree(self._data, ignore_errors=True)

    def _options(self) -> str:
        return f"-h 127.0.0.1 -p {self._port} -k {self._data} -c fsync=off -c max_connections=300"

    def _call(self, program: str, *arguments: str, check: bool = True) -> None:
        as_user = () if self._user is None else ("setpriv", f"--reuid={self._user}", "--clear-groups")
        result = subprocess.run(
            [*as_user, str(self._bin / program), "-D", str(self._data), *arguments],
            cwd=self._data,
            stdout=subprocess.DEVNULL,
            stderr=subprocess.PIPE,
            text=True,
            check=False,
        )
        assert not check or result.returncode == 0, result.stderr


def _exists(user: str) -> bool:
    try:
        pwd.getpwnam(user)
    except KeyError:
        return False
    return True
