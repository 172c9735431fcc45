"""What a command may have left out, as readings that fill the gap."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import replace

from models.language.teaching import Gap, ends_open
from models.queries import ContextualQuery
from models.world import Environment
from service.filling import MAX_CHOICES, reread, things_for
from service.taught import Taught
from service.understanding import Understanding


def says_too_little(text: str, found: Sequence[Understanding]) -> bool:
    """Whether a text, as it was understood if at all, may leave something out."""
    return not found or (found[0].meaning is None and ends_open(text))


def completions(taught: Taught, text: str, environment: Environment) -> tuple[Understanding, ...]:
    """The readings of a command that says a task but for one argument, with each of the things that make sense there,
    equally probable; none where these are too many to ask.

    Raises:
        TextTooLongError: the text is beyond the limits of a command.
    """
    queries = dict.fromkeys(query for gap in taught.gaps(text) for query in _filled(gap, taught, environment))
    readings = [reread(text, Understanding(query, 1.0, None, None), taught, environment) for query in queries]
    sensible = [reading for reading in readings if reading.meaning is not None]
    if not 0 < len(sensible) <= MAX_CHOICES:
        return ()
    return tuple(replace(reading, confidence=1 / len(sensible)) for reading in sensible)


def _filled(gap: Gap, taught: Taught, environment: Environment) -> Iterator[ContextualQuery]:
    template = taught.template(gap.task)
    missing = gap.arguments.index(None)
    if template is None or template.arity != len(gap.arguments):
        return
    for symbol in things_for(template, missing + 1, environment):
        yield ContextualQuery(gap.task, tuple(symbol.name if each is None else each for each in gap.arguments))
