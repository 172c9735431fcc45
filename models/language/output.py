"""The output language of the network: `ship ( cylinder , box , living room )`, one word or bracket at a time."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from models.language.tokens import find, words
from models.language.vocabulary import END, NO_TASK
from models.queries import ContextualQuery, QuerySyntaxError

OPEN, COMMA, CLOSE = "(", ",", ")"
_MARKS = frozenset({OPEN, COMMA, CLOSE, NO_TASK, END})


def spell(query: ContextualQuery | None) -> tuple[str, ...]:
    """A query as output words, `END` last; None is the text that no task fits."""
    if query is None:
        return (NO_TASK, END)
    spelled = [query.task, OPEN]
    for index, phrase in enumerate(query.arguments):
        spelled += [COMMA] * (index > 0) + list(words(phrase))
    return (*spelled, CLOSE, END)


def read(spelled: Sequence[str], arities: Mapping[str, int]) -> ContextualQuery | None:
    """The query that output words spell, or None when they are malformed.

    Well-formed is: a known task, an opening bracket, as many non-empty arguments as the task takes with commas
    between, a closing bracket, the end. `arities` gives the known tasks and their numbers of arguments.
    """
    if len(spelled) < 4 or spelled[0] not in arities or spelled[1] != OPEN or tuple(spelled[-2:]) != (CLOSE, END):
        return None
    arguments: list[list[str]] = [[]]
    for word in spelled[2:-2]:
        if word == COMMA:
            arguments.append([])
        elif word in _MARKS:
            return None
        else:
            arguments[-1].append(word)
    if len(arguments) != arities[spelled[0]] or not all(arguments):
        return None
    try:
        return ContextualQuery(spelled[0], tuple(" ".join(argument) for argument in arguments))
    except QuerySyntaxError:  # longer than a query may be: one word can be as long as a text
        return None


def is_spoken(query: ContextualQuery, text: Sequence[str]) -> bool:
    """Whether every argument is a phrase of the text: its words stand there together, in order."""
    return all(find(phrase.split(), text) is not None for phrase in query.arguments)
