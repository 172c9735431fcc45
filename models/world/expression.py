"""The abstract syntax of expressions, and the reader of their text.

Expressions are bounded: text length and nesting are limited while reading, so recursion over them is safe.
"""

from __future__ import annotations

from dataclasses import dataclass
from enum import StrEnum
from functools import lru_cache
from math import isfinite
from pathlib import Path
from typing import TypeVar

from lark import Lark, Token, Transformer, UnexpectedInput, v_args
from lark.exceptions import VisitError

from models.world.hints import syntax_hint
from models.world.limits import MAX_NESTING, MAX_TEXT


class ExpressionError(Exception):
    """A fault of one expression; whoever knows its place in the data turns it into a WorldError."""


class Quantifier(StrEnum):
    """Ranges over the objects or values of some kinds."""

    ANY = "any"
    ALL = "all"
    COUNT = "count"


@dataclass(frozen=True, slots=True)
class Number:
    """`0.5`."""

    value: float


@dataclass(frozen=True, slots=True)
class Truth:
    """`true` or `false`."""

    value: bool


@dataclass(frozen=True, slots=True)
class Nothing:
    """`none`."""


@dataclass(frozen=True, slots=True)
class Variable:
    """A name: an argument, a quantified variable, a constant, a parameter or an attribute value."""

    name: str


@dataclass(frozen=True, slots=True)
class Access:
    """`base.attribute`."""

    base: Expression
    attribute: str


@dataclass(frozen=True, slots=True)
class Call:
    """`name(argument, ...)`: a definition or propositional function."""

    name: str
    arguments: tuple[Expression, ...]


@dataclass(frozen=True, slots=True)
class Not:
    """`not operand`."""

    operand: Expression


@dataclass(frozen=True, slots=True)
class Connective:
    """`a and b and ...` or `a or b or ...`."""

    conjunctive: bool
    operands: tuple[Expression, ...]


@dataclass(frozen=True, slots=True)
class Compare:
    """`left == right`, and the other comparisons."""

    operator: str
    left: Expression
    right: Expression


@dataclass(frozen=True, slots=True)
class Is:
    """`operand is kind | kind`."""

    operand: Expression
    kinds: tuple[str, ...]


@dataclass(frozen=True, slots=True)
class Arithmetic:
    """`left + right`, `-`, `*`, `/`."""

    operator: str
    left: Expression
    right: Expression


@dataclass(frozen=True, slots=True)
class Conditional:
    """`then if condition else otherwise`."""

    then: Expression
    condition: Expression
    otherwise: Expression


@dataclass(frozen=True, slots=True)
class Quantified:
    """`any(variable: kinds; body)`, `all(...)` or `count(...)`."""

    quantifier: Quantifier
    variable: str
    kinds: tuple[str, ...]
    body: Expression


Expression = (
    Number | Truth | Nothing | Variable | Access | Call | Not | Connective | Compare | Is | Arithmetic |
    Conditional | Quantified )  # fmt: skip

_Node = TypeVar("_Node", bound=Expression)


@dataclass(frozen=True, slots=True)
class _Measured:
    """An expression while it is read, with its nesting."""

    node: Expression
    depth: int


def _wrap(node: Expression, *parts: _Measured) -> _Measured:
    depth = 1 + max((part.depth for part in parts), default=0)
    if depth > MAX_NESTING:
        raise ExpressionError(f"the expression is nested more than {MAX_NESTING} deep")
    return _Measured(node, depth)


