"""One real server for the tests of the HTTP contract, and the one way to check a problem."""

from __future__ import annotations

import os
import subprocess
import sys
from collections.abc import Callable, Iterator
from contextlib import redirect_stderr, redirect_stdout
from io import StringIO
from pathlib import Path
from typing import Any

import httpx
import pytest

from benchmarks.server import serving
from service.__main__ import main
from tests.service.postgres import Postgres

PROBLEM = "urn:cqltl:problem:"
MEMBERS = {"type", "title", "status", "detail", "errors", "line", "column", "caret", "choices", "question"}

Snapshot = Callable[[], dict[str, Any]]


@pytest.fixture(scope="session")
def client() -> Iterator[httpx.Client]:
    """A client of a server with a new store, shared by the tests: each uses names of its own."""
    with serving() as found:
        yield found


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Where `server` has its store."""
    return tmp_path_factory.mktemp("data")


@pytest.fixture(scope="module")
def server(folder: Path) -> Iterator[httpx.Client]:
    """A client of a server that the tests of one module share."""
    with serving(folder) as found:
        yield found


@pytest.fixture(scope="session")
def postgres() -> Iterator[Postgres]:
    """A PostgreSQL server; skips with what to install where there is none."""
    found = Postgres()
    yield found
    found.stop()


@pytest.fixture
def snapshot(client: httpx.Client) -> Snapshot:
    """Everything that requests can store by name, to compare before and after."""

    def take() -> dict[str, Any]:
        return {
            path: client.get(path, params={"limit": 200}).json()
            for path in ("/templates", "/environments", "/policies")
        }

    return take


def check_problem(
    response: httpx.Response, slug: str, status: int, pointers: list[str] | None = None
) -> dict[str, Any]:
    """Assert the canonical shape of a problem, its slug, status and pointers; the problem."""
    assert response.headers["content-type"] == "application/problem+json", response.text
    problem: dict[str, Any] = response.json()
    assert (problem["type"], response.status_code) == (PROBLEM + slug, status), problem
    assert problem["status"] == status
    assert problem["title"] == slug.replace("-", " ")
    assert problem["detail"]
    assert len(response.content) < 20_000, "a problem must not echo the request"
    assert set(problem) <= MEMBERS
    found = [place["pointer"] for place in problem["errors"]]
    assert all(pointer == "" or pointer.startswith("/") for pointer in found)
    if pointers is not None:
        assert found == pointers, problem
    return problem


def plan(client: httpx.Client, **body: Any) -> dict[str, Any]:
    """The answer to a plan that is not refused."""
    response = client.post("/plan", json=body)
    assert response.status_code == 200, response.text
    answer: dict[str, Any] = response.json()
    return answer


def run_cli(*arguments: str, data: Path, **environment: str) -> subprocess.CompletedProcess[str]:
    """Run `cqltl` with a data folder."""
    return subprocess.run(
        [sys.executable, "-m", "service", *arguments],
        env={**os.environ, "CQLTL_DATA_DIR": str(data), "CQLTL_DATABASE_URL": "", **environment},
        capture_output=True,
        text=True,
        timeout=120,
        check=False,
    )


def run_here(*arguments: str, data: Path, **environment: str) -> subprocess.CompletedProcess[str]:
    """As `run_cli`, in this process: to load what it needs takes seconds. Not for `serve`, which may not end."""
    out, error = StringIO(), StringIO()
    with pytest.MonkeyPatch.context() as patch, redirect_stdout(out), redirect_stderr(error):
        for name, value in {"CQLTL_DATA_DIR": str(data), "CQLTL_DATABASE_URL": "", **environment}.items():
            patch.setenv(name, value)
        try:
            status = main(arguments)
        except SystemExit as refused:  # as Python ends then: a text is said, and the status is 1
            said = isinstance(refused.code, str)
            status = 1 if said else int(refused.code or 0)
            error.write(str(refused.code) if said else "")
    return subprocess.CompletedProcess(arguments, status, out.getvalue(), error.getvalue())


def learn(client: httpx.Client, query: str, ltl: str, *examples: str, environment: str = "toys") -> httpx.Response:
    """Teach a task by one pair, with utterances."""
    body = {"contextual_query": query, "ltl": ltl, "environment": environment, "examples": list(examples)}
    return client.post("/learn", json=body)
