"""Clients generated from openapi.yaml go the whole path against a live server: one in every run, all with `make
clients`, which installs what generates them.
"""

from __future__ import annotations

import os
import shutil
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path

import pytest

from benchmarks.server import serving
from clients.generate import generate

HERE = Path(__file__).parent
OUTPUT = HERE.parents[1] / "build" / "clients"


@pytest.fixture(scope="module")
def server() -> Iterator[str]:
    with serving() as client:
        yield str(client.base_url).rstrip("/")


def run(*command: str | Path, **environment: str) -> str:
    result = subprocess.run(
        [str(part) for part in command], env={**os.environ, **environment}, capture_output=True, text=True, check=False
    )
    assert result.returncode == 0, result.stdout + result.stderr
    return result.stdout


@pytest.mark.parametrize(
    ("name", "script"),
    [
        pytest.param("python", "drive_python.py", marks=pytest.mark.long),
        ("python-httpx", "drive_python_httpx.py"),
    ],
)
def test_python(server: str, name: str, script: str) -> None:
    client = generate(name, OUTPUT)
    assert run(sys.executable, HERE / script, server, PYTHONPATH=str(client)) == "done\n"


@pytest.mark.long
def test_typescript(server: str) -> None:
    if shutil.which("npm") is None:
        pytest.skip("no npm to compile TypeScript with (Debian and Ubuntu: apt install npm)")
    client = generate("typescript", OUTPUT)
    shutil.copy(HERE / "drive.ts", client / "src")
    run("npm", "--prefix", client, "install", "--no-audit", "--no-fund", "--ignore-scripts")
    run(client / "node_modules" / ".bin" / "tsc", "--project", client, "--strict", "--skipLibCheck")
    assert run("node", client / "dist" / "drive.js", server) == "done\n"


@pytest.mark.long
def test_cpp_compiles() -> None:
    if shutil.which("cmake") is None or not Path("/usr/include/cpprest").is_dir():
        pytest.skip(
            "no CMake or no C++ REST SDK (Debian and Ubuntu: apt install cmake g++ libcpprest-dev libboost-dev)"
        )
    client = generate("cpp", OUTPUT)
    build = client / "build"
    run("cmake", "-S", client, "-B", build, "-DCMAKE_BUILD_TYPE=Debug", "-DCMAKE_CXX_STANDARD=17")
    run("cmake", "--build", build, "--parallel", str(os.cpu_count() or 1))
    assert list(build.glob("libCqltlClient.*"))
