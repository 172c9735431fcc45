"""Actions applied to objects: where each is possible, and what it does, as functions of the state."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, replace
from itertools import product
from math import prod

import numpy as np
from numpy.typing import NDArray

from models.world.algebra import Algebra, Array, Table, Value
from models.world.domain import Action, Argument, Outcome
from models.world.evaluator import Evaluator, known_truth
from models.world.expression import ExpressionError
from models.world.limits import MAX_CHECK, MAX_GROUNDINGS, MAX_TABLE
from models.world.names import NONE, application
from models.world.report import Path
from models.world.vocabulary import Symbol

_TOLERANCE = 1e-9
_NEGLIGIBLE = 1e-15


class ActionError(Exception):
    """A fault of one action, at a path of the domain."""

    def __init__(self, path: Path, detail: str) -> None:
        super().__init__(detail)
        self.path = path
        self.detail = detail


@dataclass(frozen=True, slots=True, eq=False)
class GroundedAction:
    """An action with its arguments: outcome `i` has `probabilities[i]` and adds `shifts[i]` to the state's
    index.
    """

    name: str
    enabled: Value
    probabilities: tuple[Value, ...]
    shifts: tuple[Value, ...]
    merged: bool  # whether outcomes with the same successor have been merged already
    changes: frozenset[int]  # positions of the variables that some outcome sets
    cost: float


def ground_actions(
    evaluator: Evaluator, strides: tuple[int, ...], constraints: tuple[Value, ...]
) -> list[GroundedAction]:
    """Every action with every choice of arguments that is possible somewhere.

    An action is not possible where one of its outcomes would break a constraint. Raises ActionError.
    """
    grounder = _Grounder(evaluator, strides, constraints)
    total = 0
    grounded: list[GroundedAction] = []
    for action in evaluator.model.domain.actions:
        total += prod(len(evaluator.members(argument.kinds)) for argument in action.arguments)
        if total > MAX_GROUNDINGS:
            raise ActionError(("actions", action.name), f"the actions have more than {MAX_GROUNDINGS} groundings")
        for binding in _bindings(evaluator, action.arguments):
            try:
                made = grounder.ground(action, binding)
            except ExpressionError as error:
                raise ActionError(("actions", action.name), str(error)) from None
            if made is not None:
                grounded.append(made)
    return grounded


def _bindings(evaluator: Evaluator, arguments: tuple[Argument, ...]) -> Iterator[Mapping[str, Symbol]]:
    symbols = evaluator.model.symbols
    choices = [[s for kind in argument.kinds for s in symbols if s.kind == kind] for argument in arguments]
    for chosen in product(*choices):
        yield dict(zip((argument.name for argument in arguments), chosen, strict=True))


class _Grounder:
    def __init__(self, evaluator: Evaluator, strides: tuple[int, ...], constraints: tuple[Value, ...]) -> None:
        self.evaluator = evaluator
        self.algebra: Algebra = evaluator.algebra
        self.strides = strides
        self.constraints = constraints
        self._digits: dict[int, NDArray[np.int64]] = {}  # by id of the values: few tuples, kept by the model
        self._touching: dict[int, list[int]] = {}  # position of a variable to the constraints that read it
        for index, constraint in enumerate(constraints):
            for position in constraint.scope:
                self._touching.setdefault(position, []).append(index)

    def ground(self, action: Action, binding: Mapping[str, Symbol]) -> GroundedAction | None:
        """The action with its arguments bound, or None when it is possible nowhere."""
        path = ("actions", action.name)
        name = application(action.name, (symbol.name for symbol in binding.values()))
        scope = {argument: self.evaluator.symbol(symbol) for argument, symbol in binding.items()}
        enabled = self.evaluator.evaluate(action.guard, scope)
        if known_truth(enabled) is False:
            return None
        happening: list[tuple[int, Value, dict[int, Value]]] = []
        for index, outcome in enumerate(action.outcomes):
            probability = self.algebra.combine(_snap, self.evaluator.evaluate(outcome.probability, scope))
            if isinstance(probability, Table) and not probability.array.any():
                continue
            changes = self._changes(outcome, binding, scope)
            enabled = self.evaluator.connect(True, [enabled, *self._kept(probability, changes)])
            happening.append((index, probability, changes))
        if known_truth(enabled) is False:
            return None
        shifts: list[Value] = []
        for index, probability, changes in happening:
            place = (*path, "outcomes", index)
            self._in_range(probability, enabled, (*place, "probability"), name)
            happens = self.algebra.combine(_positive, probability)
            possible = self.evaluator.connect(True, [enabled, happens])
            for effect, (position, value) in zip(action.outcomes[index].effects, changes.items(), strict=True):
                self._can_become(position, value, possible, (*place, "set", effect.target), name)
            shifts.append(self._shift(changes))
        probabilities = tuple(probability for _, probability, _ in happening)
        self._sums_to_one(probabilities, enabled, path, name)
        changed = frozenset(position for _, _, changes in happening for position in changes)
        return self._merge(
            GroundedAction(name, enabled, probabilities, tuple(shifts), False, changed, self._cost(action, name))
        )

    def _cost(self, action: Action, name: str) -> float:
        cost = self.evaluator.evaluate(action.cost, {})
        number = float(cost.array) if isinstance(cost, Table) and not cost.scope else np.nan
        if not (np.isfinite(number) and number > 0):
            raise ActionError(
                ("actions", action.name, "cost"), f"{name}: a cost is a positive number, the same everywhere"
            )
        return number

    def _in_range(self, probability: Value, enabled: Value, path: Path, name: str) -> None:
        outside = self.algebra.combine(_outside_unit, probability)
        if witness := self._witness(outside, enabled, path):
            raise ActionError(path, f"{name}: the probability is not between 0 and 1{witness}")

    def _sums_to_one(self, probabilities: tuple[Value, ...], enabled: Value, path: Path, name: str) -> None:
        if not probabilities:
            raise ActionError((*path, "outcomes"), f"{name}: no outcome has a probability above 0")
        wrong = self.algebra.combine(_not_one, self.algebra.fold(np.add, probabilities))
        if witness := self._witness(wrong, enabled, (*path, "outcomes")):
            raise ActionError((*path, "outcomes"), f"{name}: the probabilities do not sum to 1{witness}")

    def _witness(self, fault: Value, enabled: Value, path: Path) -> str | None:
        """Where a fault happens in a state that enables the action, ` when robot.at is kitchen`, or None."""
        if known_truth(fault) is False:
            return None
        both = self.evaluator.connect(True, [enabled, fault])
        if self.algebra.entries(both.scope) > MAX_CHECK:
            both = fault
        if self.algebra.entries(both.scope) > MAX_CHECK:
            raise ActionError(
                path, f"this depends on more than {MAX_CHECK} combinations of values and cannot be checked"
            )
        table = self.algebra.tabulate(both, both.scope)
        if not table.any():
            return None
        digits = np.unravel_index(int(np.argmax(table)), table.shape) if table.shape else ()
        variables = [self.evaluator.model.variables[position] for position in both.scope]
        shown: list[str] = []
        for variable, digit in zip(variables[:4], digits, strict=False):
            value = variable.values[int(digit)]
            shown.append(f"{variable.owner.name}.{variable.attribute} is {value.name if value else NONE}")
        return f" when {' and '.join(shown)}" if shown else " anywhere"

    def _changes(self, outcome: Outcome, binding: Mapping[str, Symbol], scope: Mapping[str, Value]) -> dict[int, Value]:
        changes: dict[int, Value] = {}
        for effect in outcome.effects:
            owner = binding.get(effect.owner) or self.evaluator.model.objects[effect.owner]
            position = self.evaluator.positions[owner, effect.attribute]
            if position in changes:
                detail = f"{owner.name}.{effect.attribute} is set twice when two arguments are the same object"
                raise ExpressionError(f"{detail}: exclude that in `when`")
            changes[position] = self.evaluator.evaluate(effect.value, scope)
        return changes

    def _can_become(self, position: int, value: Value, possible: Value, path: Path, name: str) -> None:
        variable = self.evaluator.model.variables[position]
        digit = self.algebra.combine(self._digit_of(variable.values).__getitem__, value)
        if witness := self._witness(self.algebra.combine(_negative, digit), possible, path):
            target = f"{variable.owner.name}.{variable.attribute}"
            raise ActionError(path, f"{name}: {target} would become something it cannot be{witness}")

    def _shift(self, changes: Mapping[int, Value]) -> Value:
        """What the changes add to the index of the state."""
        shifts: list[Value] = []
        for position, value in changes.items():
            variable = self.evaluator.model.variables[position]
            digit = self.algebra.combine(self._digit_of(variable.values).__getitem__, value)
            radix, stride = len(variable.values), self.strides[position]
            old = self.algebra.variable(position, np.arange(radix, dtype=np.int64) * stride)
            new = self.algebra.combine((np.arange(radix + 1, dtype=np.int64) * stride).__getitem__, digit)
            shifts.append(self.algebra.combine(np.subtract, new, old))
        return self.algebra.fold(np.add, shifts) if shifts else Table((), np.array(0, dtype=np.int64))

    def _digit_of(self, values: tuple[Symbol | None, ...]) -> NDArray[np.int64]:
        """Symbol number to digit, -1 for a symbol that is not among the values."""
        if id(values) not in self._digits:
            numbers = self.evaluator.numbers
            digits = np.full(len(numbers) + 1, -1, dtype=np.int64)
            for digit, value in enumerate(values):
                digits[numbers[value] if value else 0] = digit
            self._digits[id(values)] = digits
        return self._digits[id(values)]

    def _kept(self, probability: Value, changes: Mapping[int, Value]) -> Iterator[Value]:
        """For each constraint that the changes touch: where it holds after them, or they do not happen."""
        touched = sorted({index for position in changes for index in self._touching.get(position, ())})
        if not touched:
            return
        after = self.evaluator.overriding(changes)
        idle = self.algebra.combine(_impossible, probability)
        for index in touched:
            constraint = self.evaluator.model.domain.constraints[index]
            yield self.evaluator.connect(False, [idle, after.evaluate(constraint, {})])

    def _merge(self, action: GroundedAction) -> GroundedAction:
        """Outcomes with the same successor merged, when all are tables over few variables together."""
        parts = (*action.probabilities, *action.shifts)
        scope = tuple(sorted({v for part in parts for v in part.scope}))
        count, size = len(action.probabilities), self.algebra.entries(scope)
        if count == 1:
            return replace(action, merged=True)
        if not all(isinstance(part, Table) for part in parts) or size > MAX_TABLE:
            return action
        self.algebra.spend(size * count * (count + 2))
        probability = np.stack([self.algebra.tabulate(p, scope) for p in action.probabilities])
        shift = np.stack([self.algebra.tabulate(s, scope) for s in action.shifts])
        merge_outcomes(probability, shift, np.int64(0))
        used = [index for index in range(count) if probability[index].any()]
        return GroundedAction(
            action.name,
            action.enabled,
            tuple(Table(scope, probability[index]) for index in used),
            tuple(Table(scope, shift[index]) for index in used),
            True,
            action.changes,
            action.cost,
        )


def merge_outcomes(
    probability: NDArray[np.float64], target: NDArray[np.int64], nowhere: NDArray[np.int64] | np.int64
) -> None:
    """Merges, in place, outcomes with the same target into the first; one that cannot happen goes `nowhere`.

    Both arrays are [k, ...].
    """
    for later in range(1, len(probability)):
        for earlier in range(later):
            same = (target[later] == target[earlier]) & (probability[earlier] > 0)
            probability[earlier] += np.where(same, probability[later], 0.0)
            probability[later] = np.where(same, 0.0, probability[later])
    target[...] = np.where(probability > 0, target, nowhere)


def _snap(probability: Array) -> Array:
    value = np.asarray(probability, dtype=np.float64)
    return np.where(np.abs(value) < _NEGLIGIBLE, 0.0, value)


def _positive(probability: Array) -> Array:
    return np.asarray(probability > 0)


def _impossible(probability: Array) -> Array:
    return np.asarray(~(probability > 0))


def _negative(digit: Array) -> Array:
    return np.asarray(digit < 0)


def _outside_unit(probability: Array) -> Array:
    return np.asarray(~((probability >= 0) & (probability <= 1 + _TOLERANCE)))


def _not_one(total: Array) -> Array:
    return np.asarray(~(np.abs(total - 1) <= _TOLERANCE))
