"""Taught wordings: an utterance with its query, and every command that says the same of other things.

"put the cylinder in the box" with `store(cylinder, box)` becomes the wording "put (the) $1 in (the) $2". What fills a
slot is a phrase of the command; a slot that occurs twice is filled by the same words both times.
"""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from itertools import product

from models.errors import CqltlError, Place
from models.language.teaching.sources import Move, SourceSlot, moves, source_slots
from models.language.teaching.utterance import DETERMINERS, Utterance
from models.language.tokens import words
from models.language.translation import Translation
from models.queries import ContextualQuery

MAX_SLOT_WORDS = 6
"""Most words of a phrase that fills a slot."""
MAX_STEPS = 20_000
"""Most comparisons for one command and wording; a wording that needs more does not match."""
MAX_TOTAL_STEPS = 200_000
"""Most comparisons for one command; wordings after that, the least literal ones, are not tried."""
CONNECTIVES = frozenset({"and", "then", "or", "but", "until", "before", "after", "while", "unless"})
"""Never within a phrase: what follows one of them is another clause."""
INTERROGATIVES = frozenset({"what", "who", "whom", "whose", "where", "why", "how", "which"})
"""No phrase begins with one: "what is in the box" asks, and orders nothing."""

Slot = int
Element = str | Slot
"""A word that must stand there, or the number of an argument, from 0."""


class ExampleTooGeneralError(CqltlError):
    """An utterance says nothing but its arguments, so every command would match it."""

    slug = "example-too-general"


@dataclass(frozen=True, slots=True)
class Wording:
    """A pattern of words and slots, and the task it says."""

    task: str
    arity: int
    elements: tuple[Element, ...]

    @classmethod
    def of(cls, utterance: Utterance) -> Wording:
        """The wording of an utterance.

        Raises:
            ExampleTooGeneralError: it has no word besides its arguments.
        """
        task, arity = utterance.query.task, len(utterance.query.arguments)
        begins = {begin: (end, slot) for slot, spans in enumerate(utterance.mentions) for begin, end in spans}
        elements: list[Element] = []
        at = 0
        while at < len(utterance.words):
            end, element = begins.get(at, (at + 1, utterance.words[at]))
            elements.append(element)
            at = end
        if all(isinstance(element, int) or element in DETERMINERS for element in elements):
            detail = f"the utterance has no word besides the arguments of {task}, so any command would match it"
            raise ExampleTooGeneralError(detail, places=[Place("", detail)])
        return cls(task, arity, tuple(_drop_determiners(elements)))

    @property
    def said(self) -> tuple[Element, ...]:
        """The wording with its slots numbered from left to right: two that say the same words are equal in this."""
        order: dict[Slot, Slot] = {}
        return tuple(e if isinstance(e, str) else order.setdefault(e, len(order)) for e in self.elements)

    @property
    def literal(self) -> int:
        """Number of words that must stand in a command."""
        return sum(isinstance(element, str) for element in self.elements)

    def match(self, spoken: Sequence[str], budget: list[int] | None = None) -> ContextualQuery | None:
        """The query that the words of a command say in this wording, or None.

        `budget` holds the comparisons left, and is lowered by those made; MAX_STEPS of them by default.
        """
        budget = [MAX_STEPS] if budget is None else budget
        filled = next(self._fill(tuple(spoken), 0, 0, {}, budget), None)
        if filled is None or len(filled) != self.arity:
            return None
        return ContextualQuery(self.task, tuple(" ".join(filled[slot]) for slot in range(self.arity)))

    def _fill(
        self, spoken: tuple[str, ...], at: int, element: int, filled: dict[Slot, tuple[str, ...]], budget: list[int]
    ) -> Iterator[dict[Slot, tuple[str, ...]]]:
        budget[0] -= 1
        if budget[0] < 0:
            return
        if element == len(self.elements):
            if at == len(spoken):
                yield filled
            return
        expected = self.elements[element]
        if isinstance(expected, str):
            if at < len(spoken) and spoken[at] == expected:
                yield from self._fill(spoken, at + 1, element + 1, filled, budget)
            return
        # A determiner is not part of the phrase, unless nothing else makes sense: `a` may be a name.
        starts = (at + 1, at) if at < len(spoken) and spoken[at] in DETERMINERS else (at,)
        known = filled.get(expected)
        lengths = range(1, MAX_SLOT_WORDS + 1) if known is None else (len(known),)
        for start, length in product(starts, lengths):
            phrase = spoken[start : start + length]
            if len(phrase) < length or phrase[0] in INTERROGATIVES:
                continue
            if known in (None, phrase) and CONNECTIVES.isdisjoint(phrase):
                yield from self._fill(spoken, start + length, element + 1, {**filled, expected: phrase}, budget)


@dataclass(frozen=True, slots=True)
class TaughtTranslator:
    """A translator of taught wordings: what is said as it was taught is understood with certainty, all else not."""

    wordings: tuple[tuple[Wording, frozenset[str]], ...]
    """Each with the words that must stand in a command; the most literal ones first."""
    sources: frozenset[SourceSlot] = frozenset()
    """The arguments that some wording says something else to be in: "unpack {1} from {2}"."""
    moves: frozenset[Move] = frozenset()
    """The arguments that some wording says to go to another one: "put {1} in {2}"."""
    own_words: Mapping[str, frozenset[str]] = field(default_factory=dict)
    """By task the words of its wordings."""

    @classmethod
    def of(cls, utterances: Iterable[Utterance]) -> TaughtTranslator:
        """From utterances; raises as `Wording.of`."""
        kept = sorted(dict.fromkeys(map(Wording.of, utterances)), key=lambda wording: -wording.literal)
        literals = [frozenset(e for e in wording.elements if isinstance(e, str)) for wording in kept]
        own_words: defaultdict[str, frozenset[str]] = defaultdict(frozenset)
        for wording, said in zip(kept, literals, strict=True):
            own_words[wording.task] |= said
        return cls(tuple(zip(kept, literals, strict=True)), source_slots(kept), moves(kept), dict(own_words))

    def translate_all(self, texts: Sequence[str], *, candidates: int = 1) -> list[tuple[Translation, ...]]:
        """As `translate`, of each text."""
        return [self.translate(text, candidates=candidates) for text in texts]

    def translate(self, text: str, *, candidates: int = 1) -> tuple[Translation, ...]:
        """The queries of the wordings that match, the most literal wordings first.

        The readings of the most literal wordings share the confidence 1; the others have confidence 0.
        """
        spoken = words(text)
        said, total = frozenset(spoken), MAX_TOTAL_STEPS
        found: dict[ContextualQuery, int] = {}
        for wording, literals in self.wordings:
            if not literals <= said:
                continue
            budget = [min(MAX_STEPS, total)]
            query = wording.match(spoken, budget)
            total = total - min(MAX_STEPS, total) + max(budget[0], 0)
            if query is not None:
                found.setdefault(query, wording.literal)
        best = [query for query, literal in found.items() if literal == max(found.values())]
        readings = [Translation(query, 1 / len(best) if query in best else 0.0) for query in found]
        return tuple(readings[:candidates])


def _drop_determiners(elements: Sequence[Element]) -> Iterator[Element]:
    """The elements without a determiner right before a slot; `match` takes one there or none."""
    following = [*elements[1:], ""]
    for element, after in zip(elements, following, strict=True):
        if not (element in DETERMINERS and isinstance(after, int)):
            yield element
