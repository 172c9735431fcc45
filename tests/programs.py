"""Programs that tests run beside Python."""

from __future__ import annotations

import os
import shutil
import subprocess
from pathlib import Path

import pytest


def run(*command: str | Path, **environment: str) -> str:
    """What a command prints that succeeds within five minutes."""
    result = subprocess.run(
        [str(part) for part in command],
        env={**os.environ, **environment},
        capture_output=True,
        text=True,
        timeout=300,
        check=False,
    )
    assert result.returncode == 0, result.stdout + result.stderr
    return result.stdout


def typescript(folder: Path) -> Path:
    """The compiler, which npm may have in its cache, or fetch into a folder; skips the test where there is none."""
    if (found := shutil.which("tsc")) is not None:
        return Path(found)
    if shutil.which("npm") is None or shutil.which("node") is None:
        pytest.skip("no tsc and no npm to get it with (Debian and Ubuntu: apt install nodejs npm)")
    command = ["npm", "--prefix", str(folder), "install", "--no-audit", "--no-fund", "--prefer-offline", "typescript@5"]
    result = subprocess.run(command, capture_output=True, text=True, timeout=120, check=False)
    if result.returncode != 0:
        pytest.skip(f"npm has no typescript: {result.stderr.strip().splitlines()[-1:]}")
    return folder / "node_modules" / ".bin" / "tsc"
