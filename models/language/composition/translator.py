"""Commands of one task or of several: the clauses of a text are found, understood, and put together."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from contextlib import suppress
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Self

from models.language.composition.arrangement import Arrangement, arranged_as, unended, unmarked
from models.language.composition.avoidance import meanings
from models.language.composition.clauses import Understand, are_commands, readings
from models.language.composition.marks import MarkedReader
from models.language.composition.shapes import (
    SINGLE,
    filled,
    forbids,
    has_several,
    in_one_clause,
    is_listed,
    is_plain,
    of_several_clauses,
    read_shape,
)
from models.language.composition.understanding import (
    ALONE,
    CERTAIN,
    JOINING,
    SpokenClauses,
    Taught,
    goes_elsewhere,
)
from models.language.spans.ensemble import SpanEnsemble
from models.language.spans.model import load_model
from models.language.spans.reader import SpanReader
from models.language.spans.translator import SpanTranslator, understood
from models.language.tokens import is_mark, marked_words
from models.language.translation import NEGATIONS, Translation
from models.queries import Query, QuerySyntaxError

NAMES = ("composition-0", "composition-1")
"""The networks that read how clauses belong together."""
SEQUENCE = "then("
"""How the shapes of sequences begin."""
PARTED = 0.4
"""Probability of being several commands from which one of them is not taken for all."""
AVOIDED = "avoid(1)"
"""The shape of forbidding something."""
SURE = 0.986
"""Probability of being one task from which the other network is not asked at all."""
LEAST = 0.02
"""Ways to put clauses together that are less probable are not looked at."""
LEAST_SHARE = 0.1
"""Nor those that are less probable than this share of the likeliest."""
UNDERSTOOD = 0.2
"""Compositions that are less probable together than this are not read."""
SPLITTING = 0.1
"""Probability that a text which says one task that is not known also falls into commands that are: "go to the kitchen
and pick up the ball" is hardly one task.
"""
APART = 0.7
"""Share of the readings of each clause by itself, where two of them may also be one task."""
WHILE = frozenset({"while", "whilst", "during"})
MOST = 4
"""Ways to put clauses together that are looked at."""


@dataclass(frozen=True, slots=True, eq=False)
class ComposedTranslator:
    """Reads which clauses a text has and how they belong together; each is translated alone.

    The probability of a reading is that of its clauses belonging together so, times those of what the clauses say. A
    text that is understood as one task is that task; marks of punctuation, which tell clauses apart, change nothing
    there.
    """

    reader: SpanEnsemble
    single: SpanTranslator
    knows: SpokenClauses | None = None

    @classmethod
    def load(cls, single: SpanTranslator, folder: Path | None = None, *, names: Sequence[str] = NAMES) -> Self:
        """With the models of a folder, or those that are shipped; raises WeightsError."""
        words = MarkedReader.load()
        return cls(SpanEnsemble([SpanReader.of(load_model(folder, name=name), words) for name in names]), single)

    @property
    def tasks(self) -> frozenset[str]:
        """The task classes that it was trained on."""
        return frozenset(task for task, _ in self.single.reader.model.config.tasks)

    @property
    def saying(self) -> frozenset[str]:
        """The words that it knows to say what to do, and not with what."""
        return self.reader.words

    def knowing(self, taught: Taught, *, nearby: Taught | None = None) -> Self:
        """The same for one command, with clauses that are said as they were taught; what clauses may say that say
        nothing else is asked of `nearby`. However often it is asked for that command, each clause is read once.
        """
        return replace(self, knows=SpokenClauses(self.single, taught, nearby or taught))

    def translate(self, text: str, *, candidates: int = 1) -> tuple[Translation, ...]:
        """See `Translator`."""
        spoken = marked_words(text)
        if not any(not is_mark(word) for word in spoken):
            return ()
        understand = self._clauses()
        whole = understand.alone(text)
        if goes_elsewhere(whole, spoken, understand):
            return self._several(spoken, understand, candidates) or whole[:candidates]
        negated = not NEGATIONS.isdisjoint(spoken)
        if understood(whole) >= SURE and not negated:
            return whole[:candidates]
        if understood(whole) >= CERTAIN:
            spoken = unmarked(spoken)  # how one task is punctuated changes nothing
        elif understood(whole) >= ALONE:
            spoken = unended(spoken)  # nor does the end of what may be one
        shapes, refusal = self._shapes(spoken)
        forbidden = _part(shapes, forbids) if negated else 0.0
        if forbidden >= ALONE:  # what a text forbids is never done, however much the rest of it asks for that
            shapes = [replace(each, share=each.share / forbidden) for each in shapes if forbids(each.shape)]
            whole = ()
        else:
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
        return self._several(spoken, self._clauses(), candidates, asked=asked)

    def _several(
        self, spoken: Sequence[str], understand: SpokenClauses, candidates: int, *, asked: bool = False
    ) -> tuple[Translation, ...]:
        shapes, refusal = self._shapes(spoken)
        composed = [shape for shape in shapes if has_several(shape.shape)]
        found = self._weighed((), composed, spoken, understand)
        return _ranked(found, 0.0 if asked else refusal, candidates)

    def forbids(self, text: str) -> float:
        """The probability that a text that asks for something forbids one thing, and asks for nothing else."""
        shapes, _ = self._shapes(marked_words(text))
        return _part(shapes, AVOIDED.__eq__)

    def forbids_in_part(self, text: str) -> float:
        """The probability that a text that forbids something says more than that: until when, while what holds, or what
        is to be done besides. No one task is all of it.
        """
        spoken = marked_words(text)
        shapes, refusal = self._shapes(spoken)
        if not shapes and not WHILE.isdisjoint(spoken):
            return refusal
        return _part(shapes, lambda shape: forbids(shape) and shape != AVOIDED)

    def parts(self, text: str) -> tuple[str, ...]:
        """The clauses of a text that probably says more than one of them says: of several, or of one to which something
        is joined that may ask for something too ("turn on the light and wave"); none of a text that is one clause.
        """
        spoken = marked_words(text)
        shapes, _ = self._shapes(spoken)
        several = [each for each in shapes if len(each.clauses) > 1]
        if several and sum(each.share for each in several) >= PARTED * sum(each.share for each in shapes):
            return tuple(" ".join(clause.words) for clause in several[0].clauses)
        joined = shapes and shapes[0].shape == SINGLE and _joins(shapes[0], spoken)
        return (" ".join(shapes[0].clauses[0].words),) if joined else ()

    def refuses(self, text: str) -> float:
        """The probability that a text asks for nothing, of whatever task."""
        return self._shapes(marked_words(text))[1]

    def _clauses(self) -> SpokenClauses:
        """What clauses may say."""
        return self.knows or SpokenClauses(self.single, None, None)

    def _weighed(
        self,
        whole: Sequence[Translation],
        shapes: Sequence[Arrangement],
        spoken: Sequence[str],
        understand: Understand,
    ) -> dict[Query, float]:
        """The queries that the shapes give, and those of the text as one task, with their probabilities."""
        one_task, alone, unexplained = understood(whole), 0.0, 0.0
        parts: list[tuple[Query, float, bool]] = []
        for arranged in shapes:
            sequence = arranged.shape.startswith(SEQUENCE)
            needless = arranged.shape == SINGLE or (sequence and one_task >= CERTAIN)
            read = {} if needless else self._read(arranged, spoken, understand)
            # What cannot be read together may still be one task, and a sequence that is one task is rather that.
            single = 1.0 if not read else one_task if sequence else 0.0
            alone += single * arranged.share
            unexplained += (1.0 - one_task) * arranged.share if arranged.shape == SINGLE else 0.0
            split = bool(read) and are_commands(arranged.clauses, understand)
            parts += [(query, (1.0 - single) * arranged.share * part, split) for query, part in read.items()]
        found = _split(parts, unexplained)
        if sum(found.values()) <= UNDERSTOOD:
            found = {}
        if one_task >= CERTAIN:
            found, alone = voted(found, alone, one_task)
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
        kept = [replace(arranged, share=share) for arranged, share in ranked if share >= least]
        if kept and _at_once(kept[0]):
            return [], 1.0
        return kept, refusal


def _apart(
    whole: Sequence[Translation], shapes: Sequence[Arrangement], spoken: Sequence[str], understand: SpokenClauses
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


def _split(parts: Sequence[tuple[Query, float, bool]], unexplained: float) -> dict[Query, float]:
    """The queries with their probabilities, of which those that fall into commands take nearly all of what would be one
    task that is not known.
    """
    commands = sum(part for _, part, split in parts if split)
    scale = (commands + unexplained) / (commands + SPLITTING * unexplained or 1.0)
    found: dict[Query, float] = {}
    for query, part, split in parts:
        found[query] = found.get(query, 0.0) + part * (scale if split else 1.0)
    return found


def _ranked(found: Mapping[Query, float], refusal: float, candidates: int) -> tuple[Translation, ...]:
    """The likeliest queries; none where it is likelier that the text asks for nothing."""
    if sum(found.values()) <= refusal:
        return ()
    ranked = sorted(found, key=lambda query: (-found[query], str(query)))
    return tuple(Translation(query, min(1.0, found[query])) for query in ranked[:candidates])


def voted(found: Mapping[Query, float], alone: float, understood: float) -> tuple[dict[Query, float], float]:
    """The probabilities of several commands and of one task, when the other network has its say too: as `_outvoted`."""
    several = sum(found.values())
    one, other = alone * understood, several * (1.0 - understood)
    scale = (alone + several) / (one + other or 1.0)
    return {query: part * (1.0 - understood) * scale for query, part in found.items()}, one * scale


def _outvoted(understood: float, other: float) -> bool:
    """Whether a text that one network understands as one task is something else, as the other network says with more
    confidence: the two saw different texts in training, so their odds are multiplied.
    """
    return understood * (1.0 - other) < (1.0 - understood) * other


def _part(shapes: Sequence[Arrangement], fits: Callable[[str], bool]) -> float:
    """The part of the shapes that fit, by probability."""
    return sum(each.share for each in shapes if fits(each.shape)) / (sum(each.share for each in shapes) or 1.0)
