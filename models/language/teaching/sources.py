"""What prepositions tell of two things: the box in "take the ball out of the box" is not where the ball shall be, and
who says "put the bag in the box" does not want the box in the bag.

What a text is compared with by its meaning is near to it all the same: to put the ball in the box is about the same
things, and moves them. So a task is heard in such words only if it was taught in such words.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from itertools import pairwise
from typing import TYPE_CHECKING

from models.language.tokens import find
from models.queries import ContextualQuery
from models.world.phrase_index import DETERMINERS

if TYPE_CHECKING:
    from models.language.teaching.wording import Wording

SOURCES = (("out", "of"), ("off", "of"), ("off",), ("from",), ("away", "from"), ("out", "from"))
"""Words after a thing and before where it is."""
_LAST = frozenset(source[-1] for source in SOURCES)

GOALS = frozenset({"in", "into", "inside", "on", "onto", "to"})
"""Words after a thing and before where it goes."""

SourceSlot = tuple[str, int]
"""A task and the place of one of its arguments, from 0."""
Move = tuple[str, int, int]
"""A task, the place of the argument that moves, and that of where it goes."""


def source_slots(wordings: Iterable[Wording]) -> frozenset[SourceSlot]:
    """The arguments that some wording names after a word for where things are: "unpack {1} from {2}"."""
    return frozenset(
        (wording.task, slot)
        for wording in wordings
        for before, slot in pairwise(wording.elements)
        if isinstance(slot, int) and before in _LAST
    )


def moves(wordings: Iterable[Wording]) -> frozenset[Move]:
    """The arguments that some wording says to go to another one: "put {1} in {2}"."""
    return frozenset(
        (wording.task, thing, goal)
        for wording in wordings
        for thing, word, goal in zip(wording.elements, wording.elements[1:], wording.elements[2:], strict=False)
        if isinstance(thing, int) and isinstance(goal, int) and word in GOALS
    )


def moves_back(said: Sequence[str], query: ContextualQuery, known: frozenset[Move]) -> bool:
    """Whether a query moves to a thing what the folded words of a command move the thing to."""
    for task, thing, goal in known:
        if task != query.task or (task, goal, thing) in known:
            continue
        first, second = query.arguments[goal].split(), query.arguments[thing].split()
        begin = find(first, said)
        between = [] if begin is None else list(said[begin + len(first) :])
        if between and between[0] in GOALS:
            place = 1
            while place < len(between) and between[place] in DETERMINERS:
                place += 1
            if between[place : place + len(second)] == second:
                return True
    return False


def mistakes_source(said: Sequence[str], query: ContextualQuery, known: frozenset[SourceSlot]) -> bool:
    """Whether a query has for an argument what the folded words of a command only say another one of its arguments to
    be in or at, and no wording of its task is `known` to do so.
    """
    phrases = [argument.split() for argument in query.arguments]
    for place, phrase in enumerate(phrases):
        if (query.task, place) in known or (begin := find(phrase, said)) is None:
            continue
        while begin > 0 and said[begin - 1] in DETERMINERS:
            begin -= 1
        for source in SOURCES:
            end = begin - len(source)
            if end > 0 and tuple(said[end:begin]) == source and _ends_with_any(said[:end], phrases):
                return True
    return False


def _ends_with_any(said: Sequence[str], phrases: Iterable[Sequence[str]]) -> bool:
    return any(tuple(said[-len(phrase) :]) == tuple(phrase) for phrase in phrases)
