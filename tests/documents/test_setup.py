"""What the pages say of setting up is run as a reader would, in a copy of the repository on a machine that has nothing
yet but Python (`make setup-check`; some ten minutes).
"""

from __future__ import annotations

import os
import re
import shutil
import signal
import socket
import subprocess
import sys
import tempfile
import venv
from collections.abc import Iterator
from contextlib import ExitStack, contextmanager
from pathlib import Path

import httpx
import pytest

from clients.generate import NAMES
from tests.documents.blocks import ROOT, blocks
from tests.documents.unrun import SETUP, entry
from tests.service.postgres import Postgres

pytestmark = pytest.mark.long

ADDRESS = re.compile(r"http://127\.0\.0\.1:\d+")
SAID = {"text": "Pickup the sphere", "environment": "toys-4x1-sphere"}


def lines(page: str) -> list[str]:
    """The commands of the block of a page that is run here, without their comments."""
    (block,) = (block for block in blocks(page) if entry(SETUP, block))
    return [line.partition("  #")[0].strip() for line in block.text.splitlines()]


@pytest.fixture(scope="module")
def copy() -> Iterator[Path]:
    """The repository as git has it, or is about to; its environment takes gigabytes, so it does not stay."""
    command = ["git", "ls-files", "--cached", "--others", "--exclude-standard"]
    names = subprocess.run(command, cwd=ROOT, check=True, capture_output=True, text=True).stdout.splitlines()
    with tempfile.TemporaryDirectory() as folder:
        for name in filter(lambda name: (ROOT / name).is_file(), names):
            (Path(folder) / name).parent.mkdir(parents=True, exist_ok=True)
            shutil.copy(ROOT / name, Path(folder) / name)
        yield Path(folder)


def environment(programs: Path | None = None, **more: str) -> dict[str, str]:
    """Nothing of whoever runs the tests but the programs of the machine, and those of a folder first."""
    ours = re.compile("CQLTL_|OTEL_|PYTHON|VIRTUAL_ENV|MAKE|MFLAGS|NUMBA_")
    kept = {name: value for name, value in os.environ.items() if not ours.match(name)}
    here = str(Path(sys.executable).parent)
    path = [part for part in kept["PATH"].split(os.pathsep) if part != here]
    return {**kept, "PATH": os.pathsep.join([*([str(programs)] if programs else []), *path]), **more}


def run(command: str, folder: Path, variables: dict[str, str]) -> str:
    result = subprocess.run(
        ["bash", "-euo", "pipefail", "-c", command],
        cwd=folder,
        env=variables,
        capture_output=True,
        text=True,
        timeout=900,
        check=False,
    )
    assert result.returncode == 0, f"{command}: {result.stdout}{result.stderr}"
    return result.stdout


@contextmanager
def running(command: str, folder: Path, variables: dict[str, str], *, until: str) -> Iterator[str]:
    """A command that does not end; what it printed until it printed a certain word. Ctrl-C stops it."""
    with subprocess.Popen(
        ["bash", "-c", command], cwd=folder, env=variables, stdout=subprocess.PIPE, text=True, start_new_session=True
    ) as process:
        assert process.stdout is not None
        printed = ""
        try:
            for line in process.stdout:
                printed += line
                if until in line:
                    break
            assert until in printed, printed
            yield printed
        finally:
            os.killpg(process.pid, signal.SIGINT)


def free_port() -> str:
    with socket.socket() as found:
        found.bind(("127.0.0.1", 0))
        return str(found.getsockname()[1])


def plans(address: str) -> bool:
    with httpx.Client(base_url=address, timeout=120) as client:
        return bool(client.post("/plan", json=SAID).json()["outcome"] == "solved")


@pytest.mark.parametrize("page", ["README.md", "docs/tutorial.md"])
def test_it_serves_after_one_command(copy: Path, page: str) -> None:
    """The first time it sets up, with the line that it prints as the proof."""
    serve = lines(page)[0]
    assert serve == "make serve"
    variables = environment(CQLTL_PORT=free_port())
    with running(serve, copy, variables, until="/translate") as printed:
        assert '"ltl"' in run(printed[printed.index("curl ") :], copy, variables)


def test_the_wheel(copy: Path, tmp_path: Path) -> None:
    """`make wheel` in the copy; then another environment, without a checkout."""
    venv.create(tmp_path / "venv", with_pip=True)
    *prepare, serve = (line.replace("/var/lib/cqltl", str(tmp_path / "store")) for line in lines("docs/running.md"))
    variables = environment(tmp_path / "venv" / "bin", CQLTL_PORT=free_port())
    for line in prepare:
        run(line, copy, variables)
    with running(serve, tmp_path, variables, until="cqltl serves") as printed:
        assert plans(ADDRESS.findall(printed)[0])
    assert (tmp_path / "store" / "cqltl.sqlite3").is_file()


def test_the_clients(copy: Path) -> None:
    variables = environment(copy / ".venv" / "bin")
    for line in lines("docs/clients.md"):
        run(line, copy, variables)
    assert {path.name for path in (copy / "build" / "clients").iterdir()} == set(NAMES)


def test_many_machines(copy: Path, tmp_path: Path) -> None:
    """Each command is a process of its own, on a database server of the tests' own."""
    run(".venv/bin/pip install --quiet -e '.[postgres]'", copy, environment())
    postgres = Postgres()
    try:
        url = str(postgres.database())
        export, serve, *workers = lines("docs/settings.md")
        assert export.startswith("export CQLTL_DATABASE_URL=postgresql+psycopg://")
        variables = environment(copy / ".venv" / "bin", CQLTL_DATABASE_URL=url)
        with ExitStack() as processes:
            command = serve.replace("8000", free_port())
            printed = processes.enter_context(running(command, tmp_path, variables, until="cqltl serves"))
            for worker in workers:
                processes.enter_context(running(worker, tmp_path, variables, until="cqltl works on"))
            assert plans(ADDRESS.findall(printed)[0])
    finally:
        postgres.stop()
