"""A network of `models.language.spans` read out: the likeliest classes of a text, with their arguments' mentions."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from typing import Self

import torch
from torch import Tensor

from models.language.encoder import WordReader, encoder
from models.language.spans.decoding import TagScores, best_sequences, log_totals
from models.language.spans.model import SpanModel
from models.language.spans.network import TextBatch
from models.language.spans.tags import OUTSIDE, Span, begins, mentions_of

SEQUENCES = 16
"""Tag sequences read out for each task class; different ones may say the same query, and their probabilities add up."""
LEAST_TASK = 1e-3
"""Task classes less probable than this are not read out."""
LEAST = 1e-4
"""Nor tag sequences that are less probable, together with their class."""


@dataclass(frozen=True, slots=True)
class SpanReading:
    """A task class and the mentions of each of its arguments, as ranges of the words.

    `strange` are the words that are taken for names and that wordings never use.
    """

    task: str
    mentions: tuple[tuple[Span, ...], ...]
    probability: float
    strange: frozenset[int]


Read = tuple[tuple[SpanReading, ...], float]
"""The readings of a text, and the probability that no class fits."""


@dataclass(frozen=True, slots=True, eq=False)
class SpanReader:
    """Reads folded words."""

    model: SpanModel
    encoder: WordReader
    _numbers: Mapping[str, int] = field(repr=False)
    _transitions: TagScores = field(repr=False)  # [K, L, L]
    _start: TagScores = field(repr=False)  # [K, L]

    @classmethod
    def of(cls, model: SpanModel, words: WordReader | None = None) -> Self:
        """The reader of a model; without `words`, it reads words with the encoder that is installed."""
        network = model.network
        numbers = {word: number for number, word in enumerate(network.config.words, start=1)}
        transitions = network.transition.detach().double() / model.temperature + network.allowed
        return cls(model, words or encoder(), numbers, transitions.numpy(), network.allowed_start.double().numpy())

    def read(self, spoken: Sequence[str]) -> Read:
        """The readings of one text, and the probability that no class fits."""
        return self.read_all([spoken])[0]

    @torch.inference_mode()
    def read_all(self, texts: Sequence[Sequence[str]]) -> list[Read]:
        """For each text the readings in order of the classes, each class's best first, and the probability that no
        class fits.

        The probability of a reading is that of its class times that of its tag sequence.
        """
        scores = self.model.network(TextBatch.of(texts, self._numbers, self.encoder))
        tasks = (scores.tasks / self.model.temperature).softmax(dim=1).tolist()  # [B][K + 1]
        return [
            (self._readings(text, states[: len(text)], likely), likely[-1])
            for text, states, likely in zip(texts, scores.states, tasks, strict=True)
        ]

    def _readings(self, spoken: Sequence[str], states: Tensor, tasks: Sequence[float]) -> tuple[SpanReading, ...]:
        """The readings of one text. `states` is [S, H]."""
        likely = [task for task, probability in enumerate(tasks[:-1]) if probability >= LEAST_TASK]
        if not likely:
            return ()
        # The tags of arguments that no class has are forbidden: leave them out.
        used = begins(max(self.model.network.config.tasks[task][1] for task in likely))
        emissions = self.model.network.emissions(states, likely).transpose(0, 1)  # [N, S, L]
        said = emissions[:, :, :used].double().numpy() / self.model.temperature
        transitions, start = self._transitions[likely, :used, :used], self._start[likely, :used]
        totals = log_totals(said, transitions, start).tolist()
        least = [total + math.log(LEAST / tasks[task]) for task, total in zip(likely, totals, strict=True)]
        found = best_sequences(said, transitions, start, count=SEQUENCES, least=least)
        return tuple(
            SpanReading(name, mentions, tasks[task] * math.exp(min(0.0, score - total)), self._strange(spoken, tags))
            for task, total, sequences in zip(likely, totals, found, strict=True)
            for name, arity in [self.model.network.config.tasks[task]]
            for score, tags in sequences
            if all(mentions := mentions_of(tags, arity))
        )

    def _strange(self, spoken: Sequence[str], tags: Sequence[int]) -> frozenset[int]:
        """The words that are taken for names and that wordings never use."""
        named = (place for place, tag in enumerate(tags) if tag != OUTSIDE)
        return frozenset(place for place in named if spoken[place] not in self._numbers)
