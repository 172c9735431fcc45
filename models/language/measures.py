"""How often and how long: "twice", "for ten minutes". No query says such a thing, so it must not be passed over."""

from __future__ import annotations

import re

from models.language.tokens import words
from models.queries import Query

_NUMBER = r"(?:two|three|four|five|six|seven|eight|nine|ten|twelve|twenty|thirty|several|a few|a couple of|\d+)"
_UNIT = r"(?:seconds?|minutes?|hours?|days?|weeks?)"
_MEASURE = re.compile(
    rf"\b(?:twice|thrice|{_NUMBER} (?:more )?times|(?:for|in|within|after) (?:{_NUMBER}|half an|an) {_UNIT})\b"
)


def measure(text: str, query: Query) -> str | None:
    """The first words of a command that say how often or how long, unless they are in a name that the query speaks of;
    None without any.

    Raises:
        TextTooLongError: the text is beyond the limits of a command.
    """
    names = [f" {phrase} " for _, task in query.tasks for phrase in task.arguments]
    for found in _MEASURE.finditer(" ".join(words(text))):
        if not any(f" {found[0]} " in name for name in names):
            return found[0]
    return None
