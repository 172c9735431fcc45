"""The wheel has everything in it, and serves where there is no checkout (`make wheel-check`)."""

from __future__ import annotations

import os
import subprocess
import sys
import tempfile
import venv
import zipfile
from collections.abc import Iterator
from pathlib import Path

import httpx
import pytest

from benchmarks.server import address, started

ROOT = Path(__file__).parents[2]
PACKAGES = ("models", "service", "migrations")
FOR_AUTHORS = {"migrations/script.py.mako"}

pytestmark = pytest.mark.long


@pytest.fixture(scope="module")
def wheel(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Built from what git has, or is about to have, so that nothing else of this folder gets in."""
    source, dist = tmp_path_factory.mktemp("source"), tmp_path_factory.mktemp("dist")
    for name in tracked(*PACKAGES, "pyproject.toml", "README.md", "LICENSE"):
        (source / name).parent.mkdir(parents=True, exist_ok=True)
        (source / name).write_bytes((ROOT / name).read_bytes())
    run(sys.executable, "-m", "pip", "wheel", "--quiet", "--no-deps", "--wheel-dir", str(dist), str(source))
    (found,) = dist.glob("*.whl")
    return found


def tracked(*paths: str) -> list[str]:
    command = ["git", "ls-files", "--cached", "--others", "--exclude-standard", *paths]
    names = subprocess.run(command, cwd=ROOT, check=True, capture_output=True, text=True).stdout.splitlines()
    return [name for name in names if (ROOT / name).is_file()]


def run(*command: str) -> None:
    """Run it where nothing of this checkout is imported by chance."""
    environment = {name: value for name, value in os.environ.items() if name != "PYTHONPATH"}
    result = subprocess.run(command, env=environment, cwd="/", capture_output=True, text=True, check=False)
    assert result.returncode == 0, result.stdout + result.stderr


def test_it_has_every_file_of_the_packages(wheel: Path) -> None:
    with zipfile.ZipFile(wheel) as archive:
        packed = {name for name in archive.namelist() if name.split("/")[0] in PACKAGES}
    assert packed == set(tracked(*PACKAGES)) - FOR_AUTHORS


@pytest.fixture(scope="module")
def programs(wheel: Path) -> Iterator[Path]:
    """The `bin` of an environment with the wheel in it; some gigabytes, so it does not stay."""
    with tempfile.TemporaryDirectory() as environment:
        venv.create(environment, with_pip=True)
        found = Path(environment) / "bin"
        run(str(found / "pip"), "install", "--quiet", "--disable-pip-version-check", str(wheel))
        run(str(found / "python"), "-m", "models.planning")  # else the first plans wait for it
        yield found


def test_installed_it_serves_the_whole_path(programs: Path, tmp_path: Path) -> None:
    folder = tmp_path / "elsewhere"
    folder.mkdir()
    cqltl = str(programs / "cqltl")
    with (
        started(folder, cqltl=[cqltl], PYTHONPATH="") as process,
        httpx.Client(base_url=address(process), timeout=120) as client,
    ):
        assert client.get("/readyz").status_code == 200
        said = {"text": "Pickup the sphere", "environment": "toys-4x1-sphere"}
        for translator in ("default", "cq-copynet", "ltl-copynet"):  # each has weights of its own
            assert client.post("/translate", json={**said, "translator": translator}).json()["outcome"] == "translated"
        lesson = {"contextual_query": "hold(sphere)", "ltl": "F holding(sphere)", "environment": "toys"}
        assert client.post("/learn", json=lesson).status_code == 201
        response = client.post("/plan", json=said)
        assert response.status_code == 200, response.text  # nothing has to be compiled first
        plan = response.json()
        assert plan["outcome"] == "solved"
        step = client.post(f"{plan['policy']['url']}/step", json={"state": plan["initial"]["state"]})
        assert step.json()["action"] == plan["trajectory"][0]["action"]
    assert (folder / "cqltl.sqlite3").is_file()
