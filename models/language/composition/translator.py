"""Commands of one task or of several: the clauses of a text are found, understood, and put together."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping, Sequence
from contextlib import suppress
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import Protocol, Self

from models.language.composition.arrangement import Arrangement, arranged_as, unended, unmarked
from models.language.composition.avoidance import meanings
from models.language.composition.clauses import Understand, readings
from models.language.composition.marks import MarkedReader
from models.language.composition.shapes import (
    SINGLE,
    filled,
    has_several,
    in_one_clause,
    is_listed,
    is_plain,
    of_several_clauses,
    read_shape,
)
from models.language.spans.model import load_model
from models.language.spans.reader import SpanReader
from models.language.spans.translator import SpanTranslator, understood
from models.language.tokens import is_mark, marked_words
from models.language.translation import BEAM_WIDTH, Translation, weighed
from models.queries import Query, QuerySyntaxError

NAME = "composition"
SEQUENCE = "then("
"""How the shapes of sequences begin."""
ALONE = 0.5
"""Probability of being one task from which nothing else is looked for."""
SURE = 0.986
"""Probability of being one task from which the other network is not asked at all."""
CERTAIN = 0.9
"""Probability of being one task from which a sequence is not looked at, nor any mark of punctuation."""
ASKED = 0.6
"""Probability that a clause which says nothing else is near to what was taught."""
TAUGHT = 0.9
"""Most share of the taught readings of a clause; the environment may turn it round."""
LEAST = 0.02
"""Ways to put clauses together that are less probable are not looked at."""
LEAST_SHARE = 0.1
"""Nor those that are less probable than this share of the likeliest."""
UNDERSTOOD = 0.2
"""Compositions that are less probable together than this are not read."""
REFUSED = 0.25
"""Odds of texts that ask for nothing, to those in training: the other network refuses most of them by itself."""
APART = 0.7
"""Share of the readings of each clause by itself, where two of them may also be one task."""
JOINING = frozenset({"and", "then", "but", "or"})
"""Words that join a command to another."""
WHILE = frozenset({"while", "whilst", "during"})
MOST = 4
"""Ways to put clauses together that are looked at."""


class Taught(Protocol):
    """What understands clauses as they were taught."""

    def translate_all(self, texts: Sequence[str], *, candidates: int = 1) -> list[tuple[Translation, ...]]:
        """The readings of each text, best first, with confidences that add up to at most 1; raises TextTooLongError."""


@dataclass(frozen=True, slots=True, eq=False)
class ComposedTranslator:
    """Reads which clauses a text has and how they belong together; each is translated alone.

    The probability of a reading is that of its clauses belonging together so, times those of what the clauses say. A
    text that is understood as one task is that task; marks of punctuation, which tell clauses apart, change nothing
    there.
    """

    reader: SpanReader
    single: SpanTranslator
    taught: Taught | None = None
    nearby: Taught | None = None

    @classmethod
    def load(cls, single: SpanTranslator, folder: Path | None = None, *, name: str = NAME) -> Self:
        """With the model of a folder, or the one that is shipped; raises WeightsError."""
        return cls(SpanReader.of(load_model(folder, name=name), MarkedReader.load()), single)

    @property
    def tasks(self) -> frozenset[str]:
        """The task classes that it was trained on."""
        return frozenset(task for task, _ in self.single.reader.model.network.config.tasks)

    @property
    def saying(self) -> frozenset[str]:
        """The words that it knows to say what to do, and not with what."""
        return frozenset(self.reader.model.network.config.words)

    def knowing(self, taught: Taught, *, nearby: Taught | None = None) -> Self:
        """The same, with clauses that are said as they were taught; what clauses may say that say nothing else is asked
        of `nearby`.
        """
        return replace(self, taught=taught, nearby=nearby or taught)

    def translate(self, text: str, *, candidates: int = 1) -> tuple[Translation, ...]:
        """See `Translator`."""
        spoken = marked_words(text)
        if not any(not is_mark(word) for word in spoken):
            return ()
        understand = _Clauses(self.single, self.taught, self.nearby)
        whole = understand.alone(text)
        if understood(whole) >= SURE:
            return whole[:candidates]
        if understood(whole) >= CERTAIN:
            spoken = unmarked(spoken)  # how one task is punctuated changes nothing
        elif understood(whole) >= ALONE:
            spoken = unended(spoken)  # nor does the end of what may be one
        shapes, refusal = self._shapes(spoken)
        whole = _apart(whole, shapes, spoken, understand)
        if understood(whole) >= ALONE:
            if _outvoted(understood(whole), refusal):
                return ()
            alone = not _outvoted(understood(whole), _part(shapes, has_several))
            certain = understood(whole) >= CERTAIN and of_several_clauses(whole[0].query)
            listed = is_listed if certain else is_plain
            if (in_one_clause(whole[0].query) and alone) or _part(shapes, listed) >= ALONE:
                return whole[:candidates]
        return _ranked(self._weighed(whole, shapes, spoken, understand), refusal, candidates)

    def several(self, text: str, *, candidates: int = 1, asked: bool = False) -> tuple[Translation, ...]:
        """The readings of a text as more than one command, whatever it says as one; as `translate`. It may ask for
        nothing, unless it is known to be `asked`.
        """
        spoken = marked_words(text)
        if not any(not is_mark(word) for word in spoken):
            return ()
        shapes, refusal = self._shapes(spoken)
        composed = [shape for shape in shapes if has_several(shape.shape)]
        found = self._weighed((), composed, spoken, _Clauses(self.single, self.taught, self.nearby))
        return _ranked(found, 0.0 if asked else refusal, candidates)

    def _weighed(
        self,
        whole: Sequence[Translation],
        shapes: Sequence[Arrangement],
        spoken: Sequence[str],
        understand: Understand,
    ) -> dict[Query, float]:
        """The queries that the shapes give, and those of the text as one task, with their probabilities."""
        one_task, alone = understood(whole), 0.0
        found: dict[Query, float] = {}
        for arranged in shapes:
            sequence = arranged.shape.startswith(SEQUENCE)
            needless = arranged.shape == SINGLE or (sequence and one_task >= CERTAIN)
            read = {} if needless else self._read(arranged, spoken, understand)
            # What cannot be read together may still be one task, and a sequence that is one task is rather that.
            single = 1.0 if not read else one_task if sequence else 0.0
            alone += single * arranged.share
            for query, part in read.items():
                found[query] = found.get(query, 0.0) + (1.0 - single) * arranged.share * part
        if sum(found.values()) <= UNDERSTOOD:
            found = {}
        for translation in whole:
            found[translation.query] = found.get(translation.query, 0.0) + alone * translation.confidence
        return found

    def _read(self, arranged: Arrangement, spoken: Sequence[str], understand: Understand) -> dict[Query, float]:
        """The queries of an arrangement with their probabilities, and those with two of its clauses as one task."""
        joined = list(arranged.joined(spoken))
        understand.prepare(" ".join(clause.words) for each in (arranged, *joined) for clause in each.clauses)
        apart = _composed(arranged, understand)
        together = [read for each in joined if (read := _composed(each, understand))]
        found: dict[Query, float] = {}
        for read, share in [(apart, APART if together else 1.0), *((r, (1 - APART) / len(together)) for r in together)]:
            for query, part in read.items():
                found[query] = found.get(query, 0.0) + part * (share if apart else share / (1 - APART))
        return found

    def _shapes(self, spoken: Sequence[str]) -> tuple[list[Arrangement], float]:
        """The likeliest arrangements, and the probability that the text asks for nothing."""
        found: dict[Arrangement, float] = {}
        readings, refusal = self.reader.read(spoken)
        for reading in readings:
            arranged = arranged_as(reading.task, reading.mentions, spoken)
            if arranged is not None and arranged.shape == SINGLE:  # wherever its command is said, likeliest first
                arranged = next((known for known in found if known.shape == SINGLE), arranged)
            if arranged is not None:
                found[arranged] = found.get(arranged, 0.0) + reading.probability
        ranked = sorted(found.items(), key=lambda item: -item[1])[:MOST]
        least = max(LEAST, ranked[0][1] * LEAST_SHARE) if ranked else 0.0
        every = 1.0 - (1.0 - REFUSED) * refusal
        kept = [replace(arranged, share=share / every) for arranged, share in ranked if share >= least]
        if kept and _at_once(kept[0]):
            return [], 1.0
        return kept, REFUSED * refusal / every


def _apart(
    whole: Sequence[Translation], shapes: Sequence[Arrangement], spoken: Sequence[str], understand: _Clauses
) -> tuple[Translation, ...]:
    """What a text says as one task; where that is not understood, what the command in it says, without reasons and
    remarks: "my knees hurt, so go to the bank for me".
    """
    single = next((arranged for arranged in shapes if arranged.shape == SINGLE), None)
    if understood(whole) >= ALONE or single is None or _joins(single, spoken):
        return tuple(whole)
    alone = understand.alone(" ".join(single.clauses[0].words))
    return alone if understood(alone) > understood(whole) else tuple(whole)


def _joins(single: Arrangement, spoken: Sequence[str]) -> bool:
    """Whether what is said beside a command is joined to it, and so asks for something too: "... and sing a song"."""
    begin, end = single.spans[0]
    before, after = unmarked(spoken[:begin])[-1:], unmarked(spoken[end:])[:1]
    return not JOINING.isdisjoint((*before, *after))


def _at_once(arranged: Arrangement) -> bool:
    """Whether something is forbidden only while something else holds, which no shape says."""
    return "until(" in arranged.shape and any(not WHILE.isdisjoint(clause.lead) for clause in arranged.clauses[1:])


def _composed(arranged: Arrangement, understand: Understand) -> dict[Query, float]:
    """The queries of an arrangement with their probabilities; none where a clause cannot be understood."""
    found: dict[Query, float] = {}
    for queries, part in readings(arranged.clauses, understand, before=arranged.before):
        with suppress(QuerySyntaxError):  # too long or too deep
            for query, likely in meanings(filled(read_shape(arranged.shape), dict(queries))):
                found[query] = found.get(query, 0.0) + part * likely
    return found


@dataclass(slots=True, eq=False)
class _Clauses:
    """What clauses may say: as they were taught, or else as they are read; each is read once."""

    single: SpanTranslator
    taught: Taught | None
    nearby: Taught | None
    _read: dict[str, tuple[Translation, ...]] = field(default_factory=dict)
    _known: dict[str, tuple[Translation, ...]] = field(default_factory=dict)

    def __call__(self, text: str, /) -> Sequence[Translation]:
        """See `Understand`."""
        self.prepare([text])
        read = self._read[text]
        taught = self._known.get(text, ())
        if not taught:
            return read
        if not read:
            return _asked(taught)
        if sum(translation.confidence for translation in taught) < CERTAIN:
            return weighed(taught, read)
        known = {translation.query for translation in taught}
        total = sum(translation.confidence for translation in taught)
        first = [replace(t, confidence=TAUGHT * t.confidence) for t in taught]
        rest = [replace(t, confidence=(1 - TAUGHT * total) * t.confidence) for t in read if t.query not in known]
        return sorted([*first, *rest], key=lambda t: -t.confidence)

    def alone(self, text: str) -> tuple[Translation, ...]:
        """What the whole text says as one task, not counting what was taught."""
        if text not in self._read:
            self._read[text] = self.single.translate(text, candidates=BEAM_WIDTH)
        return self._read[text]

    def prepare(self, texts: Iterable[str], /) -> None:
        """See `Understand`."""
        texts = list(texts)
        new = [text for text in dict.fromkeys(texts) if text not in self._read]
        if new:
            self._read.update(zip(new, self.single.translate_all(new, candidates=BEAM_WIDTH), strict=True))
        unknown = [text for text in dict.fromkeys(texts) if text not in self._known]
        for taught, asked in ((self.taught, True), (self.nearby, False)):
            part = [text for text in unknown if (understood(self._read[text]) >= ALONE) is asked]
            if part and taught is not None:
                self._known.update(zip(part, taught.translate_all(part, candidates=BEAM_WIDTH), strict=True))


def _asked(taught: Sequence[Translation]) -> Sequence[Translation]:
    """What a clause may say that says nothing else: as it asks for something, that is likelier than by itself."""
    total = sum(translation.confidence for translation in taught)
    return [replace(t, confidence=t.confidence * ASKED / total) for t in taught] if total < ASKED else taught


def _ranked(found: Mapping[Query, float], refusal: float, candidates: int) -> tuple[Translation, ...]:
    """The likeliest queries; none where it is likelier that the text asks for nothing."""
    if sum(found.values()) <= refusal:
        return ()
    ranked = sorted(found, key=lambda query: (-found[query], str(query)))
    return tuple(Translation(query, min(1.0, found[query])) for query in ranked[:candidates])


def _outvoted(understood: float, other: float) -> bool:
    """Whether a text that one network understands as one task is something else, as the other network says with more
    confidence: the two saw different texts in training, so their odds are multiplied.
    """
    return understood * (1.0 - other) < (1.0 - understood) * other


def _part(shapes: Sequence[Arrangement], fits: Callable[[str], bool]) -> float:
    """The part of the shapes that fit, by probability."""
    return sum(each.share for each in shapes if fits(each.shape)) / (sum(each.share for each in shapes) or 1.0)
