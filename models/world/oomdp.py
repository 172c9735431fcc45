"""The world of an OO-MDP environment, as array operations."""

from __future__ import annotations

from collections.abc import Sequence
from functools import cached_property
from math import prod

import numpy as np
from numpy.typing import NDArray

from models.logic.formula import Atom
from models.world.actions import GroundedAction, ground_actions, merge_outcomes
from models.world.algebra import Algebra, Array, Batch, Box, Frame, Value, evaluate
from models.world.errors import StateError, WorldError
from models.world.evaluator import Evaluator
from models.world.expression import ExpressionError
from models.world.factors import Factored, factor
from models.world.limits import MAX_STATES
from models.world.model import Model
from models.world.names import NONE
from models.world.resolution import bind_names
from models.world.states import decode_state, encode_state
from models.world.transitions import Transitions, scaled
from models.world.vocabulary import Vocabulary
from models.world.world import Outcomes, State, Variable


class OomdpWorld:
    """See `World`. Every guard, probability and effect is a function of the few variables it touches."""

    listed: Transitions | None = None

    def __init__(self, model: Model, vocabulary: Vocabulary) -> None:
        """Compiles; raises ActionError for an action that is wrong, ExpressionError for too much work."""
        self.name = model.name
        self.model = model
        ranges = {id(v.values): v.values for v in model.variables}  # few tuples, shared by many variables
        names = {key: tuple(v.name if v else NONE for v in values) for key, values in ranges.items()}
        self.variables = tuple(Variable(v.owner.name, v.attribute, names[id(v.values)]) for v in model.variables)
        self._vocabulary = vocabulary
        self._radix = tuple(len(variable.values) for variable in self.variables)
        self.size = prod(self._radix)
        self._strides = _strides(self._radix)
        self._evaluator = Evaluator(model, Algebra(self._radix))
        self._box = Box(self._radix, tuple(v for v, count in enumerate(self._radix) if count > 1))
        constraints = tuple(self._evaluator.evaluate(text, {}) for text in model.domain.constraints)
        self._valid = self._evaluator.connect(True, constraints)
        # A world too large for its dense indices to be 64-bit is checked all the same, with no shifts.
        strides = self._strides if self.size <= MAX_STATES else (0,) * len(self._strides)
        self._actions = tuple(ground_actions(self._evaluator, strides, constraints))
        self.actions = tuple(action.name for action in self._actions)
        self.initial = sum(digit * stride for digit, stride in zip(model.initial, self._strides, strict=True))

    def valid(self, states: NDArray[np.int64] | None = None) -> NDArray[np.bool_]:
        """See `World.valid`."""
        return self._truth(self._valid, states)

    def encode(self, state: State, *, base: int | None = None) -> int:
        """See `World.encode`."""
        index = encode_state(state, self.variables, self._strides, self.initial if base is None else base)
        if not self.is_valid(index):
            raise StateError("the state breaks a constraint of the domain")
        return index

    def is_valid(self, index: int) -> bool:
        """Whether one state satisfies the constraints, in a world of any size."""
        return self._true(self._valid, index)

    def holds(self, atom: Atom, index: int) -> bool:
        """Whether an atom holds in one state, in a world of any size; raises as `labels`."""
        return self._true(self._proposition(atom), index)

    def decode(self, index: int) -> dict[str, dict[str, str]]:
        """See `World.decode`."""
        return decode_state(index, self.variables, self._strides)

    def labels(self, atoms: Sequence[Atom], states: NDArray[np.int64] | None = None) -> NDArray[np.bool_]:
        """See `World.labels`."""
        count = self.size if states is None else len(states)
        result = np.empty((len(atoms), count), dtype=np.bool_)
        for row, atom in enumerate(atoms):
            result[row] = self._truth(self._proposition(atom), states)
        return result

    def outcomes(self, action: int, states: NDArray[np.int64] | None = None) -> Outcomes:
        """See `World.outcomes`."""
        self._require_indices()
        frame, here = self._frame(states)
        return _outcomes(self._actions[action], frame, here)

    def cost(self, action: int, states: NDArray[np.int64] | None = None) -> NDArray[np.float64]:
        """See `World.cost`."""
        return np.full(self.size if states is None else len(states), self._actions[action].cost)

    @cached_property
    def factored(self) -> Factored | None:
        """The dynamics as small tables; None where a guard or an effect has no such form, or the world is too large."""
        if self.size > MAX_STATES:
            return None
        self._evaluator.renew()
        try:
            return factor(self._evaluator.algebra, self._strides, self._valid, self._actions)
        except ExpressionError:  # more work than is allowed
            return None

    def reads(self, atoms: Sequence[Atom]) -> frozenset[int]:
        """The positions of the variables that atoms depend on; raises as `labels`."""
        return frozenset(position for atom in atoms for position in self._proposition(atom).scope)

    def _proposition(self, atom: Atom) -> Value:
        symbols = bind_names(atom, self._vocabulary)
        self._evaluator.renew()
        try:
            return self._evaluator.call(atom.function, [self._evaluator.symbol(symbol) for symbol in symbols])
        except ExpressionError as error:
            raise WorldError(f"{atom.function}: {error}") from None

    def _truth(self, value: Value, states: NDArray[np.int64] | None) -> NDArray[np.bool_]:
        self._require_indices()
        frame, here = self._frame(states)
        return np.array(np.broadcast_to(evaluate(value, frame), here.shape)).reshape(-1)

    def _true(self, value: Value, index: int) -> bool:
        """Whether a value is true in one state, whose index may be beyond 64 bits."""
        digits = {v: np.array([index // self._strides[v] % self._radix[v]]) for v in value.scope}
        batch = Batch(self._radix, self._strides, np.zeros(1, dtype=np.int64), digits)
        return bool(np.all(evaluate(value, batch)))

    def _frame(self, states: NDArray[np.int64] | None) -> tuple[Frame, NDArray[np.int64]]:
        """All states or some, and their indices in the frame's shape."""
        if states is not None:
            return Batch(self._radix, self._strides, states), states
        return self._box, np.arange(self.size, dtype=np.int64).reshape(self._box.shape)

    def _require_indices(self) -> None:
        if self.size > MAX_STATES:
            raise WorldError(f"{self.name} is too large to compute with: {self.size} states, at most {MAX_STATES}")


def _outcomes(action: GroundedAction, frame: Frame, here: NDArray[np.int64]) -> Outcomes:
    memo: dict[Value, Array] = {}
    count, shape = len(action.probabilities), here.shape
    enabled = np.array(np.broadcast_to(evaluate(action.enabled, frame, memo), shape))
    probability = np.zeros((count, *shape))
    successor = np.zeros((count, *shape), dtype=np.int64)
    for index, (chance, shift) in enumerate(zip(action.probabilities, action.shifts, strict=True)):
        np.copyto(probability[index], evaluate(chance, frame, memo), where=enabled)
        np.copyto(successor[index], evaluate(shift, frame, memo), where=enabled)
        successor[index] += here
    if not action.merged:
        merge_outcomes(probability, successor, here)
    probability = scaled(probability, probability.sum(axis=0))
    return Outcomes(enabled.reshape(-1), probability.reshape(count, -1), successor.reshape(count, -1))


def _strides(radix: tuple[int, ...]) -> tuple[int, ...]:
    strides = [1] * len(radix)
    for position in range(len(radix) - 2, -1, -1):
        strides[position] = strides[position + 1] * radix[position + 1]
    return tuple(strides)
