"""Commands of the pages that set something up, run as a reader would run them, in a copy of the repository on a machine
that has nothing yet but Python.
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
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

import httpx

from tests.documents.blocks import ROOT

SAID = {"text": "Pickup the sphere", "environment": "toys-4x1-sphere"}


@contextmanager
def copied() -> Iterator[Path]:
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


def run(command: str, folder: Path, variables: dict[str, str], *, most_s: float = 900) -> str:
    result = subprocess.run(
        ["bash", "-euo", "pipefail", "-c", command],
        cwd=folder,
        env=variables,
        capture_output=True,
        text=True,
        timeout=most_s,
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
    """A port of this machine that nothing listens on."""
    with socket.socket() as found:
        found.bind(("127.0.0.1", 0))
        return str(found.getsockname()[1])


def plans(address: str) -> bool:
    """Whether a service does the main job."""
    with httpx.Client(base_url=address, timeout=120) as client:
        return bool(client.post("/plan", json=SAID).json()["outcome"] == "solved")
