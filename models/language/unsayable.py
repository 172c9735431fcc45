"""What commands say and queries cannot: how often, how long, and under which condition.

"Visit the museum twice", "stay there for ten minutes", "close the door if it is raining": a translator that understands
the rest must not pass over it. Politeness is no condition: "if it is no trouble".
"""

from __future__ import annotations

import re
from collections.abc import Iterator

from models.language.tokens import is_mark, marked_words, words
from models.queries import Composition, Operator, Query

_NUMBER = r"(?:two|three|four|five|six|seven|eight|nine|ten|twelve|twenty|thirty|several|a few|a couple of|\d+)"
_UNIT = r"(?:seconds?|minutes?|hours?|days?|weeks?)"
_MEASURE = re.compile(rf"\b(?:twice|thrice|{_NUMBER} (?:more )?times|(?:for|in|within|after) {_NUMBER} {_UNIT})\b")
_IF = frozenset({"if", "unless"})
_IS = frozenset({"is", "are", "was", "were", "isn't", "aren't", "has", "have", "hasn't", "gets", "becomes", "rains"})
_ASKING = frozenset({"see", "ask", "check", "know", "wonder", "tell", "as"})
"""Words after which "if" states no condition: "to see if it is raining"."""
_LONGEST_SUBJECT = 4
_LONGEST_CONDITION = 8
_WHOEVER = frozenset({"you", "i", "we", "that", "this", "there", "what", "not", "anything", "nothing", "everything"})
"""What polite conditions, and those that only tell of a choice, are about: "if that is easier"."""
_POLITE = frozenset({"no", "not", "too", "possible", "ok", "okay", "fine", "all", "alright", "convenient", "easier"})
"""How things are, for it to be polite to say so: "if it is no trouble"."""
_ELSE = frozenset({"else", "otherwise", "instead", "or"})
"""Words with which a condition is a choice: "the zoo if it is open, else the park"."""


def unsayable(text: str, query: Query) -> str | None:
    """The first words of a command that say how often, how long or under which condition, unless they are in a name
    that the query speaks of; None without any.

    Raises:
        TextTooLongError: the text is beyond the limits of a command.
    """
    names = [f" {phrase} " for _, task in query.tasks for phrase in task.arguments]
    measures = [found[0] for found in _MEASURE.finditer(" ".join(words(text)))]
    chosen = isinstance(query, Composition) and query.operator is Operator.OR and not _ELSE.isdisjoint(words(text))
    found = (*measures, *(() if chosen else _conditions(marked_words(text))))
    return next((said for said in found if not any(f" {said} " in name for name in names)), None)


def _conditions(said: tuple[str, ...]) -> Iterator[str]:
    for at, word in enumerate(said):
        if word in _IF and (at == 0 or said[at - 1] not in _ASKING):
            marks = (place for place in range(at, len(said)) if is_mark(said[place]))
            clause = said[at + 1 : min(next(marks, len(said)), at + _LONGEST_CONDITION)]
            if _is_condition([part for each in clause for part in each.replace("it's", "it is").split()]):
                yield " ".join((word, *clause))


def _is_condition(clause: list[str]) -> bool:
    """Whether a clause says how something is, and not politely."""
    verb = next((place for place, word in enumerate(clause[: _LONGEST_SUBJECT + 1]) if word in _IS), 0)
    if verb == 0 or clause[0] in _WHOEVER:
        return False
    return clause[:verb] != ["it"] or clause[verb] == "rains" or (clause[verb + 1 :] or ["no"])[0] not in _POLITE
