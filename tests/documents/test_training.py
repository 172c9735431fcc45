"""What the pages say of training and measuring networks is run, word for word, in a new copy of the repository
(`make training-check`; a quarter of an hour). Only `--quick` is added, for one epoch instead of many and a few commands
instead of all: what is made and measured has no meaning; that there is something, and where, does.
"""

from __future__ import annotations

import json
from pathlib import Path

import pytest

from tests.documents.apart import TRAINING, lines
from tests.documents.machine import environment, run
from tests.documents.published import write_published

pytestmark = pytest.mark.long

RESULTS = "build/experiments-quick/results/results.json"
HUMAN = "build/human-quick.json"


@pytest.fixture(scope="module")
def programs(copy: Path) -> Path:
    """The programs of a new environment, with a python that adds `--quick`; the published files are in `folder`."""
    (copy / "folder").mkdir()
    write_published(copy / "folder")
    run("make .venv/.dev", copy, environment())
    folder, made = copy / "programs", copy / ".venv" / "bin"
    folder.mkdir()
    (folder / "pip").symlink_to(made / "pip")
    (folder / "python").write_text(f'#!/bin/sh\nexec {made}/python "$@" --quick\n', encoding="utf-8")
    (folder / "python").chmod(0o755)
    return folder


def run_block(copy: Path, programs: Path, page: str, start: str) -> None:
    """All commands of a block; each of them prints something."""
    (commands,) = (found for found in lines(TRAINING, page) if found[0].startswith(start))
    for command in commands:
        printed = run(command, copy, environment(programs, OPTIONS="--quick"), most_s=3600)
        assert printed.strip() or command.startswith("pip"), command


def measured(copy: Path, file: str) -> set[str]:
    return set(json.loads((copy / file).read_text(encoding="utf-8")))


def test_the_evaluation(copy: Path, programs: Path) -> None:
    shown = (copy / "docs/experiments/results.json").read_bytes()
    run_block(copy, programs, "docs/experiments.md", "pip install")
    assert measured(copy, RESULTS) == {"paper", "default"}
    assert (copy / "docs/experiments/results.json").read_bytes() == shown, "a quick run is no result"


def test_commands_that_people_wrote(copy: Path, programs: Path) -> None:
    run_block(copy, programs, "docs/experiments.md", "make evaluate-human")
    assert measured(copy, HUMAN) == {"drone", "cleanup", "pick", "lang2ltl", "record"}


def test_everything_that_ships(copy: Path, programs: Path) -> None:
    """Trained anew, and measured as what is installed then."""
    weights = sorted((copy / "models/language/weights").glob("*.safetensors"))
    before = {path: path.read_bytes() for path in weights}
    for file in (RESULTS, HUMAN):
        (copy / file).unlink(missing_ok=True)
    run_block(copy, programs, "docs/language.md", "make train")
    assert [path.name for path in weights if path.read_bytes() == before[path]] == []
    assert (copy / RESULTS).is_file()
    assert (copy / HUMAN).is_file()
