"""How the clauses of a text may belong together: a shape with its clauses, and the same with two clauses as one."""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from itertools import pairwise

from models.language.composition.clauses import Clause
from models.language.composition.shapes import forbidden, read_shape
from models.language.spans.tags import Span
from models.language.tokens import is_mark
from models.queries import Composition, ContextualQuery, Operator, Query

JOINED_BY = (Operator.THEN, Operator.AND)
"""Operators of which two operands may be one task: "load the ball into the crate, carry it to the hall" ships it."""
_CLAUSE = re.compile(r"clause\((\d+)\)")
_LABEL = re.compile(r"[a-z]|\d{1,3}")
_BEHIND = frozenset({"and", "or", "then", "but", "before", "after", "until", "first", "again", "in"})
"""What may follow a name that ends with a letter or a number."""


@dataclass(frozen=True, slots=True)
class Arrangement:
    """A shape, its clauses in the order of the text with their places in it, the words in front of the first, and the
    probability of all this.
    """

    shape: str
    clauses: tuple[Clause, ...] = ()
    spans: tuple[Span, ...] = ()
    before: tuple[str, ...] = ()
    share: float = 1.0

    def joined(self, spoken: Sequence[str]) -> Iterator[Arrangement]:
        """The arrangements of the words and marks in which two neighbours, done one after the other or both, are one
        clause; none that leaves one clause alone.
        """
        for place, (one, other) in enumerate(pairwise(self.clauses)):
            if len(self.clauses) < 3 or other.number != one.number + 1 or one.forbidden or other.forbidden:
                continue
            shape = _without(read_shape(self.shape), one.number, other.number)
            if shape is not None:
                yield self._with(shape, place, spoken)

    def _with(self, shape: Query, place: int, spoken: Sequence[str]) -> Arrangement:
        """Of a shape that lacks the clause after that at a place, which says what both do."""
        one, other = self.clauses[place : place + 2]
        span = self.spans[place][0], self.spans[place + 1][1]

        def moved(number: int) -> int:
            return number if number <= one.number else number - 1

        clauses = [replace(clause, number=moved(clause.number)) for clause in self.clauses if clause is not other]
        clauses[place] = Clause(one.number, unmarked(spoken[slice(*span)]), False, several=True)
        spans = (*self.spans[:place], span, *self.spans[place + 2 :])
        text = _CLAUSE.sub(lambda found: str(moved(int(found[1]))), str(shape))
        return replace(self, shape=text, clauses=tuple(clauses), spans=spans)


def arranged_as(shape: str, mentions: Sequence[Sequence[Span]], spoken: Sequence[str]) -> Arrangement | None:
    """A shape with the clauses at these places, by number; None where one has no words."""
    mentions = [_lengthened(spans, spoken) for spans in mentions]
    clauses = [
        ((spans[0][0], spans[-1][1]), Clause(number, words_of(spans, spoken), number in forbidden(shape)))
        for number, spans in enumerate(mentions, start=1)
    ]
    if not all(clause.words for _, clause in clauses):
        return None
    clauses.sort(key=lambda pair: pair[0][0])
    ordered = tuple(span for span, _ in clauses)
    before = unmarked(spoken[: ordered[0][0]])
    leads = [before, *(unmarked(spoken[one[1] : other[0]]) for one, other in pairwise(ordered))]
    led = tuple(replace(clause, lead=lead) for (_, clause), lead in zip(clauses, leads, strict=True))
    return Arrangement(shape, led, ordered, before)


def _lengthened(spans: Sequence[Span], spoken: Sequence[str]) -> Sequence[Span]:
    """A clause with the letter or number behind it, which belongs to the name at its end: "go to shelf", "b"."""
    end = spans[-1][1]
    if end == len(spoken) or not _LABEL.fullmatch(spoken[end]):
        return spans
    if end + 1 < len(spoken) and spoken[end + 1] not in _BEHIND and not is_mark(spoken[end + 1]):
        return spans  # "a ball", "i need"
    return (*spans[:-1], (spans[-1][0], end + 1))


def words_of(spans: Sequence[Span], spoken: Sequence[str]) -> tuple[str, ...]:
    """The words of a clause. What is said in two pieces, a subject and what is done to it, is put as if it were done:
    "the ball" must be "put in the box" is "put the ball in the box".
    """
    if len(spans) != 2:
        return unmarked(spoken[slice(*spans[0])])
    subject, said = (unmarked(spoken[slice(*span)]) for span in spans)
    return (*said[:1], *subject, *said[1:])


def unmarked(spoken: Sequence[str]) -> tuple[str, ...]:
    """The words among words and marks of punctuation."""
    return tuple(word for word in spoken if not is_mark(word))


def unended(spoken: Sequence[str]) -> tuple[str, ...]:
    """The words and marks without the marks at the end."""
    end = max((place for place, word in enumerate(spoken, start=1) if not is_mark(word)), default=0)
    return tuple(spoken[:end])


def _without(shape: Query, one: int, other: int) -> Query | None:
    """A shape without a clause that stands right behind another under the same operator; None if it does not."""
    if isinstance(shape, ContextualQuery):
        return None
    names = [operand.arguments[0] if isinstance(operand, ContextualQuery) else "" for operand in shape.operands]
    if shape.operator in JOINED_BY and str(one) in names and str(other) in names:
        kept = [operand for operand, name in zip(shape.operands, names, strict=True) if name != str(other)]
        return Composition(shape.operator, tuple(kept)) if len(kept) > 1 else kept[0]
    for place, operand in enumerate(shape.operands):
        found = _without(operand, one, other)
        if found is not None:
            return Composition(shape.operator, (*shape.operands[:place], found, *shape.operands[place + 1 :]))
    return None
