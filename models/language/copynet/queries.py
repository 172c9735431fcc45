"""The output language of CQ-CopyNet: `ship ( cylinder , box , living room )`, one word or bracket at a time."""

from __future__ import annotations

from collections.abc import Sequence

from models.language.copynet.vocabulary import END
from models.language.tokens import find, words
from models.queries import ContextualQuery, QuerySyntaxError

OPEN, COMMA, CLOSE = "(", ",", ")"
_MARKS = frozenset({OPEN, COMMA, CLOSE, END})


def spell_query(query: ContextualQuery) -> tuple[str, ...]:
    """A query as output words, `END` last."""
    spelled = [query.task, OPEN]
    for index, phrase in enumerate(query.arguments):
        spelled += [COMMA] * (index > 0) + list(words(phrase))
    return (*spelled, CLOSE, END)


def read_query(spelled: Sequence[str]) -> ContextualQuery | None:
    """The query that output words spell, or None when they are malformed.

    Well-formed is: a task, an opening bracket, non-empty arguments with commas between, a closing bracket, the end.
    Neither the task nor the number of arguments need be one that there is: that is a wrong answer, not a malformed one.
    """
    if len(spelled) < 4 or spelled[0] in _MARKS or spelled[1] != OPEN or tuple(spelled[-2:]) != (CLOSE, END):
        return None
    arguments: list[list[str]] = [[]]
    for word in spelled[2:-2]:
        if word == COMMA:
            arguments.append([])
        elif word in _MARKS:
            return None
        else:
            arguments[-1].append(word)
    if not all(arguments):
        return None
    return query_or_none(spelled[0], [" ".join(argument) for argument in arguments])


def query_or_none(task: str, arguments: Sequence[str]) -> ContextualQuery | None:
    """The query, or None when the language of queries has no such task name, or the query is too long for it."""
    try:
        return ContextualQuery(task, tuple(arguments))
    except QuerySyntaxError:  # a copied word in the place of the task, or one word as long as a text
        return None


def is_spoken(query: ContextualQuery, text: Sequence[str]) -> bool:
    """Whether every argument is a phrase of the text: its words stand there together, in order."""
    return all(find(phrase.split(), text) is not None for phrase in query.arguments)
