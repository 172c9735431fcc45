"""Where the default translator comes from: what ships, a kept run, or a training."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import asdict, dataclass, field, replace
from pathlib import Path

import pytest

from models.language.errors import WeightsError
from models.language.experiments import default_system
from models.language.experiments.default_system import trained_system
from models.language.spans import DEFAULT_NAME
from models.language.spans.training import Settings

SETTINGS = Settings(epochs=2)
RUNS = Path("runs")


@dataclass(frozen=True, slots=True)
class _Model:
    """A model that knows how it was made, and nothing else."""

    training: dict[str, object]


@dataclass(slots=True)
class _Shelf:
    """Models by folder (None for those that are shipped) and name, and the seeds that were trained."""

    models: dict[tuple[Path | None, str], _Model] = field(default_factory=dict)
    trained: list[int] = field(default_factory=list)

    def load(self, folder: Path | None, *, name: str) -> _Model:
        if (folder, name) not in self.models:
            raise WeightsError("it is not there")
        return self.models[folder, name]

    def save(self, model: _Model, folder: Path, *, name: str) -> None:
        self.models[folder, name] = model

    def train(self, course: object, settings: Settings, *, seed: int, log: Callable[[object], None]) -> _Model:
        self.trained.append(seed)
        for _ in range(settings.epochs):
            log({})
        return _model(seed, settings)


def _model(seed: int, settings: Settings) -> _Model:
    return _Model({"seed": seed, **asdict(settings)})


@pytest.fixture
def shelf(monkeypatch: pytest.MonkeyPatch) -> _Shelf:
    shelf = _Shelf()
    monkeypatch.setattr(default_system, "load_model", shelf.load)
    monkeypatch.setattr(default_system, "save_model", shelf.save)
    monkeypatch.setattr(default_system, "train", shelf.train)
    monkeypatch.setattr(default_system.Lessons, "load", lambda *, seed: seed)
    monkeypatch.setattr(default_system.SpanTranslator, "of", lambda model: model)
    return shelf


def _made_with(seed: int, settings: Settings) -> tuple[object, object]:
    model = trained_system(seed, settings, RUNS, lambda _: None).translator.single
    assert isinstance(model, _Model)
    return model.training["seed"], model.training["epochs"]


def test_a_run_is_trained_once(shelf: _Shelf) -> None:
    done: list[str] = []
    for _ in range(2):
        trained_system(7, SETTINGS, RUNS, done.append)
    assert shelf.trained == [7]
    assert done == ["train default-7"] * 2 + ["read default-7"] * 2
    assert list(shelf.models) == [(RUNS, "default-7")]


def test_a_run_of_other_settings_is_trained_again(shelf: _Shelf) -> None:
    shelf.models[RUNS, "default-7"] = _model(7, SETTINGS)
    assert _made_with(7, replace(SETTINGS, epochs=3)) == (7, 3)
    assert shelf.trained == [7]


def test_what_ships_is_taken_if_it_was_made_so(shelf: _Shelf) -> None:
    shelf.models[None, DEFAULT_NAME] = _model(0, SETTINGS)
    assert _made_with(0, SETTINGS) == (0, 2)
    assert shelf.trained == []
    assert _made_with(1, SETTINGS) == (1, 2)
    assert _made_with(0, replace(SETTINGS, epochs=1)) == (0, 1)
    assert shelf.trained == [1, 0]
