"""The text form of contextual queries and of their compositions."""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import dataclass
from functools import cache
from importlib.resources import files

from lark import Lark, Token, Transformer
from lark.exceptions import UnexpectedCharacters, UnexpectedInput, UnexpectedToken, VisitError

from models.queries.contextual_query import (
    MAX_NESTING,
    MAX_QUERY_TEXT,
    OPERATORS,
    Composition,
    ContextualQuery,
    Operator,
    Query,
)
from models.queries.errors import QuerySyntaxError
from models.source import locate, quoted


def parse_query(text: str) -> Query:
    """Read the text form.

    The parts of an operator are queries, those of a task are phrases. Bare phrases lose surrounding white space and
    hold single spaces; a phrase with `,`, `(`, `)`, `"` or odd spacing is quoted, with `\\"` and `\\\\` as escapes.

    Raises:
        QuerySyntaxError: with line, column and caret.
    """
    if len(text) > MAX_QUERY_TEXT:
        raise QuerySyntaxError(f"a contextual query is at most {MAX_QUERY_TEXT} characters long, not {len(text)}")
    _check_nesting(text)
    try:
        return _Reader(text).transform(_grammar().parse(text))
    except VisitError as error:
        if isinstance(error.orig_exc, QuerySyntaxError):
            raise error.orig_exc from None
        raise
    except UnexpectedInput as error:
        raise _syntax_error(text, error) from None


def parse_task(text: str) -> ContextualQuery:
    """Read the text form of a query that is not composed.

    Raises:
        QuerySyntaxError: also for a composition.
    """
    query = parse_query(text)
    if isinstance(query, Composition):
        raise _at(text, 0, f"{query.operator.value}(...) puts tasks together; what is taught is one task")
    return query


@dataclass(frozen=True, slots=True)
class _Phrase:
    """An argument and where it begins."""

    text: str
    offset: int


@dataclass(frozen=True, slots=True)
class _Part:
    """A query within another; where it begins, and where its parenthesis."""

    query: Query
    offset: int
    opens: int


class _Reader(Transformer[Token, Query]):
    def __init__(self, text: str) -> None:
        super().__init__()
        self._text = text

    def query(self, items: Sequence[Token | _Phrase | _Part | None]) -> Query:
        name, *parts = items
        assert isinstance(name, Token)
        return self._made(str(name), name.start_pos or 0, [part for part in parts if part is not None])

    def nested(self, items: Sequence[Token | _Phrase | _Part | None]) -> _Part:
        name, *parts = items
        assert isinstance(name, Token)
        begin = name.start_pos or 0
        made = self._made(str(name), begin, [part for part in parts if part is not None])
        return _Part(made, begin, self._text.index("(", begin + len(name)))

    def quoted(self, items: list[Token]) -> _Phrase:
        return _Phrase(re.sub(r"\\(.)", r"\1", items[0][1:-1]), items[0].start_pos or 0)

    def bare(self, items: list[Token]) -> _Phrase:
        return _Phrase(" ".join(items[0].split()), items[0].start_pos or 0)

    def _made(self, name: str, begin: int, parts: Sequence[Token | _Phrase | _Part]) -> Query:
        """The query; a fault is at its name, or at the part that is wrong."""
        try:
            if name in OPERATORS:
                return Composition(Operator(name), tuple(self._operand(name, part) for part in parts))
            return ContextualQuery(name, tuple(self._argument(part) for part in parts))
        except QuerySyntaxError as error:
            if error.caret:
                raise
            raise _at(self._text, begin, error.detail) from None

    def _operand(self, name: str, part: Token | _Phrase | _Part) -> Query:
        if isinstance(part, _Part):
            return part.query
        assert isinstance(part, _Phrase)
        raise _at(self._text, part.offset, f"the operands of {name} are queries such as pickup(ball), not phrases")

    def _argument(self, part: Token | _Phrase | _Part) -> str:
        if isinstance(part, _Phrase):
            return part.text
        assert isinstance(part, _Part)
        operators = ", ".join(operator.value for operator in Operator)
        raise _at(self._text, part.opens, f"the arguments of a task are phrases; only {operators} take queries")


@cache
def _grammar() -> Lark:
    text = (files("models.queries") / "query.lark").read_text(encoding="utf-8")
    return Lark(text, start="query", parser="lalr", maybe_placeholders=True)


def _check_nesting(text: str) -> None:
    """Refuse what is nested too deep before anything recurses over it."""
    depth = 0
    for offset, sign in enumerate(re.sub(r'"(?:[^"\\]|\\.)*"', lambda found: "_" * len(found[0]), text)):
        depth += (sign == "(") - (sign == ")")
        if depth > MAX_NESTING:
            raise _at(text, offset, f"a composed query is at most {MAX_NESTING} parts deep")


def _syntax_error(text: str, error: UnexpectedInput) -> QuerySyntaxError:
    offset: int = getattr(error, "pos_in_stream", None) or 0
    if isinstance(error, UnexpectedToken) and error.token.type == "$END":
        offset = len(text)
    found = quoted(text[offset]) if offset < len(text) else "the end"
    hint = "; a quotation mark is not closed" if isinstance(error, UnexpectedCharacters) and found == '`"`' else ""
    return _at(text, offset, f"expected a contextual query such as ship(cylinder, box, bedroom), found {found}{hint}")


def _at(text: str, offset: int, detail: str) -> QuerySyntaxError:
    at = locate(text, offset)
    detail = f"line {at.line}, column {at.column}: {detail}"
    return QuerySyntaxError(detail, line=at.line, column=at.column, caret=at.caret)
