"""The training command: it writes what it says, the same for the same seed, and what it wrote can be asked."""

from __future__ import annotations

import json
from collections.abc import Iterator
from pathlib import Path

import pytest
import torch

from models.language import TrainingError, train
from models.language.composition import NAMES
from models.language.composition.lessons import SETTINGS
from models.language.copynet import CqCopyNetTranslator
from models.language.spans import DEFAULT_NAME, load_model, training


@pytest.fixture(autouse=True)
def _one_thread() -> Iterator[None]:
    threads = torch.get_num_threads()
    yield
    torch.set_num_threads(threads)


@pytest.mark.parametrize(("what", "name"), [("default", DEFAULT_NAME), ("composition --member 1", NAMES[1])])
def test_the_default_translator(what: str, name: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    train.main([*what.split(), "--epochs", "2", "--seed", "7", "--share", "0.01", "--output", str(tmp_path)])
    names = [f"{name}-curve.json", f"{name}.json", f"{name}.safetensors"]
    assert sorted(path.name for path in tmp_path.iterdir()) == names
    record = json.loads((tmp_path / names[0]).read_text())
    assert record["training"]["seed"] == (8 if "1" in what else 7)  # each member of an ensemble has a seed of its own
    assert [epoch["epoch"] for epoch in record["epochs"]] == [1, 2]
    assert record["epochs"][1]["loss"] < record["epochs"][0]["loss"]
    assert "epoch 2" in capsys.readouterr().out
    load_model(tmp_path, name=name)


def test_what_ships_is_what_the_settings_say() -> None:
    """Weights that were made with other settings than those of the code could not be made again."""
    composition = [(name, SETTINGS, seed) for seed, name in enumerate(NAMES)]
    for name, settings, seed in ((DEFAULT_NAME, training.Settings(), 0), *composition):
        expected = {"seed": seed, **{field: getattr(settings, field) for field in settings.__dataclass_fields__}}
        assert load_model(name=name).training == expected
    for model in (*CqCopyNetTranslator.load().models,):
        usual = train.copynet.Settings()
        expected = {name: getattr(usual, name) for name in usual.__dataclass_fields__}
        assert expected.items() <= dict(model.training).items()


def test_networks_are_trained_side_by_side(tmp_path: Path) -> None:
    """In processes of their own, with what one after the other would give."""
    given = ["paper", "--domain", "navigation", "--epochs", "1", "--hide", "0.5", "--output"]
    train.main([*given, str(tmp_path / "both"), "--jobs", "2"])
    train.main([*given, str(tmp_path / "one"), "--jobs", "1"])
    both, one = ({path.name: path.read_bytes() for path in (tmp_path / name).iterdir()} for name in ("both", "one"))
    assert {f"{name}-navigation.safetensors" for name in ("cq-copynet", "ltl-copynet")} <= set(both)
    assert one == both
    description = json.loads(both["cq-copynet-navigation.json"])
    assert description["training"]["hide"] == 0.5


def test_no_epochs(tmp_path: Path) -> None:
    with pytest.raises(TrainingError):
        train.main(["paper", "--epochs", "0", "--jobs", "1", "--output", str(tmp_path)])
