"""Expressions of a domain, applied to the objects of an environment, as conditions, entities and numbers.

The symbolic counterpart of `models.world.evaluator`: what that computes as arrays is kept here in a form that can be
written down. Static attributes, parameters and quantifiers disappear; attributes of attributes become choices.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from typing import TypeAlias, assert_never

from models.interchange.conditions import FALSE, TRUE, Compared, Condition, Conditions, Fixed, Joined, Member, Not, Same
from models.interchange.values import (
    Arithmetic,
    Choice,
    Constant,
    Count,
    Either,
    Entity,
    Known,
    Lookup,
    Number,
    branch,
    calculate,
    choose,
    compare,
    digits_where,
    either,
    literal,
    lookup,
    same,
)
from models.world import expression as ast
from models.world.checker import qualified_value
from models.world.model import Model
from models.world.names import NONE
from models.world.vocabulary import Symbol

Value: TypeAlias = Condition | Entity | Number
Scope: TypeAlias = Mapping[str, Value]
_CONDITIONS = (Fixed, Member, Same, Compared, Not, Joined)
_ENTITIES = (Known, Lookup, Either)


class Translator:
    """Translates checked expressions for one model; `parameters` are the texts that stand for its parameters."""

    def __init__(self, model: Model, parameters: Mapping[str, str]) -> None:
        self.model = model
        self.make = Conditions([len(variable.values) for variable in model.variables])
        self.positions = {(v.owner, v.attribute): position for position, v in enumerate(model.variables)}
        self._parameters = {name: Constant(model.parameters[name], text) for name, text in parameters.items()}
        self._variables: list[Entity] = [lookup(p, v.values) for p, v in enumerate(model.variables)]
        self._members: dict[str, list[Symbol]] = {}
        for symbol in model.symbols:
            self._members.setdefault(symbol.kind, []).append(symbol)
        attributes = model.domain.attributes
        self._values = {kind: frozenset(values) for kind, values in attributes.items()}
        self._kind_of = {value: kind for kind in reversed([*attributes]) for value in attributes[kind]}  # the first
        self._calls: dict[tuple[str, tuple[object, ...]], Value] = {}

    def overriding(self, changes: Mapping[int, Entity]) -> Translator:
        """A translator in whose states the variables at some positions have other values."""
        other = object.__new__(Translator)
        other.__dict__.update(self.__dict__)
        other._variables = [changes.get(position, value) for position, value in enumerate(self._variables)]
        other._calls = {}
        return other

    def members(self, kinds: Iterable[str]) -> list[Symbol]:
        """The symbols of some kinds."""
        return [symbol for kind in dict.fromkeys(kinds) for symbol in self._members.get(kind, ())]

    def proposition(self, function: str, symbols: Sequence[Symbol]) -> Condition:
        """Where a propositional function holds of some symbols."""
        value = self.call(function, [Known(symbol) for symbol in symbols])
        assert isinstance(value, _CONDITIONS)
        return value

    def condition(self, expression: ast.Expression, scope: Scope) -> Condition:
        """A Boolean expression."""
        value = self.translate(expression, scope)
        assert isinstance(value, _CONDITIONS)
        return value

    def number(self, expression: ast.Expression, scope: Scope) -> Number:
        """A numeric expression."""
        value = self.translate(expression, scope)
        assert not isinstance(value, (*_CONDITIONS, *_ENTITIES))
        return value

    def entity(self, expression: ast.Expression, scope: Scope) -> Entity:
        """An expression for an object or value."""
        value = self.translate(expression, scope)
        assert isinstance(value, _ENTITIES)
        return value

    def translate(self, expression: ast.Expression, scope: Scope) -> Value:
        """The function of the state that an expression is."""
        self.make.spend(1)
        match expression:
            case ast.Number(value=number):
                return literal(number)
            case ast.Truth(value=truth):
                return TRUE if truth else FALSE
            case ast.Nothing():
                return Known(None)
            case ast.Variable(name=name):
                return self._named(name, scope)
            case ast.Access():
                return self._access(expression, scope)
            case ast.Call(name=name, arguments=arguments):
                return self.call(name, [self.translate(argument, scope) for argument in arguments])
            case ast.Not(operand=operand):
                return self.make.negate(self.condition(operand, scope))
            case ast.Connective(conjunctive=conjunctive, operands=operands):
                return self._connective(conjunctive, (self.condition(operand, scope) for operand in operands))
            case ast.Compare():
                return self._compare(expression, scope)
            case ast.Is(operand=operand, kinds=kinds):
                return self._is(self.entity(operand, scope), kinds)
            case ast.Arithmetic(operator=operator, left=left, right=right):
                return calculate(operator, self.number(left, scope), self.number(right, scope))
            case ast.Conditional():
                return self._conditional(expression, scope)
            case ast.Quantified():
                return self._quantified(expression, scope)
            case _:
                assert_never(expression)

    def call(self, name: str, arguments: Sequence[Value]) -> Value:
        """A definition or propositional function applied to values."""
        key = (name, tuple(a.symbol if isinstance(a, Known) else a for a in arguments))
        if key not in self._calls:
            definition = self.model.domain.definitions[name]
            scope = {argument.name: value for argument, value in zip(definition.arguments, arguments, strict=True)}
            self._calls[key] = self.translate(definition.body, scope)
        return self._calls[key]

    def _named(self, name: str, scope: Scope) -> Value:
        if name in scope:
            return scope[name]
        if name in self.model.domain.constants:
            return Known(self.model.objects[name])
        return self._parameters.get(name) or Known(Symbol(self._kind_of[name], name))

    def _access(self, expression: ast.Access, scope: Scope) -> Entity:
        if isinstance(expression.base, ast.Variable) and qualified_value(expression, scope, self._values):
            return Known(Symbol(expression.base.name, expression.attribute))
        return self._follow(self.entity(expression.base, scope), expression.attribute)

    def _follow(self, base: Entity, attribute: str) -> Entity:
        self.make.spend(1)
        if isinstance(base, Known):
            return self._attribute(base.symbol, attribute)
        if isinstance(base, Either):
            then, otherwise = self._follow(base.then, attribute), self._follow(base.otherwise, attribute)
            return either(self.make, base.condition, then, otherwise)
        targets = {symbol: self._attribute(symbol, attribute) for symbol in dict.fromkeys(base.symbols)}
        fixed = {symbol: target.symbol for symbol, target in targets.items() if isinstance(target, Known)}
        moving = [symbol for symbol in targets if symbol not in fixed]
        if fixed:
            anything = next(iter(fixed.values()))
            result = lookup(base.position, tuple(fixed.get(symbol, anything) for symbol in base.symbols))
        else:
            result = targets[moving.pop()]
        for symbol in moving:
            here = same(self.make, base, Known(symbol))
            result = either(self.make, here, targets[symbol], result)
        return result

    def _attribute(self, symbol: Symbol | None, attribute: str) -> Entity:
        if symbol is None:
            return Known(None)
        position = self.positions.get((symbol, attribute))
        if position is not None:
            return self._variables[position]
        return Known(self.model.static.get(symbol, {}).get(attribute))

    def _is(self, entity: Entity, kinds: tuple[str, ...]) -> Condition:
        def fits(symbol: Symbol | None) -> bool:
            return (symbol.kind if symbol else NONE) in kinds

        self.make.spend(1)
        if isinstance(entity, Known):
            return TRUE if fits(entity.symbol) else FALSE
        if isinstance(entity, Lookup):
            return self.make.member(entity.position, digits_where(entity.symbols, fits))
        return branch(self.make, entity.condition, self._is(entity.then, kinds), self._is(entity.otherwise, kinds))

    def _connective(self, conjunctive: bool, operands: Iterable[Condition]) -> Condition:
        """And, or; stops at an operand that decides it."""
        kept = []
        for operand in operands:
            if isinstance(operand, Fixed) and operand.value is not conjunctive:
                return operand
            kept.append(operand)
        return self.make.join(conjunctive, kept)

    def _compare(self, expression: ast.Compare, scope: Scope) -> Condition:
        left, right = self.translate(expression.left, scope), self.translate(expression.right, scope)
        if isinstance(left, _ENTITIES) and isinstance(right, _ENTITIES):
            equal = same(self.make, left, right)
        elif isinstance(left, _CONDITIONS) and isinstance(right, _CONDITIONS):
            equal = branch(self.make, left, right, self.make.negate(right))
        else:
            assert not isinstance(left, (*_CONDITIONS, *_ENTITIES))
            assert not isinstance(right, (*_CONDITIONS, *_ENTITIES))
            return compare(self.make, expression.operator, left, right)
        return equal if expression.operator == "==" else self.make.negate(equal)

    def _conditional(self, expression: ast.Conditional, scope: Scope) -> Value:
        condition = self.condition(expression.condition, scope)
        if isinstance(condition, Fixed):
            return self.translate(expression.then if condition.value else expression.otherwise, scope)
        then, otherwise = self.translate(expression.then, scope), self.translate(expression.otherwise, scope)
        if isinstance(then, _CONDITIONS) and isinstance(otherwise, _CONDITIONS):
            return branch(self.make, condition, then, otherwise)
        if isinstance(then, _ENTITIES) and isinstance(otherwise, _ENTITIES):
            return either(self.make, condition, then, otherwise)
        assert isinstance(then, (Constant, Count, Arithmetic, Choice))
        assert isinstance(otherwise, (Constant, Count, Arithmetic, Choice))
        return choose(condition, then, otherwise)

    def _quantified(self, expression: ast.Quantified, scope: Scope) -> Value:
        bodies = (
            self.condition(expression.body, {**scope, expression.variable: Known(member)})
            for member in self.members(expression.kinds)
        )
        if expression.quantifier is not ast.Quantifier.COUNT:
            return self._connective(expression.quantifier is ast.Quantifier.ALL, bodies)
        counted = list(bodies)
        base = sum(1 for body in counted if body is TRUE)
        open_ = tuple(body for body in counted if not isinstance(body, Fixed))
        return Count(base, open_) if open_ else literal(float(base))
