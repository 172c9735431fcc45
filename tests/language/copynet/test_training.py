"""Joint training: it learns, it is deterministic, and writes what a translator loads."""

from __future__ import annotations

import json
import math
from dataclasses import asdict, replace
from pathlib import Path

import pytest
import torch

from models.language import TrainingError
from models.language.copynet import (
    Models,
    Settings,
    System,
    answers,
    load_model,
    outputs,
    train,
    train_paper,
    training,
)
from models.language.copynet.training import save
from models.language.dataset import Domain, Split, split

FILES = {
    "cq-copynet-navigation.json",
    "cq-copynet-navigation.safetensors",
    "ltl-copynet-navigation.json",
    "ltl-copynet-navigation.safetensors",
    "copynet-navigation-curve.json",
}


def _few(small: Models, **changes: int | float | bool) -> Settings:
    return replace(small.record.settings, epochs=2, **changes)  # type: ignore[arg-type]


def _contents(folder: Path) -> dict[str, bytes]:
    return {path.name: path.read_bytes() for path in folder.iterdir()}


def test_end_to_end(small: Models, small_data: Split, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """What is trained, written and loaded answers as what was trained."""
    monkeypatch.setattr(training, "split", lambda _domain, **_options: small_data)
    lines: list[str] = []
    settings = _few(small)
    (models,) = train_paper([Domain.NAVIGATION], settings, seed=3, folder=tmp_path / "new", log=lines.append)
    assert {path.name for path in (tmp_path / "new").iterdir()} == FILES
    texts = [example.text for example in small_data.training]
    for system, model in ((System.CQ, models.cq), (System.LTL, models.ltl)):
        loaded = load_model(system, Domain.NAVIGATION, tmp_path / "new")
        assert outputs(loaded, texts) == outputs(model, texts)
        assert loaded.training == {"seed": 3, **asdict(settings)}
    assert [line.split()[:3] for line in lines] == [["navigation", "epoch", "1"], ["navigation", "epoch", "2"]]
    curve = json.loads((tmp_path / "new" / "copynet-navigation-curve.json").read_text())
    assert (curve["domain"], curve["seed"], curve["settings"]) == ("navigation", 3, asdict(settings))
    assert [epoch["number"] for epoch in curve["epochs"]] == [1, 2]


def test_same_seed_same_files(small: Models, small_data: Split, tmp_path: Path) -> None:
    """Whatever random numbers the caller draws, and those are not touched."""
    settings = _few(small, dropout=0.2)
    for name, seed in (("a", 7), ("b", 7), ("c", 8)):
        before = torch.get_rng_state()
        save(train("navigation", settings, seed=seed, data=small_data), tmp_path / name)
        assert torch.equal(torch.get_rng_state(), before)
        torch.rand(5)
    a, b, c = (_contents(tmp_path / name) for name in "abc")
    assert a == b
    assert all(a[name] != c[name] for name in FILES)


def test_it_learns(small: Models) -> None:
    """Both losses fall to a tenth, on what was held back too."""
    first, *_, last = small.record.epochs
    assert last.cq_training < first.cq_training / 10
    assert last.ltl_training < first.ltl_training / 10
    assert last.cq_validation < first.cq_validation / 10
    assert last.ltl_validation < first.ltl_validation / 10


def test_callback(small: Models, small_data: Split) -> None:
    """Called after every epoch with the networks as they are then."""
    seen: list[tuple[int, int, bool]] = []
    weights: list[torch.Tensor] = []

    def look(epoch: int, models: Models) -> None:
        seen.append((epoch, len(models.record.epochs), models.cq.network.training or models.ltl.network.training))
        weights.append(models.ltl.network.generate.weight.detach().clone())
        answers(models.cq, ["Go to the bank"])

    watched = train("navigation", _few(small), seed=0, data=small_data, on_epoch=look)
    assert seen == [(1, 1, False), (2, 2, False)]
    assert not torch.equal(*weights)
    unwatched = train("navigation", _few(small), seed=0, data=small_data)
    assert torch.equal(unwatched.ltl.network.generate.weight, weights[1])
    assert unwatched.record == watched.record


def test_names_are_generated_only_when_asked(small: Models, small_data: Split) -> None:
    free = train("navigation", _few(small, generate=True), seed=0, data=small_data)
    names = {word for example in small_data.training for phrase in example.query.arguments for word in phrase.split()}
    for system in ("cq", "ltl"):
        copying, generating = (getattr(models, system).vocabulary for models in (small, free))
        assert names.isdisjoint(copying.words[: copying.outputs])
        assert names <= set(generating.words[: generating.outputs])
        assert set(copying.words) == set(generating.words)


def test_what_only_validation_says() -> None:
    """A proposition that stands in no command of training has a loss all the same."""
    part = split("manipulation")
    held = next(example for example in part.validation if example.task == "pickup")
    data = Split(tuple(e for e in part.training if e.query.arguments[0] != held.query.arguments[0])[:20], (held,))
    settings = Settings(epochs=1, embedding=4, encoder=4, decoder=4)
    (epoch,) = train("manipulation", settings, seed=0, data=data).record.epochs
    assert math.isfinite(epoch.ltl_validation)


def test_the_default_data_is_the_training_split(monkeypatch: pytest.MonkeyPatch, small_data: Split) -> None:
    asked: list[tuple[Domain, int]] = []

    def small_split(domain: Domain, *, seed: int) -> Split:
        asked.append((domain, seed))
        return Split(small_data.training[:4], small_data.validation[:2])

    monkeypatch.setattr(training, "split", small_split)
    train("navigation", Settings(epochs=1, embedding=4, encoder=4, decoder=4), seed=5)
    assert asked == [(Domain.NAVIGATION, 5)]


def test_no_epochs() -> None:
    with pytest.raises(TrainingError):
        train("manipulation", Settings(epochs=0), seed=0)
