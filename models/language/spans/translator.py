"""The default translator of single tasks: task classification and mention tagging, as ranked contextual queries."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Self

from models.language.spans.model import DEFAULT_NAME, SpanModel, load_model
from models.language.spans.reader import SpanReader, SpanReading
from models.language.spans.tags import Span
from models.language.tokens import words
from models.language.translation import BEAM_WIDTH, NEGATIONS, Translation
from models.queries import ContextualQuery, QuerySyntaxError
from models.world import widened
from models.world.spelling import Spelling


@dataclass(frozen=True, slots=True, eq=False)
class SpanTranslator:
    """Reads a text once, and gives the most probable queries whose arguments are phrases of it.

    The probability of a query is that of its task times that of the tag sequences that say it. When an argument is
    mentioned more than once it is named by the first mention. No reading is given when "no task" is more probable than
    all readings together, or when the text has a word of `NEGATIONS`. A text that may say two things is understood, if
    not well.
    """

    reader: SpanReader

    @classmethod
    def of(cls, model: SpanModel) -> Self:
        """The translator of a model."""
        return cls(SpanReader.of(model))

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
        return self.translate_all([text], candidates=candidates)[0]

    def translate_all(self, texts: Sequence[str], *, candidates: int = 1) -> list[tuple[Translation, ...]]:
        """As `translate`, for several texts at once, which is faster than one after the other."""
        spoken = {text: words(text) for text in texts}
        asked = [text for text, said in spoken.items() if said and NEGATIONS.isdisjoint(said)]
        read = self.reader.read_all([spoken[text] for text in asked]) if asked else []
        found: dict[str, tuple[Translation, ...]] = {}
        for text, (readings, refusal) in zip(asked, read, strict=True):
            translations = self._ranked(spoken[text], readings)
            if understood(translations) > refusal:
                found[text] = translations[: min(candidates, BEAM_WIDTH)]
        return [found.get(text, ()) for text in texts]

    def read(self, spoken: Sequence[str]) -> tuple[tuple[Translation, ...], float]:
        """The readings of folded words, best first, and the probability that no task fits."""
        readings, refusal = self.reader.read(spoken)
        return self._ranked(spoken, readings), refusal

    def _ranked(self, spoken: Sequence[str], readings: Sequence[SpanReading]) -> tuple[Translation, ...]:
        """Queries, best first.

        Words that wordings never use and that the best reading takes for names are taken for names by all: where there
        is no sledge hammer, "pick up the sledge hammer" does not mean just any hammer.
        """
        found: dict[ContextualQuery, float] = {}
        named: dict[ContextualQuery, frozenset[int]] = {}
        for reading in readings:
            query = _query(reading.task, spoken, reading.mentions)
            if query is not None:
                found[query] = found.get(query, 0.0) + reading.probability
                named.setdefault(query, reading.strange)
        ranked = sorted(found, key=lambda query: (-found[query], str(query)))
        kept = [query for query in ranked if named[query] >= named[ranked[0]]]
        return tuple(Translation(query, min(1.0, found[query])) for query in kept)


def understood(readings: Sequence[Translation]) -> float:
    """The probability that one of the readings is right."""
    return sum(reading.confidence for reading in readings)


def _query(name: str, spoken: Sequence[str], mentions: Sequence[Sequence[Span]]) -> ContextualQuery | None:
    """The query that mentions say, or None when an argument has two that are not the same words.

    A quantifier before a mention belongs to it, whether or not the network took it for a part: what is said of any or
    of every toy is not said of the toy.
    """
    said = [[spoken[begin:end] for begin, end in spans] for spans in mentions]
    if not all(_same(first, other) for first, *others in said for other in others):
        return None
    try:
        taken = [span for spans in mentions for span in spans]
        begins = [quantified(spoken, spans[0], taken)[0] for spans in mentions]
        phrases = [spoken[begin : spans[0][1]] for begin, spans in zip(begins, mentions, strict=True)]
        return ContextualQuery(name, tuple(map(" ".join, phrases)))
    except QuerySyntaxError:  # longer than a query may be: one word can be as long as a text
        return None


def quantified(spoken: Sequence[str], mention: Span, mentions: Sequence[Span]) -> Span:
    """A mention with its quantifier, unless that is a part of another one: "both machines"."""
    begin, end = mention
    start = widened(spoken, begin)
    return (begin if any(start < other <= begin for _, other in mentions) else start), end


def _same(one: Sequence[str], other: Sequence[str]) -> bool:
    """Whether two mentions are the same words but for a typing mistake in each."""
    return len(one) == len(other) and all(map(_alike, one, other))


def _alike(one: str, other: str) -> bool:
    return one == other or bool(Spelling([other]).near(one) or Spelling([one]).near(other))
