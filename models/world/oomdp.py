"""The world of an OO-MDP environment, as array operations."""

from __future__ import annotations

from collections.abc import Sequence
from math import prod

import numpy as np
from numpy.typing import NDArray

from models.logic.formula import Atom
from models.world.actions import GroundedAction, ground_actions, merge_outcomes
from models.world.algebra import Algebra, Batch, Box, Value, evaluate
from models.world.errors import StateError, WorldError
from models.world.evaluator import Evaluator
from models.world.limits import MAX_STATES
from models.world.model import Model
from models.world.names import NONE
from models.world.resolution import bind_names
from models.world.states import decode_state, encode_state
from models.world.vocabulary import Vocabulary
from models.world.world import Outcomes, State, Variable


class OomdpWorld:
    """See `World`. Every guard, probability and effect is a function of the few variables it touches."""

    def __init__(self, model: Model, vocabulary: Vocabulary) -> None:
        """Compiles; raises ActionError for an action that is wrong, ExpressionError for too much work."""
        self.name = model.name
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
        digits = {
            v: np.array([index // s % r]) for v, (s, r) in enumerate(zip(self._strides, self._radix, strict=True))
        }
        batch = Batch(self._radix, self._strides, np.zeros(1, dtype=np.int64), digits)
        return bool(np.all(evaluate(self._valid, batch)))

    def decode(self, index: int) -> dict[str, dict[str, str]]:
        """See `World.decode`."""
        return decode_state(index, self.variables, self._strides)

    def labels(self, atoms: Sequence[Atom], states: NDArray[np.int64] | None = None) -> NDArray[np.bool_]:
        """See `World.labels`."""
        count = self.size if states is None else len(states)
        result = np.empty((len(atoms), count), dtype=np.bool_)
        for row, atom in enumerate(atoms):
            symbols = bind_names(atom, self._vocabulary)
            value = self._evaluator.call(atom.function, [self._evaluator.symbol(symbol) for symbol in symbols])
            result[row] = self._truth(value, states)
        return result

    def outcomes(self, action: int, states: NDArray[np.int64] | None = None) -> Outcomes:
        """See `World.outcomes`."""
        self._require_indices()
        chosen = self._actions[action]
        return self._all_outcomes(chosen) if states is None else self._some_outcomes(chosen, states)

    def _truth(self, value: Value, states: NDArray[np.int64] | None) -> NDArray[np.bool_]:
        self._require_indices()
        if states is None:
            return np.array(np.broadcast_to(evaluate(value, self._box), self._box.shape)).reshape(-1)
        return np.array(np.broadcast_to(evaluate(value, self._batch(states)), states.shape))

    def _require_indices(self) -> None:
        if self.size > MAX_STATES:
            raise WorldError(f"{self.name} is too large to compute with: {self.size} states, at most {MAX_STATES}")

    def _batch(self, states: NDArray[np.int64]) -> Batch:
        return Batch(self._radix, self._strides, states)

    def _all_outcomes(self, action: GroundedAction) -> Outcomes:
        shape, count = self._box.shape, len(action.probabilities)
        enabled = np.array(np.broadcast_to(evaluate(action.enabled, self._box), shape))
        probability = np.empty((count, *shape))
        successor = np.empty((count, *shape), dtype=np.int64)
        here = np.arange(self.size, dtype=np.int64).reshape(shape)
        for index, (chance, shift) in enumerate(zip(action.probabilities, action.shifts, strict=True)):
            np.multiply(evaluate(chance, self._box), enabled, out=probability[index])
            np.multiply(evaluate(shift, self._box), enabled, out=successor[index])
            successor[index] += here
        if not action.merged:
            merge_outcomes(probability, successor, here)
        return Outcomes(enabled.reshape(-1), probability.reshape(count, -1), successor.reshape(count, -1))

    def _some_outcomes(self, action: GroundedAction, states: NDArray[np.int64]) -> Outcomes:
        batch, count = self._batch(states), len(action.probabilities)
        enabled = np.array(np.broadcast_to(evaluate(action.enabled, batch), states.shape))
        probability = np.empty((count, len(states)))
        successor = np.empty((count, len(states)), dtype=np.int64)
        for index, (chance, shift) in enumerate(zip(action.probabilities, action.shifts, strict=True)):
            np.multiply(evaluate(chance, batch), enabled, out=probability[index])
            np.multiply(evaluate(shift, batch), enabled, out=successor[index])
            successor[index] += states
        if not action.merged:
            merge_outcomes(probability, successor, states)
        return Outcomes(enabled, probability, successor)


def _strides(radix: tuple[int, ...]) -> tuple[int, ...]:
    strides = [1] * len(radix)
    for position in range(len(radix) - 2, -1, -1):
        strides[position] = strides[position + 1] * radix[position + 1]
    return tuple(strides)
