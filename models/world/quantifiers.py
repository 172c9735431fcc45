"""Phrases that speak of several things: "any red toy", "everything in the kitchen", "both boxes", "all but the hall".

`ANY` is one of the things, whichever; `ALL` is each of them; `ONE` is the thing that any other phrase names. "A toy" is
`ONE`: said to a robot it may mean a certain toy, so where there are several the speaker is asked.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from enum import StrEnum

from models.world.names import words
from models.world.phrase_index import DETERMINERS, WHATEVER, Words, spoken_words

_NUMBERS = {word: number for number, word in enumerate(words("two three four five six seven eight nine ten"), start=2)}


class Quantifier(StrEnum):
    """How many of the things that a phrase fits are meant."""

    ONE = "one"
    ANY = "any"
    ALL = "all"


_SAYINGS = {
    Quantifier.ANY: (
        "any; any of; any one of; any single; some; some of; one of; at least one; at least one of; either; either of; "
        "either one of"
    ),
    Quantifier.ALL: (
        "all; all of; every; every one of; every single; every single one of; each; each of; each one of; both; both of"
    ),
}
_PRONOUNS = {
    Quantifier.ANY: "anything; something; any thing; at least one thing",
    Quantifier.ALL: "everything; every thing; all things; what is; whats; whatever is",
}


@dataclass(frozen=True, slots=True)
class Said:
    """A phrase taken apart: how many are meant, the words that say so, and those that say of what.

    `number` is of how many things the phrase takes there to be: 2 for "both boxes".
    """

    quantifier: Quantifier
    before: Words
    rest: Words
    number: int | None = None


def _listed(sayings: dict[Quantifier, str], follows: Words) -> list[tuple[Words, Quantifier, Words]]:
    return [
        (tuple(said.split()), quantifier, follows) for quantifier, text in sayings.items() for said in text.split(";")
    ]


_OPENINGS = sorted([*_listed(_SAYINGS, ()), *_listed(_PRONOUNS, (WHATEVER,))], key=lambda opening: -len(opening[0]))
EXCEPTING = ("except for", "except", "but not", "but", "excluding", "apart from", "other than", "besides", "save for")
"""What stands before an exception; what is part of another one comes after it."""
_EXCEPT = tuple(tuple(saying.split()) for saying in EXCEPTING)
_FIRST = frozenset(opening[0] for opening, _, _ in _OPENINGS)
_BEFORE = frozenset(opening for opening, _, follows in _OPENINGS if not follows)
"""What stands before a phrase: all but the pronouns."""
_LAST = frozenset(opening[-1] for opening in _BEFORE)
_LENGTHS = sorted({len(opening) for opening in _BEFORE}, reverse=True)


def quantified(phrase: str) -> Said:
    """The phrase taken apart at its quantifier; without one, the words of a phrase for one thing."""
    said = words(phrase[:1_000])
    if said and said[0] in _FIRST:
        for opening, quantifier, follows in _OPENINGS:
            if said[: len(opening)] == opening and (follows or len(said) > len(opening)):
                rest, number = counted(said[len(opening) :])
                number = 2 if "both" in opening else number
                return Said(quantifier, opening, (*follows, *rest), number)
    return Said(Quantifier.ONE, (), spoken_words(phrase))


def excepted(said: Words) -> tuple[Words, Words]:
    """Words before and after one that makes an exception: "rooms", "hall" of "rooms except the hall"; all without."""
    for place in range(1, len(said) - 1):
        for saying in _EXCEPT:
            if said[place : place + len(saying)] == saying and (after := said[place + len(saying) :]):
                return said[:place], after
    return said, ()


def counted(said: Words) -> tuple[Words, int | None]:
    """Words without "the", "two" or "the two" in front, and the number that was said."""
    place, number = 0, None
    while place < len(said) - 1 and (said[place] in DETERMINERS or said[place] in _NUMBERS):
        number = _NUMBERS.get(said[place], number)
        place += 1
    return said[place:], number


def widened(said: Sequence[str], begin: int) -> int:
    """Where the phrase that begins at a place of a text begins with its quantifier: at "any" in "grab any of the toys",
    where the phrase found is "toys". "First of all the toys" has none.
    """
    place = begin
    while place > 0:
        last = said[place - 1]
        for length in _LENGTHS if last in _LAST else ():
            start = place - length
            if start >= 0 and tuple(said[start:place]) in _BEFORE:
                of_all = length == 1 and last == "all" and start > 0 and said[start - 1] in ("of", "above", "after")
                return begin if of_all else start
        if last not in DETERMINERS and last not in _NUMBERS:
            break
        place -= 1
    return begin


def with_values(phrase: str, values: Sequence[str]) -> str:
    """The phrase with attribute values said of it too: "any red toy" of "any toy", "everything red" of "everything"."""
    said = quantified(phrase)
    if said.quantifier is Quantifier.ONE:
        return " ".join([*values, phrase])
    return " ".join([*said.before, *values, *(word for word in said.rest if word != WHATEVER)])
