"""Contextual queries (paper, § Contextual Queries): a task name with ordered arguments, which are phrases.

Queries compose (`Composition`), which the paper leaves for later: `then(pickup(ball), move_to(hall))`. The text form is
read in `models.queries.query_text`.
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import dataclass
from enum import StrEnum

from models.queries.errors import QuerySyntaxError
from models.source import quoted

MAX_QUERY_TEXT = 4_096
"""Longest text of a contextual query, in characters."""
MAX_TASK = 100
"""Longest name of a task, in characters."""
MAX_ARGUMENTS = 16
"""Most arguments of a contextual query."""

MAX_PARTS = 32
"""Most tasks and operators of a composed query together."""
MAX_NESTING = 10
"""Longest path from the root of a composed query to a task, in parts."""

_NAME = re.compile(r"[^\W\d]\w*")
_BARE = re.compile(r'[^,()"\s](?:[^,()"]*[^,()"\s])?')


class Operator(StrEnum):
    """What puts queries together; `models.queries.meaning` says what each means."""

    THEN = "then"
    AND = "and"
    OR = "or"
    AVOID = "avoid"
    UNTIL = "until"
    WITHOUT = "without"
    REPEAT = "repeat"

    @property
    def takes(self) -> tuple[int, int | None]:
        """How many operands at least and at most."""
        match self:
            case Operator.AVOID | Operator.REPEAT:
                return 1, 1
            case Operator.UNTIL | Operator.WITHOUT:
                return 2, 2
            case _:
                return 2, None


OPERATORS = frozenset(operator.value for operator in Operator)


@dataclass(frozen=True, slots=True)
class ContextualQuery:
    """A task class applied to phrases: `ship(cylinder, box, bedroom)`.

    Raises `QuerySyntaxError` when the task is not a name, or an argument is empty or not printable.
    """

    task: str
    arguments: tuple[str, ...] = ()

    def __post_init__(self) -> None:
        if not _NAME.fullmatch(self.task):
            raise QuerySyntaxError(f"the task {quoted(self.task)} is not a name (letters, digits and _)")
        if self.task in OPERATORS:
            raise QuerySyntaxError(f"{self.task} puts queries together, and is no task")
        if len(self.task) > MAX_TASK:
            raise QuerySyntaxError(f"the name of a task has at most {MAX_TASK} characters")
        if len(self.arguments) > MAX_ARGUMENTS:
            raise QuerySyntaxError(f"a contextual query has at most {MAX_ARGUMENTS} arguments")
        for position, phrase in enumerate(self.arguments, start=1):
            if not phrase.strip() or not phrase.isprintable():
                raise QuerySyntaxError(f"argument {position} is empty or holds control characters")
        if len(str(self)) > MAX_QUERY_TEXT:
            raise QuerySyntaxError(f"a contextual query is at most {MAX_QUERY_TEXT} characters long")

    def __str__(self) -> str:
        """The text form; `parse_query` reads it back to an equal query."""
        return f"{self.task}({', '.join(_print_phrase(phrase) for phrase in self.arguments)})"

    @property
    def tasks(self) -> Iterator[tuple[tuple[int, ...], ContextualQuery]]:
        """Itself, as the only task of a query that is not composed."""
        yield (), self


@dataclass(frozen=True, slots=True)
class Composition:
    """Queries put together: `then(pickup(ball), move_to(hall))`.

    Raises `QuerySyntaxError` for a number of operands that the operator does not take, and beyond the limits.
    """

    operator: Operator
    operands: tuple[Query, ...]

    def __post_init__(self) -> None:
        least, most = self.operator.takes
        if len(self.operands) < least or (most is not None and len(self.operands) > most):
            wanted = f"{least} or more" if most is None else str(least)
            plural = "s" if most != 1 else ""
            found = len(self.operands)
            raise QuerySyntaxError(f"{self.operator.value} takes {wanted} operand{plural}, not {found}")
        if _parts(self) > MAX_PARTS:
            raise QuerySyntaxError(f"a composed query has at most {MAX_PARTS} parts")
        if _depth(self) > MAX_NESTING:
            raise QuerySyntaxError(f"a composed query is at most {MAX_NESTING} parts deep")
        if len(str(self)) > MAX_QUERY_TEXT:
            raise QuerySyntaxError(f"a contextual query is at most {MAX_QUERY_TEXT} characters long")

    def __str__(self) -> str:
        """The text form; `parse_query` reads it back to an equal query."""
        return f"{self.operator.value}({', '.join(map(str, self.operands))})"

    @property
    def tasks(self) -> Iterator[tuple[tuple[int, ...], ContextualQuery]]:
        """The tasks from left to right, each with its path: the places of the operands that lead to it."""
        for place, operand in enumerate(self.operands):
            for path, task in operand.tasks:
                yield (place, *path), task


Query = ContextualQuery | Composition


def _parts(query: Query) -> int:
    return 1 if isinstance(query, ContextualQuery) else 1 + sum(map(_parts, query.operands))


def _depth(query: Query) -> int:
    return 1 if isinstance(query, ContextualQuery) else 1 + max(map(_depth, query.operands))


def _print_phrase(phrase: str) -> str:
    if _BARE.fullmatch(phrase) and " ".join(phrase.split()) == phrase:
        return phrase
    return '"' + phrase.replace("\\", "\\\\").replace('"', '\\"') + '"'
