"""Clients generated from openapi.yaml go the whole path against a live server; the one for C++ compiles."""

from __future__ import annotations

import json
import shlex
import shutil
import sys
from collections.abc import Iterator
from pathlib import Path

import pytest

from benchmarks.server import serving
from clients.generate import generate
from tests.programs import run, typescript

HERE = Path(__file__).parent
OUTPUT = HERE.parents[1] / "build" / "clients"


@pytest.fixture(scope="module")
def server() -> Iterator[str]:
    with serving() as client:
        yield str(client.base_url).rstrip("/")


@pytest.mark.parametrize(("name", "script"), [("python", "drive_python.py"), ("python-httpx", "drive_python_httpx.py")])
def test_python(server: str, name: str, script: str) -> None:
    client = generate(name, OUTPUT)
    assert run(sys.executable, HERE / script, server, PYTHONPATH=str(client)) == "done\n"


def test_typescript(server: str, tmp_path: Path) -> None:
    compiler = typescript(tmp_path)
    client = generate("typescript", OUTPUT)
    shutil.copy(HERE / "drive.ts", client / "src")
    run(compiler, "--project", client, "--strict", "--skipLibCheck")
    assert run("node", client / "dist" / "drive.js", server) == "done\n"


def test_cpp_compiles() -> None:
    if shutil.which("cmake") is None or not Path("/usr/include/cpprest").is_dir():
        pytest.skip(
            "no CMake or no C++ REST SDK (Debian and Ubuntu: apt install cmake g++ libcpprest-dev libboost-dev)"
        )
    client = generate("cpp", OUTPUT)
    build = client / "build"
    few = ("-DCMAKE_UNITY_BUILD=ON", "-DCMAKE_UNITY_BUILD_BATCH_SIZE=40")  # reading its headers takes the most time
    run("cmake", "-S", client, "-B", build, "-DCMAKE_CXX_STANDARD=17", "-DCMAKE_EXPORT_COMPILE_COMMANDS=ON", *few)
    commands = [shlex.split(entry["command"]) for entry in json.loads((build / "compile_commands.json").read_text())]
    assert len(commands) > 1
    for command in commands:  # whatever the compiler can find wrong, without the code, which takes twice the time
        run(*command, "-fsyntax-only")
