"""Expressions of a domain, applied to the objects of an environment, as functions of the state.

An object or value is an integer: 0 is `none`, the others count the environment's symbols from 1.
"""

from __future__ import annotations

import operator
from collections.abc import Mapping, Sequence
from typing import Any, assert_never

import numpy as np
from numpy.typing import NDArray

from models.world.algebra import Algebra, Array, Combined, Operation, Table, Value
from models.world.checker import qualified_value
from models.world.expression import (
    Access,
    Arithmetic,
    Call,
    Compare,
    Conditional,
    Connective,
    Expression,
    Is,
    Not,
    Nothing,
    Number,
    Quantified,
    Quantifier,
    Truth,
    Variable,
)
from models.world.model import Model
from models.world.names import NONE
from models.world.vocabulary import Symbol

Scope = Mapping[str, Value]
_COMPARISONS = {
    "==": operator.eq,
    "!=": operator.ne,
    "<": operator.lt,
    "<=": operator.le,
    ">": operator.gt,
    ">=": operator.ge,
}
_ARITHMETIC: dict[str, Any] = {"+": np.add, "-": np.subtract, "*": np.multiply, "/": np.true_divide}
_REMEMBERED = 4_096
_STEP = 16  # what evaluating one node costs, in entries of the algebra
TRUE = Table((), np.array(True))
FALSE = Table((), np.array(False))


