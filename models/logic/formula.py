"""The abstract syntax of LTL over propositional functions applied to terms.

Formulas are immutable, hashable and bounded: a node knows its depth and size, and building one beyond the limits
raises, whoever built it. Nothing here recurses over a formula, comparing, hashing, printing, pickling and copying
included, so no formula can overflow the stack of a thread that is already deep in calls.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from enum import StrEnum
from typing import TypeVar

from models.logic.errors import FormulaTooLargeError, InvalidNameError

MAX_DEPTH = 200
"""Longest path from the root to a leaf, in nodes."""
MAX_SIZE = 5_000
"""Most nodes in one formula."""

T = TypeVar("T")

# Control characters, line and paragraph separators, and halves of surrogate pairs, which no encoding can carry.
_UNPRINTABLE = re.compile("[\x00-\x1f\x7f-\x9f\u2028\u2029\ud800-\udfff]")


class Op(StrEnum):
    """An operator; the value is its infix spelling (Spot's)."""

    NOT = "!"
    NEXT = "X"
    FINALLY = "F"
    GLOBALLY = "G"
    AND = "&"
    OR = "|"
    IMPLIES = "->"
    IFF = "<->"
    UNTIL = "U"
    RELEASE = "R"
    WEAK_UNTIL = "W"
    STRONG_RELEASE = "M"


UNARY_OPS = frozenset({Op.NOT, Op.NEXT, Op.FINALLY, Op.GLOBALLY})
NARY_OPS = frozenset({Op.AND, Op.OR})
BINARY_OPS = frozenset(Op) - UNARY_OPS - NARY_OPS


def _check_name(text: str) -> None:
    """Refuse the names that could not be printed and read back on one line."""
    if not text:
        raise InvalidNameError("a name is empty")
    if _UNPRINTABLE.search(text):
        raise InvalidNameError("a name holds a control character or a line break")


@dataclass(frozen=True, slots=True)
class Name:
    """A term that names an object or an attribute value of an environment, or a variable of a lifted formula.

    Any text but the empty one and control characters, which raise InvalidNameError.
    """

    text: str

    def __post_init__(self) -> None:
        _check_name(self.text)


@dataclass(frozen=True, slots=True)
class Parameter:
    """A term that stands for the argument at a 1-based position of a contextual query: `$1`."""

    position: int

    def __post_init__(self) -> None:
        if self.position < 1:
            raise InvalidNameError("parameters are counted from $1")


Term = Name | Parameter


@dataclass(frozen=True, slots=True)
class Constant:
    """`true` or `false`."""

    value: bool
    depth: int = field(default=1, init=False, repr=False, compare=False)
    size: int = field(default=1, init=False, repr=False, compare=False)


@dataclass(frozen=True, slots=True)
class Atom:
    """A propositional function applied to terms; without arguments a nullary proposition, written `a`.

    The function's name obeys the rule of `Name`.
    """

    function: str
    arguments: tuple[Term, ...] = ()
    depth: int = field(default=1, init=False, repr=False, compare=False)
    size: int = field(default=1, init=False, repr=False, compare=False)

    def __post_init__(self) -> None:
        _check_name(self.function)


class _Compound:
    """What the inner nodes share: equality, hash, repr and pickling by the formula in Polish notation, in a loop.

    The hash is kept in the node; it differs from process to process, so pickling rebuilds instead of copying it.
    """

    __slots__ = ()
    digest: int

    def __eq__(self, other: object) -> bool:
        if self is other:
            return True
        if not isinstance(other, _Compound):
            return NotImplemented
        return self.digest == other.digest and _polish(self) == _polish(other)

    def __hash__(self) -> int:
        return self.digest

    def __repr__(self) -> str:
        return fold(self, _repr)  # type: ignore[arg-type]  # every _Compound is one of the three inner nodes

    def __reduce__(self) -> tuple[Callable[..., Formula], tuple[object, ...]]:
        return _from_polish, (_polish(self),)


@dataclass(frozen=True, slots=True, eq=False, repr=False)
class Unary(_Compound):
    """`!`, `X`, `F` or `G` applied to one formula."""

    op: Op
    operand: Formula
    depth: int = field(default=0, init=False)
    size: int = field(default=0, init=False)
    digest: int = field(default=0, init=False)

    def __post_init__(self) -> None:
        if self.op not in UNARY_OPS:
            raise ValueError(f"{self.op} does not take one operand")
        _measure(self, (self.operand,))


@dataclass(frozen=True, slots=True, eq=False, repr=False)
class Binary(_Compound):
    """`->`, `<->`, `U`, `R`, `W` or `M` applied to two formulas."""

    op: Op
    left: Formula
    right: Formula
    depth: int = field(default=0, init=False)
    size: int = field(default=0, init=False)
    digest: int = field(default=0, init=False)

    def __post_init__(self) -> None:
        if self.op not in BINARY_OPS:
            raise ValueError(f"{self.op} does not take two operands")
        _measure(self, (self.left, self.right))


@dataclass(frozen=True, slots=True, eq=False, repr=False)
class Nary(_Compound):
    """`&` or `|` over two or more formulas, none of which has the same operator at its root.

    Build one with `conjunction` or `disjunction`, which flatten; `a & (b & c)` and `(a & b) & c` are the same value.
    """

    op: Op
    operands: tuple[Formula, ...]
    depth: int = field(default=0, init=False)
    size: int = field(default=0, init=False)
    digest: int = field(default=0, init=False)

    def __post_init__(self) -> None:
        if self.op not in NARY_OPS:
            raise ValueError(f"{self.op} does not take a list of operands")
        if len(self.operands) < 2 or any(isinstance(o, Nary) and o.op is self.op for o in self.operands):
            raise ValueError(f"{self.op} needs two or more operands, flattened")
        _measure(self, self.operands)


Formula = Constant | Atom | Unary | Binary | Nary

TRUE = Constant(True)
FALSE = Constant(False)


def _measure(node: Unary | Binary | Nary, operands: tuple[Formula, ...]) -> None:
    depth = 1 + max(operand.depth for operand in operands)
    size = 1 + sum(operand.size for operand in operands)
    if depth > MAX_DEPTH:
        raise FormulaTooLargeError(f"the formula is nested more than {MAX_DEPTH} deep")
    if size > MAX_SIZE:
        raise _too_large()
    object.__setattr__(node, "depth", depth)
    object.__setattr__(node, "size", size)
    object.__setattr__(node, "digest", hash((node.op, operands)))


def _too_large() -> FormulaTooLargeError:
    return FormulaTooLargeError(f"the formula has more than {MAX_SIZE} operators and atoms")


def nary(op: Op, *operands: Formula) -> Formula:
    """`&` or `|` over `operands`, flattened; of one operand, that operand; of none, the operator's unit."""
    flat: list[Formula] = []
    for operand in operands:
        flat.extend(operand.operands if isinstance(operand, Nary) and operand.op is op else (operand,))
        if len(flat) > MAX_SIZE:
            raise _too_large()
    if not flat:
        return TRUE if op is Op.AND else FALSE
    return flat[0] if len(flat) == 1 else Nary(op, tuple(flat))


def conjunction(*operands: Formula) -> Formula:
    """`a & b & ...`; of none, `true`."""
    return nary(Op.AND, *operands)


def disjunction(*operands: Formula) -> Formula:
    """`a | b | ...`; of none, `false`."""
    return nary(Op.OR, *operands)


def build(op: Op, operands: Sequence[Formula]) -> Formula:
    """The formula with `op` at its root, whatever kind of operator that is."""
    if op in NARY_OPS:
        return nary(op, *operands)
    return Unary(op, *operands) if op in UNARY_OPS else Binary(op, *operands)


def children(formula: Formula) -> tuple[Formula, ...]:
    """The direct operands, left to right."""
    match formula:
        case Unary(operand=operand):
            return (operand,)
        case Binary(left=left, right=right):
            return (left, right)
        case Nary(operands=operands):
            return operands
        case _:
            return ()


def walk(formula: Formula) -> Iterator[Formula]:
    """Every node, the root first, left to right."""
    stack = [formula]
    while stack:
        node = stack.pop()
        yield node
        stack.extend(reversed(children(node)))


def fold(formula: Formula, combine: Callable[[Formula, tuple[T, ...]], T]) -> T:
    """Work bottom-up: `combine(node, results of its operands)` for every node; the root's result."""
    results: list[T] = []
    for node in reversed(list(walk(formula))):
        # Right operands come first in this order, so the leftmost result is on top.
        operands = tuple(results.pop() for _ in children(node))
        results.append(combine(node, operands))
    return results[0]


def atoms(formula: Formula) -> tuple[Atom, ...]:
    """The distinct atoms, in order of first occurrence."""
    return tuple(dict.fromkeys(node for node in walk(formula) if isinstance(node, Atom)))


def map_atoms(formula: Formula, replace: Callable[[Atom], Formula]) -> Formula:
    """The formula with every atom replaced by `replace(atom)`, all at once.

    Raises FormulaTooLargeError when the result is beyond the limits.
    """

    def combine(node: Formula, operands: tuple[Formula, ...]) -> Formula:
        if isinstance(node, Atom):
            return replace(node)
        return node if isinstance(node, Constant) else build(node.op, operands)

    return fold(formula, combine)


def substitute(formula: Formula, terms: Mapping[Term, Term]) -> Formula:
    """The formula with every term found in `terms` replaced, simultaneously: `{a: b, b: a}` swaps."""
    return map_atoms(formula, lambda atom: with_terms(atom, terms))


def with_terms(atom: Atom, terms: Mapping[Term, Term]) -> Atom:
    """`substitute` for one atom."""
    return Atom(atom.function, tuple(terms.get(term, term) for term in atom.arguments))


_Symbol = Atom | Constant | tuple[Op, int]


def _polish(formula: Formula | _Compound) -> tuple[_Symbol, ...]:
    """The nodes, root first; an inner one as its operator and number of operands, which determines the formula."""
    return tuple(
        node if isinstance(node, (Atom, Constant)) else (node.op, len(children(node)))
        for node in walk(formula)  # type: ignore[arg-type]  # every _Compound is one of the three inner nodes
    )


def _from_polish(symbols: tuple[_Symbol, ...]) -> Formula:
    results: list[Formula] = []
    for symbol in reversed(symbols):
        if isinstance(symbol, tuple):
            op, count = symbol
            results.append(build(op, [results.pop() for _ in range(count)]))
        else:
            results.append(symbol)
    return results[0]


def _repr(node: Formula, operands: tuple[str, ...]) -> str:
    if isinstance(node, (Atom, Constant)):
        return repr(node)
    listed = ", ".join(operands)
    if isinstance(node, Nary):
        return f"Nary(Op.{node.op.name}, ({listed}))"
    return f"{type(node).__name__}(Op.{node.op.name}, {listed})"
