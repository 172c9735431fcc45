"""Fit the default translator's network."""

from __future__ import annotations

import random
from collections.abc import Callable, Sequence
from dataclasses import asdict, dataclass
from typing import Protocol

import torch

from models.language.encoder import RememberingReader, WordReader, encoder
from models.language.errors import TrainingError
from models.language.spans.calibration import best_temperature
from models.language.spans.config import SpanConfig
from models.language.spans.items import Item, batches, likelihood, likelihoods
from models.language.spans.model import SpanModel
from models.language.spans.network import SpanNet

Epoch = dict[str, float]
"""One line of a training curve: the epoch, its mean loss, and the loss on the texts that are only looked at."""


@dataclass(frozen=True, slots=True)
class Settings:
    """The hyper-parameters of a run."""

    epochs: int = 24
    share: float = 1.0  # of the texts of an epoch that are read; less only to see that everything works
    batch: int = 32
    learning_rate: float = 3e-3  # Adam; falls to zero along a cosine, so that the last epochs settle
    clip: float = 2.0  # gradient norm; the recurrent layers spike early on
    hide: float = 0.05  # words that lose their embedding in a text: an unknown verb is not a catastrophe
    hide_frame: float = 0.2  # polite frames that do: "listen, lift the apple" is a command, whatever "listen" is
    embedding: int = 48
    projection: int = 96
    encoder: int = 96
    layers: int = 2
    dropout: float = 0.25


class Course(Protocol):
    """What a network is taught."""

    @property
    def tasks(self) -> tuple[tuple[str, int], ...]:
        """The task classes with their numbers of arguments."""

    @property
    def words(self) -> tuple[str, ...]:
        """The words that get embeddings of their own, sorted."""

    def epoch(self, generator: random.Random) -> list[Item]:
        """Texts for one pass."""

    def checks(self, generator: random.Random) -> list[Item]:
        """Texts that are only looked at."""


def train(
    course: Course,
    settings: Settings,
    *,
    seed: int = 0,
    log: Callable[[Epoch], None] | None = None,
    words: WordReader | None = None,
    start: SpanNet | None = None,
    device: str = "cpu",
) -> SpanModel:
    """Fit a network to what a course teaches.

    One thread is fastest. The same seed gives the same model on the same kind of machine. `log` is called after every
    epoch. Without `words`, words are read with the encoder that is installed. With `start`, a network of the same
    sizes, reading is not learned from nothing: see `SpanNet.reading_like`. It is fitted on `device`, and comes back.

    Raises:
        TrainingError: no epoch is asked for.
    """
    if settings.epochs < 1:
        raise TrainingError("a run has at least one epoch")
    words = words or encoder()
    generator = random.Random(seed)
    with torch.random.fork_rng(devices=[]):
        torch.manual_seed(seed)
        network = _network(course, words, settings)
        if start is not None:
            network.reading_like(start)
        network.to(device)
        checks = _part(course.checks(random.Random(f"checks/{seed}")), settings, generator)
        _fit(network, course, words, settings, generator, checks, log)
    return _calibrated(network.cpu().eval(), words, checks, {"seed": seed, **asdict(settings)})


def _network(course: Course, words: WordReader, settings: Settings) -> SpanNet:
    config = SpanConfig(
        words=course.words,
        tasks=course.tasks,
        vector=words.size,
        embedding=settings.embedding,
        projection=settings.projection,
        encoder=settings.encoder,
        layers=settings.layers,
        dropout=settings.dropout,
    )
    return SpanNet(config)


def _fit(
    network: SpanNet,
    course: Course,
    words: WordReader,
    settings: Settings,
    generator: random.Random,
    checks: Sequence[Item],
    log: Callable[[Epoch], None] | None,
) -> None:
    """Run the epochs. The last weights are kept: the learning rate has fallen to zero by then."""
    optimizer = torch.optim.Adam(network.parameters(), lr=settings.learning_rate)
    schedule: torch.optim.lr_scheduler.CosineAnnealingLR | None = None
    of_checks = RememberingReader(words, together=True)  # the same in every epoch
    for epoch in range(1, settings.epochs + 1):
        items = _part(course.epoch(generator), settings, generator)
        if schedule is None:
            steps = settings.epochs * -(-len(items) // settings.batch)
            schedule = torch.optim.lr_scheduler.CosineAnnealingLR(optimizer, steps)
        network.train()
        total = 0.0
        for chunk in batches(items, settings.batch, generator):
            hidden = [item.hidden(settings.hide, settings.hide_frame, generator) for item in chunk]
            loss = -likelihood(network, chunk, words, hidden=hidden).mean()
            optimizer.zero_grad()
            loss.backward()  # type: ignore[no-untyped-call]
            torch.nn.utils.clip_grad_norm_(network.parameters(), settings.clip)
            optimizer.step()
            schedule.step()
            total += loss.item() * len(chunk)
        checked = mean_loss(network, checks, of_checks)
        if log is not None:
            log({"epoch": epoch, "loss": round(total / len(items), 5), "check_loss": round(checked, 5)})


def _part(items: list[Item], settings: Settings, generator: random.Random) -> list[Item]:
    """The share of the items that is read."""
    return items if settings.share >= 1 else generator.sample(items, max(1, round(settings.share * len(items))))


@torch.inference_mode()
def mean_loss(network: SpanNet, items: Sequence[Item], words: WordReader) -> float:
    """The mean negative log-probability of the items' readings."""
    network.eval()
    order = sorted(items, key=lambda item: len(item.text))
    total = 0.0
    for start in range(0, len(order), 256):
        total -= float(likelihood(network, order[start : start + 256], words).sum())
    return total / len(items)


def _calibrated(
    network: SpanNet, words: WordReader, checks: Sequence[Item], record: dict[str, str | int | float]
) -> SpanModel:
    """The network with its temperature, from texts that it was not fitted to."""

    with torch.inference_mode():
        parts = [likelihoods(network, checks[at : at + 256], words) for at in range(0, len(checks), 256)]
        temperature = best_temperature(lambda t: sum(float(part(t).sum()) for part in parts))
    return SpanModel(network.config, network.tensors(), temperature, record)
