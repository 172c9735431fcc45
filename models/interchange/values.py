"""Objects, values and numbers as functions of the state of a grounded world, and how they compare.

An entity is a known symbol, what a table says of the digit of one variable, or a choice between entities.
"""

from __future__ import annotations

import operator
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import TypeAlias

import numpy as np

from models.interchange.conditions import FALSE, TRUE, Condition, Conditions, Fixed, Joined, Member
from models.interchange.names import number_text
from models.world.vocabulary import Symbol


@dataclass(frozen=True, slots=True, eq=False)
class Known:
    """A symbol, or None for `none`."""

    symbol: Symbol | None


@dataclass(frozen=True, slots=True, eq=False)
class Lookup:
    """The symbol that belongs to the digit of a variable."""

    position: int
    symbols: tuple[Symbol | None, ...]


@dataclass(frozen=True, slots=True, eq=False)
class Either:
    """One entity where the condition holds, another elsewhere."""

    condition: Condition
    then: Entity
    otherwise: Entity


Entity: TypeAlias = Known | Lookup | Either


@dataclass(frozen=True, slots=True, eq=False)
class Constant:
    """A number that is the same in every state, and how PRISM computes it (`1 - slip`); `level` is how tightly the
    text binds: 1 for sums, 2 for products, 3 for a literal or name.
    """

    value: float
    text: str
    level: int = 3


@dataclass(frozen=True, slots=True, eq=False)
class Count:
    """How many of the conditions hold, and `base` more."""

    base: int
    conditions: tuple[Condition, ...]


@dataclass(frozen=True, slots=True, eq=False)
class Arithmetic:
    """`left operator right`."""

    operator: str
    left: Number
    right: Number


@dataclass(frozen=True, slots=True, eq=False)
class Choice:
    """One number where the condition holds, another elsewhere."""

    condition: Condition
    then: Number
    otherwise: Number


Number: TypeAlias = Constant | Count | Arithmetic | Choice

COMPARISONS: Mapping[str, Callable[[float, float], bool]] = {
    "==": operator.eq,
    "!=": operator.ne,
    "<": operator.lt,
    "<=": operator.le,
    ">": operator.gt,
    ">=": operator.ge,
}
OPERATIONS = {"+": np.add, "-": np.subtract, "*": np.multiply, "/": np.true_divide}
LEVELS = {"+": 1, "-": 1, "*": 2, "/": 2}


def lookup(position: int, symbols: tuple[Symbol | None, ...]) -> Entity:
    """A Lookup, or the one symbol that every digit leads to."""
    return Known(symbols[0]) if len(set(symbols)) == 1 else Lookup(position, symbols)


def digits_where(symbols: tuple[Symbol | None, ...], test: Callable[[Symbol | None], bool]) -> int:
    """The digits, as bits, whose symbol passes a test."""
    return sum(1 << digit for digit, symbol in enumerate(symbols) if test(symbol))


def either(make: Conditions, condition: Condition, then: Entity, otherwise: Entity) -> Entity:
    """`then` where the condition holds; a table where one is enough."""
    if isinstance(condition, Fixed):
        return then if condition.value else otherwise
    if isinstance(condition, Member):
        position, digits = condition.position, condition.digits
        then = restrict(make, then, {position: digits})
        otherwise = restrict(make, otherwise, {position: make.full[position] & ~digits})
        merged = _merged(condition, then, otherwise, make.full[position].bit_length())
        if merged is not None:
            return merged
    elif isinstance(condition, Joined) and condition.conjunctive:
        known = {part.position: part.digits for part in condition.operands if isinstance(part, Member)}
        then = restrict(make, then, known)
    alike = isinstance(then, Known) and isinstance(otherwise, Known) and then.symbol == otherwise.symbol
    return then if alike or then is otherwise else Either(condition, then, otherwise)


def _merged(condition: Member, then: Entity, otherwise: Entity, radix: int) -> Entity | None:
    """One table for both branches when neither depends on another variable."""
    columns = []
    for branch in (then, otherwise):
        if isinstance(branch, Known):
            columns.append((branch.symbol,) * radix)
        elif isinstance(branch, Lookup) and branch.position == condition.position:
            columns.append(branch.symbols)
        else:
            return None
    chosen = (columns[0 if condition.digits >> digit & 1 else 1][digit] for digit in range(radix))
    return lookup(condition.position, tuple(chosen))


