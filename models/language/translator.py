"""Translators: English to contextual queries."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Protocol, Self

import torch
from torch import Tensor

from models.language.batch import SourceBatch
from models.language.beam import Hypothesis, beam_search
from models.language.copynet import CopyNet, State, log_probabilities
from models.language.output import is_spoken, read
from models.language.tokens import words
from models.language.vocabulary import NO_TASK, Source, Vocabulary
from models.language.weights import DEFAULT_NAME, load_model
from models.queries import ContextualQuery

BEAM_WIDTH = 5
"""Sequences that the search keeps, and so the most candidates."""
NEGATIONS = frozenset(
    [
        "never",
        "not",
        "don't",
        "dont",
        "cannot",
        "can't",
        "won't",
        "without",
        "avoid",
        "except",
        "unless",
        "nobody",
        "nothing",
    ]
)
"""Words that turn a command round. No task class of the network says such a thing, and the network, which learned from
commands alone, reads "never pick up the sphere" as it reads "pick up the sphere"; so it does not read these at all."""
MAX_OUTPUT = 48
"""Longest output sequence, in words and brackets."""


@dataclass(frozen=True, slots=True)
class Translation:
    """A reading of a text: the query, and the translator's probability for it, between 0 and 1."""

    query: ContextualQuery
    confidence: float


class Translator(Protocol):
    """What turns a text into contextual queries."""

    def translate(self, text: str, *, candidates: int = 1) -> tuple[Translation, ...]:
        """Up to `candidates` readings, best first; none when no task fits the text.

        The same text always gives the same readings. The confidences of distinct readings add up to at most 1.

        Raises:
            TextTooLongError: the text is beyond the limits of `models.language.tokens`.
        """


@dataclass(frozen=True, slots=True, eq=False)
class CopyNetTranslator:
    """CQ-CopyNet (paper, § Training Pipelines) with beam search.

    The confidence is the network's probability of the whole output sequence, not divided by its length. An output is
    dropped when it is malformed, or when an argument is no phrase of the text. There is no reading at all when the
    network's best output is that no task fits, or when the best reading is less probable than `min_confidence`.
    """

    network: CopyNet
    vocabulary: Vocabulary
    arities: Mapping[str, int]
    min_confidence: float

    @classmethod
    def load(cls, folder: Path | None = None, *, name: str = DEFAULT_NAME) -> Self:
        """The model stored in a folder under a name; without a folder, the one that is shipped.

        Raises:
            WeightsError: it is missing, damaged, or does not fit the code.
        """
        model = load_model(folder, name=name)
        return cls(model.network, model.vocabulary, model.arities, model.min_confidence)

    def translate(self, text: str, *, candidates: int = 1) -> tuple[Translation, ...]:
        """See `Translator`; at most `BEAM_WIDTH` candidates."""
        if candidates < 1:
            raise ValueError("at least one candidate must be asked for")
        spoken = words(text)
        if not spoken:
            return ()
        if not NEGATIONS.isdisjoint(spoken):
            return ()
        source = self.vocabulary.source(spoken)
        hypotheses = self.hypotheses(source)
        spelled = [self.vocabulary.spell(hypothesis.words, source.unknown) for hypothesis in hypotheses]
        if not spelled or spelled[0][0] == NO_TASK:
            return ()
        readings = [
            Translation(query, min(1.0, math.exp(hypothesis.log_probability)))
            for hypothesis, output in zip(hypotheses, spelled, strict=True)
            if (query := read(output, self.arities)) is not None and is_spoken(query, spoken)
        ]
        if not readings or readings[0].confidence < self.min_confidence:
            return ()
        return tuple(readings[:candidates])

    @torch.inference_mode()
    def hypotheses(self, source: Source) -> tuple[Hypothesis, ...]:
        """The network's best output sequences as extended numbers, well-formed or not, best first."""
        memory, state = self.network.encode(SourceBatch.of([source], self.vocabulary))

        def step(last: Tensor, state: State) -> tuple[Tensor, State]:
            repeated = memory.repeat(len(last))
            scores, state = self.network.step(last, state, repeated)  # [N, G + S]
            return log_probabilities(scores, repeated.source), state

        return beam_search(
            step,
            state,
            start=self.vocabulary.start,
            end=self.vocabulary.end,
            width=BEAM_WIDTH,
            steps=min(len(source.ids) + 2 * max(self.arities.values()) + 4, MAX_OUTPUT),
        )
