"""Reading formulas: text to AST, by the grammar in `ltl.lark`, without recursion and within limits.

The LALR parser builds formulas as it reduces, so a text is refused at the first node that breaks a limit and no
parse tree exists whose depth could matter.
"""

from __future__ import annotations

from collections import deque
from collections.abc import Callable
from dataclasses import dataclass, field
from functools import lru_cache
from importlib.resources import files
from typing import TypeVar

from lark import Lark, Token, Transformer, v_args
from lark.exceptions import UnexpectedInput

from models.logic.dialect import Dialect
from models.logic.errors import FormulaSyntaxError, FormulaTooLargeError, InvalidNameError
from models.logic.formula import (
    FALSE,
    MAX_DEPTH,
    MAX_SIZE,
    TRUE,
    Atom,
    Binary,
    Formula,
    Name,
    Op,
    Parameter,
    Term,
    Unary,
    nary,
)
from models.logic.names import from_token
from models.logic.syntax import Reading, complain, refuse

T = TypeVar("T")

MAX_TEXT = 65_536
"""Longest text of a formula, in characters."""
MAX_PARAMETER = 9_999
"""Highest position that a parameter may name."""


def parse(text: str, *, dialect: Dialect | None = None) -> Formula:
    """The formula that `text` spells.

    Without `dialect` it is recognised. `prefix` reads prefix notation only; every other dialect reads the spellings
    of all of them, mixed if need be, for they do not clash: the dialect decides how a formula is printed.

    Raises FormulaSyntaxError with the place, or FormulaTooLargeError for a text, a nesting or a size beyond a limit.
    """
    if len(text) > MAX_TEXT:
        raise FormulaTooLargeError(f"the formula has {len(text)} characters; at most {MAX_TEXT} are read")
    if dialect is Dialect.PREFIX:
        return _read(text, "prefix")
    try:
        return _read(text, "infix")
    except FormulaSyntaxError as infix_error:
        if dialect is not None:
            raise
        # No text has two readings: up to its first binary operator a prefix text holds only unary ones, and there
        # infix needs an operand. So the order of the attempts decides nothing but which error is reported.
        try:
            return _read(text, "prefix")
        except FormulaSyntaxError as prefix_error:
            further = (prefix_error.line, prefix_error.column) > (infix_error.line, infix_error.column)
            raise (prefix_error if further else infix_error) from None


def _read(text: str, start: str) -> Formula:
    cursor = _lark().parse_interactive(text, start=start)
    reading = Reading(text, prefix=start == "prefix")
    try:
        for token in cursor.iter_parse():  # yields each token before the parser takes it
            reading.take(token)
            if len(reading.open_brackets) > MAX_DEPTH + 1:  # the arguments of the innermost atom are one more
                raise FormulaTooLargeError(f"parentheses are nested more than {MAX_DEPTH} deep")
        result: _Part = cursor.feed_eof(reading.last)  # type: ignore[no-untyped-call]
    except UnexpectedInput as error:
        complain(reading, error)
    except _BadName as error:
        refuse(text, error.token.start_pos or 0, str(error))
    return _close(result)


class _BadName(Exception):
    """A name or parameter that the lexer takes and the AST does not."""

    def __init__(self, token: Token, detail: str) -> None:
        super().__init__(detail)
        self.token = token


@dataclass(slots=True)
class _Chain:
    """Operands of `&` or `|` still being gathered, so that a long chain is flattened in linear time."""

    op: Op
    operands: deque[Formula] = field(default_factory=deque)

    def add(self, part: _Part, *, left: bool = False) -> None:
        new = part.operands if isinstance(part, _Chain) and part.op is self.op else (_close(part),)
        if len(self.operands) + len(new) >= MAX_SIZE:
            raise FormulaTooLargeError(f"the formula has more than {MAX_SIZE} operators and atoms")
        if left:
            self.operands.extendleft(reversed(new))
        else:
            self.operands.extend(new)


_Part = Formula | _Chain


def _close(part: _Part) -> Formula:
    return nary(part.op, *part.operands) if isinstance(part, _Chain) else part


def _chain(op: Op, left: _Part, right: _Part) -> _Chain:
    """Join two parts, in the longer one's place where that is a chain of the same operator."""
    if isinstance(left, _Chain) and left.op is op:
        if isinstance(right, _Chain) and right.op is op and len(right.operands) > len(left.operands):
            right.add(left, left=True)
            return right
        left.add(right)
        return left
    if isinstance(right, _Chain) and right.op is op:
        right.add(left, left=True)
        return right
    chain = _Chain(op)
    chain.add(left)
    chain.add(right)
    return chain


def _guarded(token: Token, make: Callable[[], T]) -> T:
    try:
        return make()
    except InvalidNameError as error:
        raise _BadName(token, error.detail) from None


@v_args(inline=True)
class _Builder(Transformer[Token, Formula]):
    """Makes formulas of what the grammar reduces; a part that may still grow is a `_Chain`."""

    def binary(self, left: _Part, op: Token, right: _Part) -> Formula:
        return Binary(Op[op.type], _close(left), _close(right))

    def prefix_binary(self, op: Token, left: _Part, right: _Part) -> Formula:
        return Binary(Op[op.type], _close(left), _close(right))

    def chain(self, left: _Part, op: Token, right: _Part) -> _Chain:
        return _chain(Op[op.type], left, right)

    def prefix_chain(self, op: Token, left: _Part, right: _Part) -> _Chain:
        return _chain(Op[op.type], left, right)

    def unary(self, op: Token, operand: _Part) -> Formula:
        return Unary(Op[op.type], _close(operand))

    def group(self, inner: _Part) -> Formula:
        return _close(inner)

    def true(self, _: Token) -> Formula:
        return TRUE

    def false(self, _: Token) -> Formula:
        return FALSE

    def atom(self, function: Token, arguments: tuple[Term, ...] = ()) -> Formula:
        return _guarded(function, lambda: Atom(from_token(function.type, function), arguments))

    def function(self, token: Token) -> Token:
        return token

    def arguments(self, *terms: Term) -> tuple[Term, ...]:
        return terms

    def name(self, token: Token) -> Term:
        return _guarded(token, lambda: Name(from_token(token.type, token)))

    def parameter(self, token: Token) -> Term:
        digits = token.lstrip("\\$").lstrip("0")
        if len(digits) > len(str(MAX_PARAMETER)):
            raise _BadName(token, f"parameters are counted from $1 to ${MAX_PARAMETER}")
        return _guarded(token, lambda: Parameter(int(digits or "0")))


@lru_cache(maxsize=1)
def _lark() -> Lark:
    grammar = files(__package__).joinpath("ltl.lark").read_text(encoding="utf-8")
    return Lark(grammar, parser="lalr", lexer="contextual", start=["infix", "prefix"], transformer=_Builder())
