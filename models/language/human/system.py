"""The default translator's networks, fitted to lifted commands and read out as formulas."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field, replace
from functools import cache

from models.language.encoder import RememberingReader, encoder
from models.language.human.course import HumanCourse
from models.language.human.environment import Environment, Sentence
from models.language.human.lifting import Lifted, fill, with_usual_constants
from models.language.human.operands import OperandOrder
from models.language.spans.model import load_model
from models.language.spans.network import SpanNet
from models.language.spans.reader import SpanReader, SpanReading
from models.language.spans.training import Settings, train

STARTS = ("cq-spans", "composition-0")
"""Networks of the translator that serves; they were taught with this repository's own commands only."""


@dataclass(frozen=True, slots=True)
class Plan:
    """How networks are trained, the same for all data sets.

    Attributes:
        starts: the shipped networks to start from.
        drawn: commands in an epoch.
    """

    starts: tuple[str, ...] = STARTS
    settings: Settings = field(default_factory=lambda: Settings(epochs=14, batch=64, hide=0.1, hide_frame=0.0))
    drawn: int = 1500

    def sized(self, start: SpanNet) -> Settings:
        """The settings for a network of the sizes of another, which it can start from."""
        sizes = {size: getattr(start.config, size) for size in ("embedding", "projection", "encoder", "layers")}
        return replace(self.settings, **sizes)


BATCH = 64


@dataclass(frozen=True, slots=True, eq=False)
class SpanSystem:
    """Networks whose readings are averaged, over the sentence as it is and with its things renamed in order."""

    readers: Sequence[SpanReader]
    environment: Environment
    order: OperandOrder

    def formulas(self, sentences: Sequence[Sentence]) -> list[dict[str, float]]:
        """For each sentence the formulas that it may mean, with their probabilities (not normalised), best first."""
        found: list[dict[str, float]] = []
        for start in range(0, len(sentences), BATCH):
            found += self._batch(sentences[start : start + BATCH])
        return found

    def _batch(self, sentences: Sequence[Sentence]) -> list[dict[str, float]]:
        scores: list[dict[str, float]] = [defaultdict(float) for _ in sentences]
        for views in (sentences, [self.environment.in_order(sentence) for sentence in sentences]):
            for reader in self.readers:
                read = reader.read_all([view.words for view in views])
                for total, view, (readings, _) in zip(scores, views, read, strict=True):
                    for reading in readings:
                        self._add(total, view, reading)
        return [dict(sorted(total.items(), key=lambda pair: (-pair[1], pair[0]))) for total in scores]

    def _add(self, total: dict[str, float], view: Sentence, reading: SpanReading) -> None:
        """Ground a reading: what names nothing in the environment makes no sense there."""
        things = grounded(view, reading)
        if things is not None:
            total[fill(reading.task, self.order.usual(reading.task, things))] += reading.probability


def grounded(sentence: Sentence, reading: SpanReading) -> tuple[str, ...] | None:
    """The thing that each argument names, or None when one names none or several."""
    things: list[str] = []
    for spans in reading.mentions:
        named = {name.thing for begin, end in spans for name in sentence.names if name.begin < end and begin < name.end}
        if len(named) != 1:
            return None
        things += named
    return tuple(things) if len(set(things)) == len(things) else None


@cache
def word_reader() -> RememberingReader:
    """The encoder of all evaluations."""
    return RememberingReader(encoder())


@cache
def shipped(name: str) -> SpanNet:
    """A network of the translator that serves."""
    return SpanNet.of(load_model(name=name))


def fit(
    commands: Sequence[Lifted], environment: Environment, *, seed: int, plan: Plan, log: Callable[[str], None]
) -> SpanSystem:
    """Train networks on lifted commands, one from each of the shipped ones, each with a seed of its own."""
    usual = with_usual_constants(commands, environment)
    readers = []
    for number, name in enumerate(plan.starts):
        start = shipped(name)
        course = HumanCourse.of(usual, environment, seed=seed + number, known=start.config.words, drawn=plan.drawn)
        model = train(course, plan.sized(start), seed=seed + number, words=word_reader(), start=start)
        readers.append(SpanReader.of(model, word_reader()))
        log(f"network {number + 1} of {len(plan.starts)}")
    return SpanSystem(readers, environment, OperandOrder.of(usual))
