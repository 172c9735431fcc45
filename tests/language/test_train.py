"""Training: it learns, it is deterministic, and the script writes what it says."""

from __future__ import annotations

import json
import random
from collections.abc import Iterator
from pathlib import Path

import pytest
import torch

from models.language import CopyNetTranslator, TrainingError, train
from models.language.accuracy import by_task, greedy
from models.language.copynet import loss
from models.language.dataset import Domain, Example, NoTask, Split, generate, no_task, split
from models.language.items import command, to_batch, vocabulary_of
from models.language.train import Settings
from models.language.weights import build_network


@pytest.fixture(autouse=True)
def _one_thread() -> Iterator[None]:
    threads = torch.get_num_threads()
    torch.set_num_threads(1)
    yield
    torch.set_num_threads(threads)


def test_twenty_examples_are_learnt_by_heart() -> None:
    torch.manual_seed(0)
    examples = random.Random(0).sample(generate("manipulation").seen, 20)
    items = [command(example) for example in examples]
    vocabulary = vocabulary_of(items)
    network = build_network(vocabulary, embedding=24, encoder=24, decoder=32, dropout=0.0)
    source, target = to_batch(items, [()] * len(items), vocabulary)
    optimizer = torch.optim.Adam(network.parameters(), lr=0.01)
    for _ in range(120):
        value = loss(network(source, target), source, target)
        optimizer.zero_grad()
        value.backward()
        optimizer.step()
    assert greedy(network, vocabulary, items) == (pytest.approx(0.0, abs=0.05), 1.0)
    arities = {example.task: len(example.query.arguments) for example in examples}
    translator = CopyNetTranslator(network.eval(), vocabulary, arities, 0.0)
    assert all(tally.rate == 1.0 for tally in by_task(translator, examples).values())


@pytest.fixture
def _small_data(monkeypatch: pytest.MonkeyPatch) -> None:
    """A twentieth of the data, so that a whole run takes seconds."""

    def few(examples: tuple[Example, ...]) -> tuple[Example, ...]:
        return examples[::20]

    def small(domain: Domain, *, seed: int) -> Split:
        part = split(domain, seed=seed)
        return Split(few(part.training), few(part.validation))

    def smaller(domain: Domain) -> object:
        data = generate(domain)
        return type(data)(data.domain, data.seen[::50], data.unseen[::30])

    def few_texts(*, seed: int) -> NoTask:
        texts = no_task(seed=seed)
        return NoTask(texts.training[::20], texts.held_out[::10])

    monkeypatch.setattr(train, "at_least", lambda _count, group: group)
    monkeypatch.setattr(train, "no_task", few_texts)
    monkeypatch.setattr(train, "split", small)
    monkeypatch.setattr(train, "generate", smaller)


@pytest.mark.usefixtures("_small_data")
def test_script(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """Twice the same command: the same files, and a table of every task class."""
    for folder in ("a", "b"):
        train.main(["--domain", "manipulation", "--epochs", "2", "--seed", "7", "--output", str(tmp_path / folder)])
    names = ["cq-copynet-curve.json", "cq-copynet.json", "cq-copynet.safetensors"]
    assert sorted(path.name for path in (tmp_path / "a").iterdir()) == names
    for name in names:
        assert (tmp_path / "a" / name).read_bytes() == (tmp_path / "b" / name).read_bytes()
    record = json.loads((tmp_path / "a" / names[0]).read_text())
    assert record["settings"]["seed"] == 7
    assert record["domains"] == ["manipulation"]
    assert [epoch["epoch"] for epoch in record["epochs"]] == [1, 2]
    assert record["epochs"][1]["training_loss"] < record["epochs"][0]["training_loss"]
    assert {"S manipulation/ship", "U manipulation/move_to", "S manipulation", "no task, held out"} <= set(
        record["accuracy"]
    )
    assert "U manipulation/pickup_colored" in capsys.readouterr().out
    CopyNetTranslator.load(tmp_path / "a").translate("Pickup the sphere")


def test_no_epochs() -> None:
    with pytest.raises(TrainingError):
        train.train([Domain.MANIPULATION], Settings(epochs=0))
