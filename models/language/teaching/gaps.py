"""What a command leaves out: "bring the towel" is a wording of bringing something somewhere, but for the somewhere.

A wording with one of its slots left open, and with or without the preposition before it, is matched as wordings are.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass

from models.language.teaching.utterance import DETERMINERS
from models.language.teaching.wording import MAX_STEPS, MAX_TOTAL_STEPS, Element, Wording
from models.language.tokens import words

PREPOSITIONS = frozenset(
    {"to", "in", "into", "inside", "on", "onto", "at", "from", "over", "towards", "near", "by", "with"}
)
"""A word that may be left out together with the name that it stands before."""
POLITE = frozenset({"please", "kindly", "robot", "hey", "ok", "okay", "now", "just"})
"""Words around a command that are no part of its wording."""
POLITE_FRAMES = (("can", "you"), ("could", "you"), ("would", "you"), ("will", "you"), ("i", "want", "you", "to"))
"""Words in which a command may be wrapped."""
PERSONS = frozenset({"me", "us", "him", "her"})
"""For whom something is to be done, after the first word: they are nowhere, so "bring me the cup" names no place."""
MEANINGLESS = PREPOSITIONS | DETERMINERS | POLITE | {"i", "you", "be", "is", "are", "and", "then", "need", "want"}
"""A wording of nothing else says no task."""


@dataclass(frozen=True, slots=True)
class Gap:
    """A task that a command says but for one argument: the phrases of its arguments, None for the missing one."""

    task: str
    arguments: tuple[str | None, ...]


@dataclass(frozen=True, slots=True)
class OpenWordings:
    """Wordings with a slot left open. Each with the slot, and with the words that must stand in a command."""

    _open: tuple[tuple[Wording, int, frozenset[str]], ...]

    @classmethod
    def of(cls, wordings: Iterable[Wording]) -> OpenWordings:
        """All ways to leave one slot of each wording open; the most literal ones first."""
        found = dict.fromkeys(each for wording in wordings for each in _opened(wording))
        ranked = sorted(found, key=lambda each: -each[0].literal)
        return cls(tuple((w, slot, frozenset(e for e in w.elements if isinstance(e, str))) for w, slot in ranked))

    def gaps(self, text: str) -> tuple[Gap, ...]:
        """What a text says but for one argument, in the most literal of the wordings that match.

        Raises:
            TextTooLongError: the text is beyond the limits of a command.
        """
        spoken = _stated(words(text))
        said, total = frozenset(spoken), MAX_TOTAL_STEPS
        found: dict[Gap, int] = {}
        for wording, slot, literals in self._open:
            if not literals <= said or wording.literal < max(found.values(), default=0):
                continue
            budget = [min(MAX_STEPS, total)]
            query = wording.match(spoken, budget)
            total -= min(MAX_STEPS, total) - max(budget[0], 0)
            if query is not None:
                arguments = (*query.arguments[:slot], None, *query.arguments[slot:])
                found.setdefault(Gap(query.task, arguments), wording.literal)
        return tuple(found)


def ends_open(text: str) -> bool:
    """Whether a text stops where a name should follow: "put the cup in the"."""
    said = words(text)
    return bool(said) and said[-1] in DETERMINERS


def _stated(said: tuple[str, ...]) -> tuple[str, ...]:
    """The words of a command without what is wrapped around it, without an article at its end, and without a person."""
    begin, end = 0, len(said)
    while begin < end and (wrapped := _wrapping(said[begin:])):
        begin += wrapped
    while begin < end and said[end - 1] in POLITE | DETERMINERS:
        end -= 1
    said = said[begin:end]
    return said[:1] + said[2:] if len(said) > 1 and said[1] in PERSONS else said


def _wrapping(said: tuple[str, ...]) -> int:
    """How many words at the beginning are polite and no part of a command."""
    frame = next((len(frame) for frame in POLITE_FRAMES if said[: len(frame)] == frame), 0)
    return frame or int(said[0] in POLITE)


def _opened(wording: Wording) -> Iterator[tuple[Wording, int]]:
    """The wording without one of its slots, the others numbered on, and the slot. Where nothing but a verb and what it
    is done with is left, the preposition may go too. What stands before another name only tells more of it: "the {red}
    {ball}".
    """
    for slot in range(wording.arity):
        if wording.elements.count(slot) != 1:
            continue
        at = wording.elements.index(slot)
        before, after = wording.elements[:at], wording.elements[at + 1 :]
        if after and isinstance(after[0], int):
            continue
        for start in dict.fromkeys((before, _bare(before, after))):
            elements = tuple(_renumbered(start + after, slot))
            if any(isinstance(element, str) and element not in MEANINGLESS for element in elements):
                yield Wording(wording.task, wording.arity - 1, elements), slot


def _bare(before: tuple[Element, ...], after: tuple[Element, ...]) -> tuple[Element, ...]:
    """What stands before a slot without prepositions, where that leaves just one word and other slots."""
    bare = before
    while bare and bare[-1] in PREPOSITIONS:
        bare = bare[:-1]
    left = [isinstance(element, str) for element in bare + after]
    return bare if sum(left) == 1 and len(left) > 1 else before


def _renumbered(elements: Sequence[Element], slot: int) -> Iterator[Element]:
    yield from (e - 1 if isinstance(e, int) and e > slot else e for e in elements)
