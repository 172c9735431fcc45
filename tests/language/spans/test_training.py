"""A small model from the beginning to the end: fitted, calibrated, stored, read again, asked."""

from __future__ import annotations

import json
import random
from collections.abc import Sequence
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np
import pytest
import torch

from models.language import SpanTranslator, TrainingError
from models.language.dataset import Domain, generate
from models.language.encoder import RememberingReader, encoder
from models.language.errors import WeightsError
from models.language.spans import SpanModel, load_model, save_model
from models.language.spans.items import Item
from models.language.spans.lessons import Lessons
from models.language.spans.training import Epoch, Settings, train

SMALL = Settings(epochs=8, batch=16, embedding=24, projection=24, encoder=32, layers=1)


@dataclass(frozen=True, slots=True)
class _Few:
    """A course with few of the texts of another, which are drawn once."""

    tasks: tuple[tuple[str, int], ...]
    words: tuple[str, ...]
    drawn: Sequence[Item]
    checked: Sequence[Item]
    size: int

    def epoch(self, generator: random.Random) -> list[Item]:
        return generator.sample(self.drawn, self.size)

    def checks(self, generator: random.Random) -> list[Item]:
        return generator.sample(self.checked, self.size // 4)


@pytest.fixture(scope="module")
def course() -> _Few:
    lessons = Lessons.load(seed=3)
    generator = random.Random(3)
    drawn = generator.sample(lessons.epoch(generator), 1_000)
    return _Few(lessons.tasks, lessons.words, drawn, lessons.checks(generator), 1_000)


@pytest.fixture(scope="module")
def brief(course: _Few) -> _Few:
    return replace(course, size=40)


@pytest.fixture(scope="module")
def trained(course: _Few) -> tuple[SpanModel, list[Epoch]]:
    curve: list[Epoch] = []
    words = RememberingReader(encoder(), together=True)
    return train(course, SMALL, seed=3, log=curve.append, words=words), curve


def test_it_learns(trained: tuple[SpanModel, list[Epoch]]) -> None:
    model, curve = trained
    assert [epoch["epoch"] for epoch in curve] == list(range(1, 9))
    assert curve[-1]["loss"] < curve[0]["loss"] / 2
    translator = SpanTranslator.of(model)
    unseen = [example for domain in Domain for example in generate(domain).unseen[::20]]
    right = [bool(found) and found[0].query == e.query for e in unseen for found in [translator.translate(e.text)]]
    assert sum(right) >= 0.25 * len(right)  # guessing the task alone is right in one of eight


def test_the_same_seed_gives_the_same_model_and_another_another(brief: _Few) -> None:
    one, two, other = (train(brief, replace(SMALL, epochs=1), seed=seed).tensors for seed in (5, 5, 6))
    assert all(np.array_equal(one[key], two[key]) for key in one)
    assert not np.array_equal(one["task.weight"], other["task.weight"])


def test_training_leaves_the_callers_generator_alone(brief: _Few) -> None:
    torch.manual_seed(11)
    expected = torch.rand(1)
    torch.manual_seed(11)
    train(brief, replace(SMALL, epochs=1), seed=0)
    assert torch.equal(torch.rand(1), expected)


def test_a_stored_model_says_the_same(trained: tuple[SpanModel, list[Epoch]], tmp_path: Path) -> None:
    model, _ = trained
    save_model(model, tmp_path, name="small")
    again = load_model(tmp_path, name="small")
    assert again.training == {"seed": 3, **{f: getattr(SMALL, f) for f in SMALL.__dataclass_fields__}}
    for example in generate(Domain.MANIPULATION).unseen[::200]:
        text = example.text
        assert SpanTranslator.of(again).translate(text) == SpanTranslator.of(model).translate(text)
    before = {path.name: path.read_bytes() for path in tmp_path.iterdir()}
    save_model(again, tmp_path, name="small")
    assert {path.name: path.read_bytes() for path in tmp_path.iterdir()} == before


def test_damaged_files_are_refused(trained: tuple[SpanModel, list[Epoch]], tmp_path: Path) -> None:
    model, _ = trained
    with pytest.raises(WeightsError, match="cannot be read"):
        load_model(tmp_path)
    save_model(model, tmp_path)
    tensors, description = tmp_path / "cq-spans.safetensors", tmp_path / "cq-spans.json"
    whole, data = tensors.read_bytes(), json.loads(description.read_text())
    tensors.write_bytes(whole[:-100])
    with pytest.raises(WeightsError, match="damaged"):
        load_model(tmp_path)
    tensors.write_bytes(whole)
    for broken in ({**data, "temperature": 0}, {**data, "network": {**data["network"], "tasks": []}}, {"more": 1}):
        description.write_text(json.dumps(broken))
        with pytest.raises(WeightsError, match="description of a model"):
            load_model(tmp_path)
    for change in ({"encoder": 33}, {"tasks": [["pickup", 4]]}, {"words": ["the", "the"]}):
        description.write_text(json.dumps({**data, "network": {**data["network"], **change}}))
        with pytest.raises(WeightsError, match="fit together"):
            load_model(tmp_path)


def test_a_run_needs_an_epoch(brief: _Few) -> None:
    with pytest.raises(TrainingError):
        train(brief, replace(SMALL, epochs=0))


def test_a_share_of_the_texts(brief: _Few) -> None:
    """Fewer texts are other texts, so the networks differ."""
    settings = replace(SMALL, epochs=1)
    whole, part = (train(brief, replace(settings, share=share)).tensors for share in (1.0, 0.5))
    assert not np.array_equal(whole["task.weight"], part["task.weight"])
