"""The default translator: task classification and mention tagging, read out as ranked contextual queries."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Self

import torch

from models.language.spans.decoding import TagScores, best_sequences, log_total
from models.language.spans.lexicon import Lexicon, lexicon
from models.language.spans.model import DEFAULT_NAME, SpanModel, load_model
from models.language.spans.network import TextBatch
from models.language.spans.tags import OUTSIDE, Span, mentions_of
from models.language.tokens import words
from models.language.translation import BEAM_WIDTH, NEGATIONS, Translation
from models.queries import ContextualQuery, QuerySyntaxError
from models.world.spelling import Spelling

SEQUENCES = 16
"""Tag sequences read out for each task class; different ones may say the same query, and their probabilities add up."""
LEAST_TASK = 1e-3
"""Task classes less probable than this are not read out."""


@dataclass(frozen=True, slots=True, eq=False)
class SpanTranslator:
    """Reads a text once, and gives the most probable queries whose arguments are phrases of it.

    The probability of a query is that of its task times that of the tag sequences that say it. When an argument is
    mentioned more than once it is named by the first mention. No reading is given when "no task" is more probable than
    all readings together, or when the text has a word of `NEGATIONS`. A text that may say two things is understood, if
    not well.
    """

    model: SpanModel
    lexicon: Lexicon
    _numbers: Mapping[str, int] = field(repr=False)
    _transitions: TagScores = field(repr=False)  # [K, L, L]
    _start: TagScores = field(repr=False)  # [K, L]

    @classmethod
    def of(cls, model: SpanModel) -> Self:
        """The translator of a model."""
        vectors = lexicon() if model.training.get("lexicon", True) else lexicon().silent()
        network = model.network
        numbers = {word: number for number, word in enumerate(network.config.words, start=1)}
        transitions = network.transition.detach().double() / model.temperature + network.allowed
        return cls(model, vectors, numbers, transitions.numpy(), network.allowed_start.double().numpy())

    @classmethod
    def load(cls, folder: Path | None = None, *, name: str = DEFAULT_NAME) -> Self:
        """The model stored in a folder under a name; without a folder, the one that is shipped.

        Raises:
            WeightsError: it is missing, damaged, or does not fit the code.
        """
        return cls.of(load_model(folder, name=name))

    def translate(self, text: str, *, candidates: int = 1) -> tuple[Translation, ...]:
        """See `Translator`; at most `BEAM_WIDTH` candidates."""
        if candidates < 1:
            raise ValueError("at least one candidate must be asked for")
        spoken = words(text)
        if not spoken or not NEGATIONS.isdisjoint(spoken):
            return ()
        readings, refusal = self.read(spoken)
        if understood(readings) <= refusal:
            return ()
        return readings[: min(candidates, BEAM_WIDTH)]

    @torch.inference_mode()
    def read(self, spoken: Sequence[str]) -> tuple[tuple[Translation, ...], float]:
        """The readings of folded words, best first, and the probability that no task fits.

        Words that wordings never use and that the best reading takes for names are taken for names by all: where there
        is no sledge hammer, "pick up the sledge hammer" does not mean just any hammer.
        """
        scores = self.model.network(TextBatch.of([spoken], self._numbers, self.lexicon))
        emissions = scores.emissions[0].double().numpy() / self.model.temperature  # [S, K, L]
        tasks = (scores.tasks[0] / self.model.temperature).softmax(dim=0).tolist()  # [K + 1]
        found: dict[ContextualQuery, float] = {}
        named: dict[ContextualQuery, frozenset[int]] = {}
        for task, probability in enumerate(tasks[:-1]):
            if probability >= LEAST_TASK:
                for query, part, places in self._queries(spoken, emissions[:, task], task):
                    found[query] = found.get(query, 0.0) + probability * part
                    named.setdefault(query, places)
        ranked = sorted(found, key=lambda query: (-found[query], str(query)))
        kept = [query for query in ranked if named[query] >= named[ranked[0]]]
        return tuple(Translation(query, min(1.0, found[query])) for query in kept), tasks[-1]

    def _queries(
        self, spoken: Sequence[str], emissions: TagScores, task: int
    ) -> Iterator[tuple[ContextualQuery, float, frozenset[int]]]:
        """The queries of the best tag sequences of one task, the probabilities of the sequences, and the places of the
        words that they take for names and that wordings never use. `emissions` is [S, L].
        """
        name, arity = self.model.network.config.tasks[task]
        transitions, start = self._transitions[task], self._start[task]  # [L, L], [L]
        total = log_total(emissions, transitions, start)
        for score, tags in best_sequences(emissions, transitions, start, count=SEQUENCES):
            query = _query(name, spoken, mentions_of(tags, arity))
            if query is not None:
                places = (place for place, tag in enumerate(tags) if tag != OUTSIDE)
                open_places = frozenset(place for place in places if spoken[place] not in self._numbers)
                yield query, math.exp(min(0.0, score - total)), open_places


def understood(readings: Sequence[Translation]) -> float:
    """The probability that one of the readings is right."""
    return sum(reading.confidence for reading in readings)


def _query(name: str, spoken: Sequence[str], mentions: Sequence[Sequence[Span]]) -> ContextualQuery | None:
    """The query that mentions say, or None when an argument has none, or two that are not the same words."""
    if not all(mentions):
        return None
    said = [[spoken[begin:end] for begin, end in spans] for spans in mentions]
    if not all(_same(first, other) for first, *others in said for other in others):
        return None
    try:
        return ContextualQuery(name, tuple(" ".join(first) for first, *_ in said))
    except QuerySyntaxError:  # longer than a query may be: one word can be as long as a text
        return None


def _same(one: Sequence[str], other: Sequence[str]) -> bool:
    """Whether two mentions are the same words but for a typing mistake in each."""
    return len(one) == len(other) and all(map(_alike, one, other))


def _alike(one: str, other: str) -> bool:
    return one == other or bool(Spelling([other]).near(one) or Spelling([one]).near(other))
