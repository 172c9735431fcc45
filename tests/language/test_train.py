"""The training command: it writes what it says, the same for the same seed, and what it wrote can be asked."""

from __future__ import annotations

import json
from collections.abc import Iterator
from pathlib import Path

import pytest
import torch

from models.language import SpanTranslator, TrainingError, train
from models.language.copynet import CqCopyNetTranslator
from models.language.spans import training


@pytest.fixture(autouse=True)
def _one_thread() -> Iterator[None]:
    threads = torch.get_num_threads()
    yield
    torch.set_num_threads(threads)


@pytest.fixture
def _small_epochs(monkeypatch: pytest.MonkeyPatch) -> None:
    """Epochs of a hundred texts, so that a run takes seconds."""
    usual = training.Lessons.epoch
    monkeypatch.setattr(
        training.Lessons,
        "epoch",
        lambda lessons, generator, **_: usual(lessons, generator, commands=10, refusals=30),
    )


@pytest.mark.usefixtures("_small_epochs")
def test_the_default_translator(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    for folder in ("a", "b"):
        train.main(["default", "--epochs", "2", "--seed", "7", "--output", str(tmp_path / folder)])
    names = ["cq-spans-curve.json", "cq-spans.json", "cq-spans.safetensors"]
    assert sorted(path.name for path in (tmp_path / "a").iterdir()) == names
    for name in names:
        assert (tmp_path / "a" / name).read_bytes() == (tmp_path / "b" / name).read_bytes()
    record = json.loads((tmp_path / "a" / names[0]).read_text())
    assert record["training"]["seed"] == 7
    assert [epoch["epoch"] for epoch in record["epochs"]] == [1, 2]
    assert record["epochs"][1]["loss"] < record["epochs"][0]["loss"]
    assert "epoch 2" in capsys.readouterr().out
    SpanTranslator.load(tmp_path / "a").translate("Pickup the sphere")


def test_the_systems_of_the_paper(tmp_path: Path) -> None:
    train.main(["paper", "--domain", "navigation", "--epochs", "1", "--hide", "0.5", "--output", str(tmp_path)])
    names = {path.name for path in tmp_path.iterdir()}
    assert {"cq-copynet-navigation.safetensors", "ltl-copynet-navigation.safetensors"} <= names
    description = json.loads((tmp_path / "cq-copynet-navigation.json").read_text())
    assert description["training"]["hide"] == 0.5


def test_what_ships_is_what_the_settings_say() -> None:
    """Weights that were made with other settings than those of the code could not be made again."""
    made = SpanTranslator.load().model.training
    settings = training.Settings()
    assert made == {"seed": 0, **{name: getattr(settings, name) for name in settings.__dataclass_fields__}}
    for model in (*CqCopyNetTranslator.load().models,):
        usual = train.copynet.Settings()
        expected = {name: getattr(usual, name) for name in usual.__dataclass_fields__}
        assert expected.items() <= dict(model.training).items()


def test_no_epochs(tmp_path: Path) -> None:
    for what in ("default", "paper"):
        with pytest.raises(TrainingError):
            train.main([what, "--epochs", "0", "--output", str(tmp_path)])
