"""Contextual queries (paper, § Contextual Queries): a task name with ordered arguments, which are phrases."""

from __future__ import annotations

import re
from dataclasses import dataclass
from functools import cache
from importlib.resources import files

from lark import Lark, Token, Transformer
from lark.exceptions import UnexpectedCharacters, UnexpectedInput, UnexpectedToken

from models.queries.errors import QuerySyntaxError
from models.source import locate, quoted

MAX_QUERY_TEXT = 4_096
"""Longest text of a contextual query, in characters."""
MAX_TASK = 100
"""Longest name of a task, in characters."""
MAX_ARGUMENTS = 16
"""Most arguments of a contextual query."""

_NAME = re.compile(r"[^\W\d]\w*")
_BARE = re.compile(r'[^,()"\s](?:[^,()"]*[^,()"\s])?')


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


def parse_query(text: str) -> ContextualQuery:
    """Read the text form.

    Bare phrases lose surrounding white space and hold single spaces; a phrase with `,`, `(`, `)`, `"` or odd
    spacing is quoted, with `\\"` and `\\\\` as escapes.

    Raises:
        QuerySyntaxError: with line, column and caret.
    """
    if len(text) > MAX_QUERY_TEXT:
        raise QuerySyntaxError(f"a contextual query is at most {MAX_QUERY_TEXT} characters long, not {len(text)}")
    try:
        task, arguments = _Reader().transform(_grammar().parse(text))
    except UnexpectedInput as error:
        raise _syntax_error(text, error) from None
    return ContextualQuery(task, arguments)


class _Reader(Transformer[Token, tuple[str, tuple[str, ...]]]):
    def query(self, items: list[str | None]) -> tuple[str, tuple[str, ...]]:
        task, *arguments = items
        return str(task), tuple(str(argument) for argument in arguments if argument is not None)

    def quoted(self, items: list[Token]) -> str:
        return re.sub(r"\\(.)", r"\1", items[0][1:-1])

    def bare(self, items: list[Token]) -> str:
        return " ".join(items[0].split())


@cache
def _grammar() -> Lark:
    text = (files("models.queries") / "query.lark").read_text(encoding="utf-8")
    return Lark(text, start="query", parser="lalr", maybe_placeholders=True)


def _print_phrase(phrase: str) -> str:
    if _BARE.fullmatch(phrase) and " ".join(phrase.split()) == phrase:
        return phrase
    return '"' + phrase.replace("\\", "\\\\").replace('"', '\\"') + '"'


def _syntax_error(text: str, error: UnexpectedInput) -> QuerySyntaxError:
    offset: int = getattr(error, "pos_in_stream", None) or 0
    if isinstance(error, UnexpectedToken) and error.token.type == "$END":
        offset = len(text)
    at = locate(text, offset)
    found = quoted(text[offset]) if offset < len(text) else "the end"
    detail = f"line {at.line}, column {at.column}: expected a contextual query such as ship(cylinder, box, bedroom)"
    hint = "; a quotation mark is not closed" if isinstance(error, UnexpectedCharacters) and found == '`"`' else ""
    return QuerySyntaxError(f"{detail}, found {found}{hint}", line=at.line, column=at.column, caret=at.caret)
