"""Static types of expressions.

A type is a set of kinds (classes, attribute types and `none`) that a value may have, or one of the two
special sets BOOLEAN and NUMBER.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from itertools import chain
from typing import assert_never

from models.world.domain import Argument, Definition, ObjectClass, Parameter
from models.world.expression import (
    Access,
    Arithmetic,
    Call,
    Compare,
    Conditional,
    Connective,
    Expression,
    ExpressionError,
    Is,
    Not,
    Nothing,
    Number,
    Quantified,
    Quantifier,
    Truth,
    Variable,
)
from models.world.limits import MAX_EXPANDED_NESTING
from models.world.names import NONE, application, hint, listing, quoted

Type = frozenset[str]
BOOLEAN: Type = frozenset({"true or false"})
NUMBER: Type = frozenset({"number"})
_NONE_TYPE: Type = frozenset({NONE})
Scope = Mapping[str, Type]


class BrokenDefinitionError(ExpressionError):
    """The expression calls a definition whose own fault is reported at its own place."""


@dataclass(frozen=True, slots=True)
class Typed:
    """A type, and the nesting of the expression with its calls written out."""

    type: Type
    depth: int


def describe(type_: Type) -> str:
    """`cell or robot`, `true or false`, `number`."""
    return listing(sorted(type_))


@dataclass(slots=True)
class Checker:
    """Types the expressions of one domain. Definitions are typed once, when first called."""

    attributes: Mapping[str, tuple[str, ...]]
    classes: Mapping[str, ObjectClass]
    constants: Mapping[str, str]
    parameters: Mapping[str, Parameter]
    definitions: Mapping[str, Definition]
    _values: dict[str, frozenset[str]] = field(init=False)
    _kinds_of: dict[str, list[str]] = field(default_factory=dict)  # attribute value to its types
    _typed: dict[str, Typed] = field(default_factory=dict)
    _failed: dict[str, ExpressionError] = field(default_factory=dict)
    _open: list[str] = field(default_factory=list)

    def __post_init__(self) -> None:
        self._values = {kind: frozenset(values) for kind, values in self.attributes.items()}
        for kind, values in self._values.items():
            for value in values:
                self._kinds_of.setdefault(value, []).append(kind)

    def check(self, expression: Expression, scope: Scope, expected: Type | None = None) -> Typed:
        """The type of an expression. Raises ExpressionError when it has none, or not the expected one."""
        typed = self._check(expression, scope)
        if typed.depth > MAX_EXPANDED_NESTING:
            raise ExpressionError(
                f"with its definitions written out this is nested more than {MAX_EXPANDED_NESTING} deep"
            )
        if expected is not None and typed.type != expected:
            raise ExpressionError(f"must be {describe(expected)}, not {describe(typed.type)}")
        return typed

    def meanings(self, name: str) -> list[Type]:
        """What a free name may mean: a constant, a parameter, or a value of an attribute type."""
        found = [frozenset({self.constants[name]})] if name in self.constants else []
        found += [NUMBER] if name in self.parameters else []
        return found + [frozenset({kind}) for kind in self._kinds_of.get(name, ())]

    def definition(self, name: str) -> Typed:
        """The type of a definition's body. Raises ExpressionError when it calls itself."""
        if name in self._typed:
            return self._typed[name]
        if name in self._failed:
            raise self._failed[name]
        if name in self._open:
            cycle = " -> ".join([*self._open[self._open.index(name) :], name])
            raise ExpressionError(f"definitions may not call themselves: {cycle}")
        if len(self._open) > MAX_EXPANDED_NESTING // 2:
            raise ExpressionError("definitions call one another too deeply")
        self._open.append(name)
        try:
            definition = self.definitions[name]
            typed = self.check(definition.body, scope_of(definition.arguments))
        except ExpressionError as error:
            self._failed[name] = error
            raise
        finally:
            self._open.pop()
        self._typed[name] = typed
        return typed

    def _check(self, expression: Expression, scope: Scope) -> Typed:
        match expression:
            case Number():
                return Typed(NUMBER, 1)
            case Truth():
                return Typed(BOOLEAN, 1)
            case Nothing():
                return Typed(_NONE_TYPE, 1)
            case Variable(name=name):
                return Typed(self._variable(name, scope), 1)
            case Access():
                return self._access(expression, scope)
            case Call():
                return self._call(expression, scope)
            case Not(operand=operand):
                return Typed(BOOLEAN, 1 + self.check(operand, scope, BOOLEAN).depth)
            case Connective(operands=operands):
                return Typed(BOOLEAN, 1 + max(self.check(part, scope, BOOLEAN).depth for part in operands))
            case Compare():
                return self._compare(expression, scope)
            case Is(operand=operand, kinds=kinds):
                return self._is(operand, kinds, scope)
            case Arithmetic(left=left, right=right):
                depth = max(self.check(left, scope, NUMBER).depth, self.check(right, scope, NUMBER).depth)
                return Typed(NUMBER, 1 + depth)
            case Conditional():
                return self._conditional(expression, scope)
            case Quantified():
                return self._quantified(expression, scope)
            case _:
                assert_never(expression)

    def _variable(self, name: str, scope: Scope) -> Type:
        if name in scope:
            return scope[name]
        meanings = self.meanings(name)
        if not meanings:
            raise ExpressionError(self._unknown(name, scope))
        if len(meanings) > 1:
            raise ExpressionError(
                f"{name} means several things: {listing(describe(m) for m in meanings)}; write a value as type.value"
            )
        return meanings[0]

    def _unknown(self, name: str, scope: Scope) -> str:
        if name in self.definitions:
            written = application(name, (argument.name for argument in self.definitions[name].arguments))
            return f"{name} is a definition or function: write {written if '(' in written else f'{name}()'}"
        if name in self.classes or name in self.attributes:
            return f"{name} is a kind, not an object or value"
        values = (quoted(value) for values in self.attributes.values() for value in values)
        known = (*scope, *self.constants, *self.parameters, "true", "false", NONE)
        return f"nothing is called {name}{hint(name, chain(known, self.definitions, values))}"

    def _access(self, expression: Access, scope: Scope) -> Typed:
        if qualified_value(expression, scope, self._values):
            assert isinstance(expression.base, Variable)
            return Typed(frozenset({expression.base.name}), 1)
        if isinstance(expression.base, Variable) and self._is_type_name(expression.base.name, scope):
            kind, value = expression.base.name, expression.attribute
            raise ExpressionError(f"{kind} has no value {value}{hint(value, self.attributes[kind])}")
        base = self._entity(expression.base, scope)
        found: set[str] = set()
        partial = NONE in base.type
        for kind in base.type - {NONE}:
            declared = self.classes.get(kind)
            kinds = declared.kinds(expression.attribute) if declared else None
            partial = partial or kinds is None or (declared is not None and expression.attribute in declared.static)
            found.update(kinds or ())
        if not found:
            known = [name for kind in base.type if kind in self.classes for name in self._attributes(kind)]
            missing = expression.attribute
            raise ExpressionError(f"{describe(base.type)} has no attribute {missing}{hint(missing, known)}")
        return Typed(frozenset(found | {NONE} if partial else found), 1 + base.depth)

    def _is_type_name(self, name: str, scope: Scope) -> bool:
        return name in self.attributes and name not in scope and not self.meanings(name)

    def _attributes(self, kind: str) -> list[str]:
        return [*self.classes[kind].static, *self.classes[kind].state]

    def _entity(self, expression: Expression, scope: Scope) -> Typed:
        typed = self.check(expression, scope)
        if typed.type in (BOOLEAN, NUMBER):
            raise ExpressionError(f"an object or value is needed here, not {describe(typed.type)}")
        return typed

    def _call(self, expression: Call, scope: Scope) -> Typed:
        name = expression.name
        if name not in self.definitions:
            raise ExpressionError(f"no definition or function is called {name}{hint(name, self.definitions)}")
        arguments = self.definitions[name].arguments
        if len(arguments) != len(expression.arguments):
            raise ExpressionError(f"{name} takes {len(arguments)} arguments, not {len(expression.arguments)}")
        try:
            result = self.definition(name)
        except ExpressionError as error:
            if name not in self._failed:  # the fault is this very call
                raise
            raise BrokenDefinitionError(f"{name} is not well defined") from error
        depth = result.depth
        for argument, given in zip(arguments, expression.arguments, strict=True):
            typed = self._entity(given, scope)
            wrong = typed.type - {NONE, *argument.kinds}
            if wrong:
                raise ExpressionError(
                    f"{argument.name} of {name} must be {listing(argument.kinds)}, but may be {describe(wrong)} here"
                )
            depth = max(depth, typed.depth)
        return Typed(result.type, 1 + depth)

    def _compare(self, expression: Compare, scope: Scope) -> Typed:
        if expression.operator not in ("==", "!="):
            left = self.check(expression.left, scope, NUMBER)
            right = self.check(expression.right, scope, NUMBER)
        else:
            left, right = self.check(expression.left, scope), self.check(expression.right, scope)
            shared = left.type & right.type
            if not (shared if _NONE_TYPE in (left.type, right.type) else shared - _NONE_TYPE):
                raise ExpressionError(f"{describe(left.type)} and {describe(right.type)} are never equal")
        return Typed(BOOLEAN, 1 + max(left.depth, right.depth))

    def _is(self, operand: Expression, kinds: tuple[str, ...], scope: Scope) -> Typed:
        typed = self._entity(operand, scope)
        self.known(kinds)
        if not typed.type & frozenset(kinds):
            raise ExpressionError(f"this is never {listing(kinds)}: it is {describe(typed.type)}")
        return Typed(BOOLEAN, 1 + typed.depth)

    def _conditional(self, expression: Conditional, scope: Scope) -> Typed:
        condition = self.check(expression.condition, scope, BOOLEAN)
        then, otherwise = self.check(expression.then, scope), self.check(expression.otherwise, scope)
        special = {BOOLEAN, NUMBER} & {then.type, otherwise.type}
        if special and then.type != otherwise.type:
            raise ExpressionError(f"one branch is {describe(then.type)}, the other {describe(otherwise.type)}")
        depth = max(condition.depth, then.depth, otherwise.depth)
        return Typed(then.type | otherwise.type, 1 + depth)

    def _quantified(self, expression: Quantified, scope: Scope) -> Typed:
        self.known(expression.kinds)
        inner = {**scope, expression.variable: frozenset(expression.kinds) - {NONE}}
        body = self.check(expression.body, inner, BOOLEAN)
        return Typed(NUMBER if expression.quantifier is Quantifier.COUNT else BOOLEAN, 1 + body.depth)

    def known(self, kinds: tuple[str, ...]) -> None:
        """Raises ExpressionError for a kind the domain does not have."""
        for kind in kinds:
            if kind != NONE and kind not in self.classes and kind not in self.attributes:
                if self.meanings(kind):
                    raise ExpressionError(f"{kind} is not a kind: write == {kind}")
                raise ExpressionError(f"no class or attribute is called {kind}{hint(kind, self._kinds())}")

    def _kinds(self) -> list[str]:
        return [*self.classes, *self.attributes]


def scope_of(arguments: tuple[Argument, ...]) -> dict[str, Type]:
    """The types of a definition's or action's arguments."""
    return {argument.name: frozenset(argument.kinds) for argument in arguments}


def qualified_value(expression: Access, scope: Mapping[str, object], values: Mapping[str, frozenset[str]]) -> bool:
    """Whether this is `color.red`: a value of an attribute type, not an attribute of an object."""
    base = expression.base
    return (
        isinstance(base, Variable)
        and base.name not in scope
        and base.name in values
        and expression.attribute in values[base.name]
    )
