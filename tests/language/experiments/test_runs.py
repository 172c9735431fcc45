"""Runs on disk."""

from __future__ import annotations

from pathlib import Path

from models.language.experiments.runs import Runs


def test_what_is_written_is_read(tmp_path: Path) -> None:
    runs = Runs(tmp_path / "not" / "there")
    assert runs.read("one", {"epochs": 2}) is None
    runs.write("one", {"epochs": 2, "measured": (1, 2)}, {"answers": ["ä", None]})
    assert runs.read("one", {"epochs": 2, "measured": (1, 2)}) == {"answers": ["ä", None]}
    assert runs.read("two", {"epochs": 2, "measured": (1, 2)}) is None


def test_a_run_of_other_settings_does_not_count(tmp_path: Path) -> None:
    runs = Runs(tmp_path)
    runs.write("one", {"epochs": 2}, {"answers": 1})
    assert runs.read("one", {"epochs": 3}) is None
    runs.write("one", {"epochs": 3}, {"answers": 2})
    assert runs.read("one", {"epochs": 3}) == {"answers": 2}
    assert runs.read("one", {"epochs": 2}) is None


def test_the_same_run_gives_the_same_bytes(tmp_path: Path) -> None:
    for name in ("one", "two"):
        Runs(tmp_path / name).write("run", {"seed": 0}, {"answers": list(range(100))})
    first, second = (tmp_path / name / "run.json.gz" for name in ("one", "two"))
    assert first.read_bytes() == second.read_bytes()
    assert [place.name for place in (tmp_path / "one").iterdir()] == ["run.json.gz"]
