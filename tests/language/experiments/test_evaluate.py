"""The whole evaluation, with almost no training and a few commands: everything is written, and taken up again."""

from __future__ import annotations

import json
from pathlib import Path

import pytest

from models.language.evaluate import main


def test_quick(tmp_path: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch) -> None:
    options = ["--quick", "--runs", str(tmp_path / "runs"), "--output", str(tmp_path / "out")]
    main(options)
    assert sorted(path.name for path in (tmp_path / "runs").iterdir()) == [
        "default-0.json",
        "default-0.safetensors",
        "paper-manipulation-0.json.gz",
        "paper-navigation-0.json.gz",
    ]
    first = (tmp_path / "out" / "results.json").read_bytes()
    results = json.loads(first)
    assert list(results) == ["paper", "default"]
    assert results["paper"]["navigation"]["epochs"] == [1, 2]
    assert (tmp_path / "out" / "accuracy-by-task.png").exists()
    printed = capsys.readouterr().out
    assert "\nrobustness\n" in printed
    assert "CQ-LTL-CopyNet+POS" in printed

    def fail(*_: object, **__: object) -> None:
        raise AssertionError("nothing is trained a second time")

    monkeypatch.setattr("models.language.experiments.paper_runs.train", fail)
    monkeypatch.setattr("models.language.experiments.default_system.train", fail)
    main([*options, "--only", "paper"])
    assert (tmp_path / "out" / "results.json").read_bytes() == first  # the other half stays as it is


def test_report_measures_nothing(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    (tmp_path / "results.json").write_text("{}", encoding="utf-8")
    main(["--report", "--output", str(tmp_path), "--runs", str(tmp_path / "runs")])
    assert json.loads((tmp_path / "results.json").read_text(encoding="utf-8")) == {}
    assert str(tmp_path / "results.json") in capsys.readouterr().out
    assert not (tmp_path / "runs").exists()