class Evaluator:
    """Turns checked expressions into values over the state variables of one model."""

    def __init__(self, model: Model, algebra: Algebra) -> None:
        self.model = model
        self.algebra = algebra
        self.numbers = {symbol: index for index, symbol in enumerate(model.symbols, start=1)}
        self._constants = [Table((), np.array(number, dtype=np.int32)) for number in range(len(model.symbols) + 1)]
        self.positions = {(v.owner, v.attribute): position for position, v in enumerate(model.variables)}
        ranges = {id(v.values): v.values for v in model.variables}  # few tuples, shared by many variables
        numbered = {key: self._numbered(values) for key, values in ranges.items()}
        self._variables: list[Value] = [
            algebra.variable(position, numbered[id(variable.values)])
            for position, variable in enumerate(model.variables)
        ]
        self._members: dict[str, list[int]] = {}
        for symbol, number in self.numbers.items():
            self._members.setdefault(symbol.kind, []).append(number)
        self._every = tuple(range(len(self._constants)))
        attributes = model.domain.attributes
        self._values = {kind: frozenset(values) for kind, values in attributes.items()}
        self._kind_of = {value: kind for kind in reversed([*attributes]) for value in attributes[kind]}  # the first
        self._tests: dict[tuple[str, ...], NDArray[np.bool_]] = {}
        self._static: dict[str, NDArray[np.int32]] = {}
        self._owners: dict[str, dict[int, int]] = {}
        for (owner, attribute), position in self.positions.items():
            self._owners.setdefault(attribute, {})[self.numbers[owner]] = position
        self._calls: dict[tuple[str, tuple[Value, ...]], Value] = {}
        self._reach: dict[Value, tuple[int, ...]] = {}
        self._ranges: dict[tuple[int, ...], tuple[int, ...]] = {}

    def overriding(self, changes: Mapping[int, Value]) -> Evaluator:
        """An evaluator in whose states the variables at some positions have other values."""
        self.algebra.spend(len(self._variables))
        other = object.__new__(Evaluator)
        other.__dict__.update(self.__dict__)
        other._variables = [changes.get(position, value) for position, value in enumerate(self._variables)]
        other._calls = {}
        return other

    def renew(self) -> None:
        """Starts a new count of work, and forgets what is remembered when that has become much."""
        self.algebra.renew()
        if len(self._calls) > _REMEMBERED:
            self._calls.clear()
            self._reach.clear()
            self._ranges.clear()

    def symbol(self, symbol: Symbol) -> Value:
        """The constant function of a symbol."""
        return self._constants[self.numbers[symbol]]

    def members(self, kinds: Sequence[str]) -> list[Value]:
        """The symbols of some kinds, as constants. Counts as work: whoever asks goes through them all."""
        found: list[Value] = [
            self._constants[number] for kind in dict.fromkeys(kinds) for number in self._members.get(kind, ())
        ]
        self.algebra.spend(16 * len(found))
        return found

    def evaluate(self, expression: Expression, scope: Scope) -> Value:
        """The function of the state that an expression is."""
        self.algebra.spend(_STEP)
        match expression:
            case Number(value=number):
                return Table((), np.array(number))
            case Truth(value=truth):
                return TRUE if truth else FALSE
            case Nothing():
                return self._constants[0]
            case Variable(name=name):
                return self._variable(name, scope)
            case Access():
                return self._access(expression, scope)
            case Call(name=name, arguments=arguments):
                return self.call(name, [self.evaluate(argument, scope) for argument in arguments])
            case Not(operand=operand):
                return self.algebra.combine(np.logical_not, self.evaluate(operand, scope))
            case Connective(conjunctive=conjunctive, operands=operands):
                return self.connect(conjunctive, (self.evaluate(operand, scope) for operand in operands))
            case Compare():
                left, right = self.evaluate(expression.left, scope), self.evaluate(expression.right, scope)
                return self.algebra.combine(_COMPARISONS[expression.operator], left, right)
            case Is(operand=operand, kinds=kinds):
                return self._is(self.evaluate(operand, scope), kinds)
            case Arithmetic():
                return self._arithmetic(expression, scope)
            case Conditional():
                return self._conditional(expression, scope)
            case Quantified():
                return self._quantified(expression, scope)
            case _:
                assert_never(expression)

    def call(self, name: str, arguments: Sequence[Value]) -> Value:
        """A definition or propositional function applied to values; the same application is computed once."""
        key = (name, tuple(arguments))
        if key not in self._calls:
            definition = self.model.domain.definitions[name]
            scope = {argument.name: value for argument, value in zip(definition.arguments, arguments, strict=True)}
            self._calls[key] = self.evaluate(definition.body, scope)
        return self._calls[key]

    def connect(self, conjunctive: bool, operands: Any) -> Value:
        """And, or; stops at an operand that decides it."""
        kept: list[Value] = []
        for operand in operands:
            known = known_truth(operand)
            if known is (not conjunctive):
                return FALSE if conjunctive else TRUE
            if known is None:
                kept.append(operand)
        if not kept:
            return TRUE if conjunctive else FALSE
        return self.algebra.fold(np.logical_and if conjunctive else np.logical_or, kept)

    def _variable(self, name: str, scope: Scope) -> Value:
        if name in scope:
            return scope[name]
        domain = self.model.domain
        if name in domain.constants:
            return self.symbol(self.model.objects[name])
        if name in self.model.parameters:
            return Table((), np.array(self.model.parameters[name]))
        return self.symbol(Symbol(self._kind_of[name], name))

    def _access(self, expression: Access, scope: Scope) -> Value:
        attribute = expression.attribute
        if isinstance(expression.base, Variable) and qualified_value(expression, scope, self._values):
            return self.symbol(Symbol(expression.base.name, attribute))
        base = self.evaluate(expression.base, scope)
        static = self._table(attribute)
        owners = self._owners.get(attribute, {})
        if isinstance(base, Table) and not base.scope:
            number = int(base.array)
            return self._variables[owners[number]] if number in owners else self._constants[int(static[number])]
        reach = self._reachable(base) if owners else ()
        self.algebra.spend(len(reach))
        reachable = [number for number in reach if number in owners]
        if not reachable:
            return self._remember(self.algebra.combine(static.__getitem__, base), None)

        def follow(numbers: Array, *values: Array) -> Array:
            result: Array = static[numbers]
            for number, value in zip(reachable, values, strict=True):
                result = np.where(numbers == number, value, result)
            return result

        variables = [self._variables[owners[number]] for number in reachable]
        value = self.algebra.combine(follow, base, *variables)
        if isinstance(value, Table):
            return value
        ranges = {id(one): one for one in map(self._reachable, variables)}.values()  # few, shared by many variables
        self.algebra.spend(8 * len(variables) + sum(map(len, ranges)))
        return self._remember(value, set(static[list(reach)].tolist()).union(*ranges))

    def _table(self, attribute: str) -> NDArray[np.int32]:
        """Symbol number to the number of its static attribute's value, 0 where it has none."""
        if attribute not in self._static:
            table = np.zeros(len(self._constants), dtype=np.int32)
            for symbol, attributes in self.model.static.items():
                if attribute in attributes:
                    table[self.numbers[symbol]] = self.numbers[attributes[attribute]]
            self._static[attribute] = table
        return self._static[attribute]

    def _numbered(self, values: Sequence[Symbol | None]) -> NDArray[np.int32]:
        return np.array([self.numbers[value] if value else 0 for value in values], dtype=np.int32)

    def _remember(self, value: Value, reach: set[int] | None) -> Value:
        if isinstance(value, Combined):
            self._reach[value] = self._shared(tuple(sorted(reach))) if reach is not None else self._every
        return value

    def _shared(self, reach: tuple[int, ...]) -> tuple[int, ...]:
        """The same tuple for the same numbers."""
        return self._ranges.setdefault(reach, reach)

    def _reachable(self, value: Value) -> tuple[int, ...]:
        """The numbers that an object-valued function may take."""
        if value not in self._reach:
            numbers = tuple(np.unique(value.array).tolist()) if isinstance(value, Table) else self._every
            self._reach[value] = self._shared(numbers)
        return self._reach[value]

    def _is(self, value: Value, kinds: tuple[str, ...]) -> Value:
        if kinds not in self._tests:
            member = self._tests[kinds] = np.zeros(len(self._constants), dtype=np.bool_)
            for kind in kinds:
                member[[0] if kind == NONE else self._members.get(kind, [])] = True
        return self.algebra.combine(self._tests[kinds].__getitem__, value)

    def _arithmetic(self, expression: Arithmetic, scope: Scope) -> Value:
        left, right = self.evaluate(expression.left, scope), self.evaluate(expression.right, scope)
        return self.algebra.combine(_QUIET[expression.operator], left, right)

    def _conditional(self, expression: Conditional, scope: Scope) -> Value:
        condition = self.evaluate(expression.condition, scope)
        known = known_truth(condition)
        if known is not None:
            return self.evaluate(expression.then if known else expression.otherwise, scope)
        then, otherwise = self.evaluate(expression.then, scope), self.evaluate(expression.otherwise, scope)
        chosen = self.algebra.combine(np.where, condition, then, otherwise)
        if isinstance(chosen, Combined) and self._is_object_valued(then):
            self._remember(chosen, {*self._reachable(then), *self._reachable(otherwise)})
        return chosen

    def _is_object_valued(self, value: Value) -> bool:
        return value in self._reach or (isinstance(value, Table) and value.array.dtype == np.int32)

    def _quantified(self, expression: Quantified, scope: Scope) -> Value:
        bodies = (
            self.evaluate(expression.body, {**scope, expression.variable: member})
            for member in self.members(expression.kinds)
        )
        if expression.quantifier is not Quantifier.COUNT:
            return self.connect(expression.quantifier is Quantifier.ALL, bodies)
        zero: Value = Table((), np.array(0, dtype=np.int16))
        counted = [self.algebra.combine(_count, body) for body in bodies if known_truth(body) is not False]
        return self.algebra.fold(np.add, [zero, *counted])


def known_truth(value: Value) -> bool | None:
    """The truth of a Boolean function that is the same in every state, or None."""
    if isinstance(value, Combined):
        return None
    if not value.scope:
        return bool(value.array)
    first = bool(value.array.flat[0])
    return first if (value.array.all() if first else not value.array.any()) else None


def _count(truth: Array) -> Array:
    return np.asarray(truth).astype(np.int16)


def _quiet(ufunc: Any) -> Operation:
    """The operation without warnings: where a number is not finite the checks of probabilities say so."""

    def apply(left: Array, right: Array) -> Any:
        with np.errstate(all="ignore"):
            return ufunc(left, right)

    return apply


_QUIET = {name: _quiet(ufunc) for name, ufunc in _ARITHMETIC.items()}
