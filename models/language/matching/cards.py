"""The card of a task: what it is called and what it brings about, which tells what it is for without any example."""

from __future__ import annotations

from contextlib import suppress

from models.language.errors import TextTooLongError
from models.language.teaching import ExampleArgumentNotFoundError, ExampleMarkError, Utterance
from models.queries import ContextualQuery


def cards_of(query: ContextualQuery, says: str) -> tuple[Utterance, ...]:
    """The texts of a card, said of the things of one query of the task.

    Args:
        says: what the task brings about in English, with slots such as `{1}` for its arguments; what has not all of
            them, or is empty, is left out.
    """
    slots = " ".join(f"{{{position}}}" for position in range(1, len(query.arguments) + 1))
    found = []
    for text in (says, f"{query.task.replace('_', ' ')} {slots}"):
        with suppress(ExampleArgumentNotFoundError, ExampleMarkError, TextTooLongError):
            utterance = Utterance.of(text, query)
            if utterance.words:
                found.append(utterance)
    return tuple(found)
