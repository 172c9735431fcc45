"""A disk that is full, and stores that the service refuses to start on."""

from __future__ import annotations

import resource
import shutil
import sqlite3
import subprocess
from collections.abc import Iterator
from contextlib import closing
from pathlib import Path
from typing import Any

import httpx
import pytest

from benchmarks.server import address, serving, started
from models.world import toys_spec
from service.store.migrate import migrate
from tests.service.conftest import check_problem, run_cli

STORE = "cqltl.sqlite3"
ASKED = {"text": "Pickup the sphere", "environment": "toys"}


def world(number: int) -> dict[str, Any]:
    """An environment of some 5 kB; no two are the same."""
    spec = toys_spec(columns=2, rows=1, toys=[("cube", "red")])
    cube = {**spec["objects"]["cube"], "synonyms": [f"thing {number} {i} {'x' * 80}" for i in range(50)]}
    return {**spec, "name": f"w{number}", "objects": {**spec["objects"], "cube": cube}}


def fill(url: str | httpx.URL, most: int = 2_000) -> tuple[int, httpx.Response]:
    """Store worlds until one is refused: how many were stored, and the refusal."""
    for number in range(most):
        response = httpx.post(f"{url}/environments", json=world(number), timeout=60)
        if response.status_code != 201:
            return number, response
    raise AssertionError("it never was full")


def check_full(url: str, stored: int, refusal: httpx.Response) -> None:
    """Reads go on, every write is refused as such, and what was acknowledged is there."""
    check_problem(refusal, "insufficient-storage", 507)
    check_problem(httpx.post(f"{url}/environments", json=world(99_999), timeout=60), "insufficient-storage", 507)
    plan = httpx.post(f"{url}/plan", json={"ltl": "F holding(cube)", "environment": "w0"}, timeout=60)
    if plan.status_code != 200:  # a small policy may still find room
        check_problem(plan, "insufficient-storage", 507)
    assert httpx.get(f"{url}/environments/w{stored - 1}", timeout=60).json()["name"] == f"w{stored - 1}"
    assert httpx.get(f"{url}/environments/w{stored}", timeout=60).status_code == 404
    for path in ("/readyz", "/livez", "/templates/ship", "/jobs"):
        assert httpx.get(url + path, timeout=60).status_code == 200
    said = httpx.post(f"{url}/translate", json=ASKED, timeout=60)
    assert said.json()["outcome"] == "translated"


def whole(folder: Path) -> bool:
    connection = sqlite3.connect(folder / STORE)
    try:
        return bool(connection.execute("PRAGMA integrity_check").fetchall() == [("ok",)])
    finally:
        connection.close()


def test_the_largest_size_of_the_store(tmp_path: Path) -> None:
    most = 700_000
    with serving(tmp_path, CQLTL_MAX_STORE_BYTES=str(most)) as client:
        url = str(client.base_url)
        stored, refusal = fill(url)
        check_full(url, stored, refusal)
        for number in range(stored):
            assert client.delete(f"/environments/w{number}").status_code == 204
        assert client.post("/environments", json=world(0)).status_code == 201
        assert client.post("/plan", json={"ltl": "F holding(cube)", "environment": "w0"}).status_code == 200
    assert (tmp_path / STORE).stat().st_size <= most
    assert whole(tmp_path)


def check_room(url: str, folder: Path, stored: int) -> None:
    """Without a restart there is room again; all that was acknowledged is in the file."""
    assert httpx.post(f"{url}/environments", json=world(stored), timeout=60).status_code == 201
    plan = httpx.post(f"{url}/plan", json={"ltl": "F holding(cube)", "environment": f"w{stored}"}, timeout=60)
    assert plan.status_code == 200
    with closing(sqlite3.connect(folder / STORE)) as store:
        names = {name for (name,) in store.execute("SELECT name FROM environments")}
    assert {f"w{number}" for number in range(stored + 1)} <= names


def test_files_that_may_not_grow_and_then_may(tmp_path: Path) -> None:
    with started(tmp_path) as process:
        url = address(process)
        _, hard = resource.prlimit(process.pid, resource.RLIMIT_FSIZE)
        size = max(path.stat().st_size for path in tmp_path.iterdir())
        resource.prlimit(process.pid, resource.RLIMIT_FSIZE, (size + 50_000, hard))
        stored, refusal = fill(url)
        check_full(url, stored, refusal)
        resource.prlimit(process.pid, resource.RLIMIT_FSIZE, (hard, hard))
        check_room(url, tmp_path, stored)
        process.kill()
    assert whole(tmp_path)


@pytest.fixture
def disk(tmp_path: Path) -> Iterator[Path]:
    """A small one of its own."""
    folder = tmp_path / "disk"
    folder.mkdir()
    mount = ["mount", "-t", "tmpfs", "-o", "size=2m", "tmpfs", folder]
    if shutil.which("mount") is None or subprocess.run(mount, capture_output=True, check=False).returncode:
        pytest.skip("to mount a small disk takes root")
    yield folder
    subprocess.run(["umount", "--lazy", folder], check=True)


def test_a_disk_that_is_full_and_then_is_not(disk: Path) -> None:
    with started(disk) as process:
        url = address(process)
        stored, refusal = fill(url)
        check_full(url, stored, refusal)
        subprocess.run(["mount", "-o", "remount,size=4m", disk], check=True)
        check_room(url, disk, stored)
        process.kill()
    assert whole(disk)


@pytest.mark.parametrize("command", [["serve", "--port", "0"], ["translate", "Pickup the sphere"]])
def test_a_store_of_something_else_is_not_started_on(tmp_path: Path, command: list[str]) -> None:
    path = tmp_path / STORE
    path.write_bytes(b"the diary of a robot\n" * 500)
    before = path.read_bytes()
    result = run_cli(*command, data=tmp_path)
    assert result.returncode == 1
    assert result.stdout == ""
    assert result.stderr == f"{path} is not a SQLite database; it was left as it is\n"
    assert path.read_bytes() == before
    assert list(tmp_path.iterdir()) == [path]


def test_a_store_that_was_truncated_is_not_started_on(tmp_path: Path) -> None:
    path = tmp_path / STORE
    migrate(f"sqlite:///{path}")
    content = path.read_bytes()[:40_000]
    path.write_bytes(content)
    result = run_cli("serve", "--port", "0", data=tmp_path)
    assert result.returncode == 1
    assert result.stderr.count("\n") == 1
    assert f"{path} is damaged" in result.stderr
    assert path.read_bytes() == content
