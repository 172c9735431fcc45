"""A network of `models.language.spans` read out: the likeliest classes of a text, with their arguments' mentions."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, field
from typing import Self

import numpy as np

from models.language.encoder import WordReader, encoder
from models.language.runtime import Floats
from models.language.spans.decoding import TagScores, best_sequences, log_totals
from models.language.spans.model import SpanModel
from models.language.spans.scorer import SpanScorer
from models.language.spans.tags import OUTSIDE, Span, begins, forbidden_moves, mentions_of

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

    scorer: SpanScorer
    _transitions: TagScores = field(repr=False)  # [K, L, L]
    _start: TagScores = field(repr=False)  # [K, L]

    @classmethod
    def of(cls, model: SpanModel, words: WordReader | None = None) -> Self:
        """The reader of a model; without `words`, it reads words with the encoder that is installed."""
        rules = [forbidden_moves(arity, model.config.tags) for _, arity in model.config.tasks]
        allowed, start = (np.array(part) for part in zip(*rules, strict=True))
        transitions = model.tensors["transition"].astype(np.float64) / model.temperature + allowed
        return cls(SpanScorer.of(model, words or encoder()), transitions, start)

    @property
    def model(self) -> SpanModel:
        """What it reads with."""
        return self.scorer.model

    def read(self, spoken: Sequence[str]) -> Read:
        """The readings of one text, and the probability that no class fits."""
        return self.read_all([spoken])[0]

    def read_all(self, texts: Sequence[Sequence[str]]) -> list[Read]:
        """For each text the readings in order of the classes, each class's best first, and the probability that no
        class fits.

        The probability of a reading is that of its class times that of its tag sequence.
        """
        scores, states = self.scorer.scores(texts)
        points = scores.astype(np.float64) / self.model.temperature  # [B, K + 1]
        tasks = np.exp(points - np.logaddexp.reduce(points, axis=1, keepdims=True)).tolist()
        return [
            (self._readings(text, states[row, : len(text)], likely), likely[-1])
            for row, (text, likely) in enumerate(zip(texts, tasks, strict=True))
        ]

    def _readings(self, spoken: Sequence[str], states: Floats, tasks: Sequence[float]) -> tuple[SpanReading, ...]:
        """The readings of one text. `states` is [S, H]."""
        likely = [task for task, probability in enumerate(tasks[:-1]) if probability >= LEAST_TASK]
        if not likely:
            return ()
        # The tags of arguments that no class has are forbidden: leave them out.
        classes = [self.model.config.tasks[task] for task in likely]
        used = begins(max(arity for _, arity in classes))
        said = self.scorer.emissions(states, likely, used) / self.model.temperature  # [N, S, L]
        transitions, start = self._transitions[likely, :used, :used], self._start[likely, :used]
        totals = log_totals(said, transitions, start).tolist()
        least = [total + math.log(LEAST / tasks[task]) for task, total in zip(likely, totals, strict=True)]
        found = best_sequences(said, transitions, start, count=SEQUENCES, least=least)
        return tuple(
            SpanReading(name, mentions, tasks[task] * math.exp(min(0.0, score - total)), self._strange(spoken, tags))
            for task, (name, arity), total, sequences in zip(likely, classes, totals, found, strict=True)
            for score, tags in sequences
            if all(mentions := mentions_of(tags, arity))
        )

    def _strange(self, spoken: Sequence[str], tags: Sequence[int]) -> frozenset[int]:
        """The words that are taken for names and that wordings never use."""
        named = (place for place, tag in enumerate(tags) if tag != OUTSIDE)
        return frozenset(place for place in named if spoken[place] not in self.scorer.numbers)