def restrict(make: Conditions, entity: Entity, known: Mapping[int, int]) -> Entity:
    """The entity where each variable at a position of `known` has one of these digits."""
    make.spend(1)
    if isinstance(entity, Lookup) and entity.position in known:
        digits = known[entity.position]
        symbols = {symbol for digit, symbol in enumerate(entity.symbols) if digits >> digit & 1}
        return Known(symbols.pop()) if len(symbols) == 1 else entity
    if isinstance(entity, Either):
        condition = make.restrict(entity.condition, known)
        then, otherwise = restrict(make, entity.then, known), restrict(make, entity.otherwise, known)
        if isinstance(condition, Fixed):
            return then if condition.value else otherwise
        if condition is not entity.condition or then is not entity.then or otherwise is not entity.otherwise:
            return either(make, condition, then, otherwise)
    return entity


def same(make: Conditions, left: Entity, right: Entity) -> Condition:
    """Whether two entities are one."""
    make.spend(1)
    if isinstance(left, Either):
        return branch(make, left.condition, same(make, left.then, right), same(make, left.otherwise, right))
    if isinstance(right, Either):
        return same(make, right, left)
    if isinstance(left, Known):
        if isinstance(right, Known):
            return TRUE if left.symbol == right.symbol else FALSE
        left, right = right, left
    if isinstance(right, Known):
        wanted = right.symbol
        return make.member(left.position, digits_where(left.symbols, lambda symbol: symbol == wanted))
    return _same_lookups(make, left, right)


def _same_lookups(make: Conditions, left: Lookup, right: Lookup) -> Condition:
    make.spend(len(left.symbols) + len(right.symbols))
    pairs = list(zip(left.symbols, right.symbols, strict=False))
    if left.position == right.position:
        return make.member(left.position, sum(1 << digit for digit, (a, b) in enumerate(pairs) if a == b))
    rest = {*left.symbols[len(pairs) :], *right.symbols[len(pairs) :]}
    distinct = {symbol for symbol, _ in pairs}
    if all(a == b for a, b in pairs) and len(distinct) == len(pairs) and not rest & distinct:
        return make.same(left.position, right.position)
    found = set(right.symbols)
    shared = [Known(symbol) for symbol in dict.fromkeys(left.symbols) if symbol in found]
    return make.join(False, [make.conjoin(same(make, left, symbol), same(make, right, symbol)) for symbol in shared])


def branch(make: Conditions, condition: Condition, then: Condition, otherwise: Condition) -> Condition:
    """`then` where the condition holds, `otherwise` elsewhere, of conditions."""
    if isinstance(condition, Fixed):
        return then if condition.value else otherwise
    return make.disjoin(make.conjoin(condition, then), make.conjoin(make.negate(condition), otherwise))


def literal(value: float) -> Constant:
    """A number written out."""
    text = number_text(value)
    return Constant(value, text if value >= 0 else f"({text})")


def calculate(operation: str, left: Number, right: Number) -> Number:
    """Arithmetic; constants are folded, and keep the names of the parameters in their text."""
    if not (isinstance(left, Constant) and isinstance(right, Constant)):
        return Arithmetic(operation, left, right)
    with np.errstate(all="ignore"):
        value = float(OPERATIONS[operation](np.float64(left.value), np.float64(right.value)))
    level = LEVELS[operation]
    before = left.text if left.level >= level else f"({left.text})"
    after = right.text if right.level > level else f"({right.text})"
    return Constant(value, f"{before} {operation} {after}", level)


def choose(condition: Condition, then: Number, otherwise: Number) -> Number:
    """`then` where the condition holds."""
    if isinstance(condition, Fixed):
        return then if condition.value else otherwise
    return Choice(condition, then, otherwise)


def compare(make: Conditions, operation: str, left: Number, right: Number) -> Condition:
    """A comparison of numbers; counts against constants become logic where that is simple."""
    if isinstance(left, Constant) and isinstance(right, Constant):
        return TRUE if COMPARISONS[operation](left.value, right.value) else FALSE
    if isinstance(left, Constant) and isinstance(right, Count):
        mirrored = {"<": ">", "<=": ">=", ">": "<", ">=": "<="}
        return compare(make, mirrored.get(operation, operation), right, left)
    if isinstance(left, Count) and isinstance(right, Constant):
        return _count_compared(make, operation, left, right)
    return make.compared(operation, left, right)


def _count_compared(make: Conditions, operation: str, count: Count, limit: Constant) -> Condition:
    test, most = COMPARISONS[operation], len(count.conditions)
    passing = [n for n in range(most + 1) if test(count.base + n, limit.value)]
    if len(passing) in (0, most + 1):
        return TRUE if passing else FALSE
    none = make.join(True, [make.negate(condition) for condition in count.conditions])
    every = make.join(True, count.conditions)
    simple = {
        (0,): none,
        (most,): every,
        tuple(range(1, most + 1)): make.negate(none),
        tuple(range(most)): make.negate(every),
    }
    return simple.get(tuple(passing)) or make.compared(operation, count, limit)
