"""How readings are put together so that they cannot be misread: each knows where it may stand without parentheses."""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import dataclass
from enum import IntEnum


class Level(IntEnum):
    """What a reading is made of; a place in a larger one takes readings up to some level as they are."""

    CLAUSE = 0
    """One clause, or anything in parentheses: it may stand anywhere."""
    PREFIX = 1
    """Words such as "eventually" before a clause: they reach as far right as they can, up to a comma."""
    PHRASE = 2
    """It has commas of its own, such as "if a, then b": it reaches up to a semicolon."""
    LIST = 3
    """Several joined by "and" or "or"."""


@dataclass(frozen=True, slots=True)
class Said:
    """A reading. `pair` is the form of one of two clauses that shows where it ends: "both a and b"."""

    text: str
    level: Level
    pair: str | None = None

    def within(self, most: Level) -> str:
        """The text for a place that takes readings up to a level: in parentheses if it is of a higher one."""
        if self.level <= most:
            return self.text
        if self.pair is not None and most >= Level.PREFIX:
            return self.pair
        return f"({self.text})"


def joined(word: str, items: Sequence[Said]) -> Said:
    """Readings as a list with "and" or "or": the more there is in one of them, the stronger what separates them."""
    if len(items) == 1:
        return items[0]
    most = max(_as_item(item) for item in items)
    comma = {Level.CLAUSE: "", Level.PREFIX: ",", Level.PHRASE: ";"}[most]
    texts = [item.within(Level.PHRASE) for item in items]
    pair = None
    if len(items) == 2 and most is Level.CLAUSE:
        pair = f"{'both' if word == 'and' else 'either'} {texts[0]} {word} {texts[1]}"
    return Said(f"{comma} {word} ".join(texts), Level.LIST, pair)


def _as_item(item: Said) -> Level:
    if item.level is not Level.LIST:
        return item.level
    return Level.CLAUSE if item.pair is None else Level.PREFIX


_PLAIN = re.compile(r"[\w .&'-]+")
_JOINING = frozenset(
    {"and", "or", "nor", "not", "never", "always", "eventually", "until", "then", "if", "whenever", "while", "when"}
    | {"exactly", "both", "either", "again", "later", "before", "after", "ever", "step", "steps"}
)
"""Words by which readings are told apart; a name or reading of an environment that has one is set off."""


def joins(text: str) -> bool:
    """Whether a text has a word or sign by which readings are put together."""
    return not re.fullmatch(r"[^,;()\"]*", text) or not _JOINING.isdisjoint(re.findall(r"[^\W_]+", text.lower()))


def readable(name: str) -> str:
    """A name with spaces for underscores; in quotes if it could be taken for more than a name."""
    spaced = " ".join(name.replace("_", " ").split())
    return spaced if _PLAIN.fullmatch(spaced) and not joins(spaced) else f'"{name}"'
