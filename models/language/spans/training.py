"""Fit the default translator's network."""

from __future__ import annotations

import random
from collections.abc import Callable, Sequence
from dataclasses import asdict, dataclass

import torch

from models.language.errors import TrainingError
from models.language.spans.calibration import best_temperature
from models.language.spans.items import Item, batches, likelihood
from models.language.spans.lessons import Lessons, spoken_words
from models.language.spans.lexicon import Lexicon, lexicon
from models.language.spans.model import SpanModel
from models.language.spans.network import SpanConfig, SpanNet

Epoch = dict[str, float]
"""One line of a training curve: the epoch, its mean loss, and the loss on the texts that are only looked at."""


@dataclass(frozen=True, slots=True)
class Settings:
    """The hyper-parameters of a run."""

    epochs: int = 30
    commands: int = 400  # of each task class and epoch; T has 23 of navigate_one and 458 of navigate_three
    refusals: int = 2000  # per epoch
    batch: int = 32
    learning_rate: float = 3e-3  # Adam; falls to zero along a cosine, so that the last epochs settle
    clip: float = 2.0  # gradient norm; the recurrent layers spike early on
    hide: float = 0.05  # words that lose their embedding in a text: an unknown verb is not a catastrophe
    hide_frame: float = 0.2  # polite frames that do: "listen, lift the apple" is a command, whatever "listen" is
    lexicon: bool = True  # without it words beyond the wordings are all alike, for comparison
    embedding: int = 48
    projection: int = 64
    encoder: int = 96
    layers: int = 2
    dropout: float = 0.25


def train(settings: Settings, *, seed: int = 0, log: Callable[[Epoch], None] | None = None) -> SpanModel:
    """Fit a network to both domains.

    Nothing here looks at U or at the held-out lists. One thread is fastest. The same seed gives the same model on the
    same kind of machine. `log` is called after every epoch.

    Raises:
        TrainingError: no epoch is asked for.
    """
    if settings.epochs < 1:
        raise TrainingError("a run has at least one epoch")
    lessons, words = Lessons.load(seed=seed), lexicon() if settings.lexicon else lexicon().silent()
    generator = random.Random(seed)
    with torch.random.fork_rng(devices=[]):
        torch.manual_seed(seed)
        network = _network(lessons, words, settings)
        checks = lessons.checks(random.Random(f"checks/{seed}"))
        _fit(network, lessons, words, settings, generator, checks, log)
    return _calibrated(network.eval(), words, checks, {"seed": seed, **asdict(settings)})


def _network(lessons: Lessons, words: Lexicon, settings: Settings) -> SpanNet:
    config = SpanConfig(
        words=spoken_words(lessons),
        tasks=tuple((task, len(slots)) for task, (_, slots) in lessons.tasks.items()),
        lexical=words.size,
        embedding=settings.embedding,
        projection=settings.projection,
        encoder=settings.encoder,
        layers=settings.layers,
        dropout=settings.dropout,
    )
    return SpanNet(config)


def _fit(
    network: SpanNet,
    lessons: Lessons,
    words: Lexicon,
    settings: Settings,
    generator: random.Random,
    checks: Sequence[Item],
    log: Callable[[Epoch], None] | None,
) -> None:
    """Run the epochs. The last weights are kept: the learning rate has fallen to zero by then."""
    optimizer = torch.optim.Adam(network.parameters(), lr=settings.learning_rate)
    per_epoch = settings.commands * len(lessons.tasks) + settings.refusals
    steps = settings.epochs * -(-per_epoch // settings.batch)
    schedule = torch.optim.lr_scheduler.CosineAnnealingLR(optimizer, steps)
    for epoch in range(1, settings.epochs + 1):
        items = lessons.epoch(generator, commands=settings.commands, refusals=settings.refusals)
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
        checked = mean_loss(network, checks, words)
        if log is not None:
            log({"epoch": epoch, "loss": round(total / len(items), 5), "check_loss": round(checked, 5)})


@torch.inference_mode()
def mean_loss(network: SpanNet, items: Sequence[Item], words: Lexicon) -> float:
    """The mean negative log-probability of the items' readings."""
    network.eval()
    order = sorted(items, key=lambda item: len(item.text))
    total = 0.0
    for start in range(0, len(order), 256):
        total -= float(likelihood(network, order[start : start + 256], words).sum())
    return total / len(items)


def _calibrated(
    network: SpanNet, words: Lexicon, checks: Sequence[Item], record: dict[str, str | int | float]
) -> SpanModel:
    """The network with its temperature, from texts that it was not fitted to."""

    @torch.inference_mode()
    def likelihood_at(temperature: float) -> float:
        parts = [checks[start : start + 256] for start in range(0, len(checks), 256)]
        return sum(float(likelihood(network, part, words, temperature=temperature).sum()) for part in parts)

    return SpanModel(network, best_temperature(likelihood_at), record)
