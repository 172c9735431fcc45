"""Whether commands that are not run would work: against the Makefile, the code, the compose files and the settings."""

from __future__ import annotations

import re
import shlex
import subprocess
import tomllib
from importlib.util import find_spec
from pathlib import Path

import yaml

from service.__main__ import _parser
from service.settings import Settings
from tests.documents.blocks import ROOT

PROJECT = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))
EXTRAS = set(PROJECT["project"]["optional-dependencies"])
SETTINGS = {f"CQLTL_{name.upper()}" for name in Settings.model_fields}
ELSEWHERE = {"CQLTL_DB_PASSWORD"}
"""Variables of compose files."""


def check(text: str) -> None:
    """Assert that a block has the syntax of bash, and that whatever its commands name is there.

    Raises:
        AssertionError: something is not there, or a command is none that this knows.
    """
    syntax = subprocess.run(["bash", "-n"], input=text, capture_output=True, text=True, check=False)
    assert syntax.returncode == 0, syntax.stderr
    for line in re.sub(r"\\\n\s*", "", text).splitlines():
        for part in line.split("&&"):
            words = shlex.split(part, comments=True)
            if words:
                _command(words)


def _command(words: list[str]) -> None:
    while words and re.match(r"^[A-Z_]+=", words[0]):
        _variable(words.pop(0))
    match words:
        case [] | ["cd", _]:
            pass
        case ["export", assignment]:
            _variable(assignment)
        case ["make", *targets]:
            result = subprocess.run(["make", "--dry-run", *targets], cwd=ROOT, capture_output=True, check=False)
            assert result.returncode == 0, result.stderr
        case ["python", "-m", module, *options]:
            found = find_spec(module)
            assert found is not None, module
            assert found.origin is not None
            code = Path(found.origin)
            if code.name == "__init__.py":
                code = code.with_name("__main__.py")
            for option in options:
                known = not option.startswith("-") or option == "--help"
                assert known or f'"{option}"' in code.read_text(encoding="utf-8"), option
        case ["pip", "install", *what]:
            named = re.findall(r"\[([a-z,]+)\]", " ".join(what))
            assert {extra for extras in named for extra in extras.split(",")} <= EXTRAS
        case ["cqltl", *arguments]:
            _parser().parse_args(arguments)
        case ["docker", "compose", "--file", file, *options]:
            services = yaml.safe_load((ROOT / file).read_text(encoding="utf-8"))["services"]
            scaled = [option.partition("=")[0] for option in options if re.match(r"^[a-z]+=\d+$", option)]
            inside = options[1:2] if options[0] == "exec" else []
            assert {*scaled, *inside} <= set(services)
        case _:
            raise AssertionError(f"nothing knows how to check {' '.join(words)}")


def _variable(assignment: str) -> None:
    name = assignment.partition("=")[0]
    assert name in SETTINGS | ELSEWHERE or not name.startswith("CQLTL_"), f"{name} is no setting"