@v_args(inline=True)
class _Builder(Transformer[Token, _Measured]):
    """Builds nodes while the parser reduces, so nothing recurses over the input."""

    def conditional(self, then: _Measured, condition: _Measured, otherwise: _Measured) -> _Measured:
        return _wrap(Conditional(then.node, condition.node, otherwise.node), then, condition, otherwise)

    def implies(self, left: _Measured, right: _Measured) -> _Measured:
        return _wrap(Connective(False, (Not(left.node), right.node)), left, right)

    def disjunction(self, *operands: _Measured) -> _Measured:
        return _wrap(Connective(False, tuple(o.node for o in operands)), *operands)

    def conjunction(self, *operands: _Measured) -> _Measured:
        return _wrap(Connective(True, tuple(o.node for o in operands)), *operands)

    def negate(self, operand: _Measured) -> _Measured:
        return _wrap(Not(operand.node), operand)

    def compare(self, left: _Measured, operator: Token, right: _Measured) -> _Measured:
        return _wrap(Compare(str(operator), left.node, right.node), left, right)

    def is_of(self, operand: _Measured, kinds: tuple[str, ...]) -> _Measured:
        return _wrap(Is(operand.node, kinds), operand)

    def is_not_of(self, operand: _Measured, kinds: tuple[str, ...]) -> _Measured:
        return _wrap(Not(Is(operand.node, kinds)), operand)

    def arithmetic(self, left: _Measured, operator: Token, right: _Measured) -> _Measured:
        return _wrap(Arithmetic(str(operator), left.node, right.node), left, right)

    def minus(self, operand: _Measured) -> _Measured:
        return _wrap(Arithmetic("-", Number(0.0), operand.node), operand)

    def access(self, base: _Measured, attribute: Token) -> _Measured:
        return _wrap(Access(base.node, str(attribute)), base)

    def number(self, text: Token) -> _Measured:
        if not isfinite(float(text)):
            raise ExpressionError(f"the number {text} is too large")
        return _wrap(Number(float(text)))

    def true(self) -> _Measured:
        return _wrap(Truth(True))

    def false(self) -> _Measured:
        return _wrap(Truth(False))

    def none(self) -> _Measured:
        return _wrap(Nothing())

    def name(self, name: Token) -> _Measured:
        return _wrap(Variable(str(name)))

    def text(self, text: Token) -> _Measured:
        return _wrap(Variable(str(text)[1:-1]))

    def call(self, name: Token, *arguments: _Measured | None) -> _Measured:
        given = [argument for argument in arguments if argument is not None]
        return _wrap(Call(str(name), tuple(a.node for a in given)), *given)

    def quantified(self, word: Token, variable: Token, kinds: tuple[str, ...], body: _Measured) -> _Measured:
        quantifier = Quantifier(str(word).rstrip("( \t\r\n"))
        return _wrap(Quantified(quantifier, str(variable), kinds, body.node), body)

    def kinds(self, *names: Token) -> tuple[str, ...]:
        return tuple(str(name) for name in names)


@lru_cache(maxsize=1)
def _parser() -> Lark:
    grammar = Path(__file__).with_name("oomdp.lark").read_text(encoding="utf-8")
    return Lark(grammar, parser="lalr", lexer="contextual", transformer=_Builder())


@lru_cache(maxsize=4_096)
def parse_expression(text: str) -> Expression:
    """The expression that `text` spells. Raises ExpressionError, naming the place of a syntax error."""
    if len(text) > MAX_TEXT:
        raise ExpressionError(f"the expression is longer than {MAX_TEXT} characters")
    try:
        result: object = _parser().parse(text)
    except UnexpectedInput as error:
        if _at_end(error):
            raise ExpressionError("the expression ends too early") from None
        position: object = getattr(error, "pos_in_stream", None)
        start = position if isinstance(position, int) else 0
        excerpt = f"{text[start : start + 20]!r}{syntax_hint(text, start)}"
        raise ExpressionError(f"cannot read the expression at character {start + 1}: {excerpt}") from None
    except VisitError as error:
        if isinstance(error.orig_exc, ExpressionError):
            raise error.orig_exc from None
        raise
    assert isinstance(result, _Measured)
    return result.node


def _at_end(error: UnexpectedInput) -> bool:
    token = getattr(error, "token", None)
    return isinstance(token, Token) and token.type == "$END"
