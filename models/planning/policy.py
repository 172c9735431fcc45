"""A policy: what a robot does in every state with every memory.

The robot's loop: observe the state s, look up (memory, s), keep the memory that comes back, do the action,
observe again. Memory starts at `initial_memory`. The lookup reads the label of s, so arrays are indexed by
the memory *before* reading. Where no action is enabled there is none to do, though nothing is decided: the
robot lets one step pass and observes again.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Literal

import numpy as np
from numpy.typing import NDArray

from models.errors import Place
from models.planning.codec import strides
from models.planning.errors import InvalidMemoryError
from models.world import State, StateError, Variable
from models.world.names import clipped
from models.world.report import pointer
from models.world.states import decode_state, encode_state

NOTHING = -1
"""In `action`: the outcome is decided, or the state is invalid; there is nothing to do."""

WAIT = -2
"""In `action`: no action is enabled; let one step pass."""

INVALID = -1
"""In `next_memory`: the state breaks the world's constraints."""

MAX_PLACES = 20
"""Most attributes named that a state leaves out."""

Status = Literal["running", "satisfied", "lost"]


@dataclass(frozen=True, slots=True)
class Step:
    """What to do now.

    `status` is "satisfied" (`done`: the formula holds whatever follows; stop), "lost" (it cannot be satisfied
    from here, `probability` is 0 and `action` None: a robot should stop and ask for another task) or
    "running". `action` may be None while the status is "running": the world enables no action in this state,
    so there is nothing to do but to let one step pass, then observe and ask again with the new memory. Hence
    None alone does not mean the end; `status` does. `expected_steps` counts the steps, waits included, until
    the status is one of the first two; `probability` is that of "satisfied".
    """

    action: str | None  # None: wait one step if `status` is "running", else stop
    memory: int  # after reading the label of the state: the one to send with the next state
    probability: float
    expected_steps: float
    done: bool
    status: Status


@dataclass(frozen=True, slots=True, eq=False)
class Policy:
    """Arrays over (memory before reading, state), and the names to read them with.

    Every product state has its entry, also those that the initial state never leads to, so a robot that was
    moved may carry on from where it is. Q memories, S states.
    """

    variables: tuple[Variable, ...]  # the digits of a state index, the most significant first
    actions: tuple[str, ...]
    formula: str  # infix
    atoms: tuple[str, ...]  # infix; bit i of a letter of the automaton
    hoa: str  # the automaton
    initial_state: int
    initial_memory: int
    accepted: NDArray[np.bool_]  # [Q]  the formula holds whatever follows
    action: NDArray[np.int32]  # [Q, S]  index into `actions`, NOTHING or WAIT
    next_memory: NDArray[np.int32]  # [Q, S]  after reading the label of the state, or INVALID
    probability: NDArray[np.float64]  # [Q, S]  of satisfying the formula under this policy
    expected_steps: NDArray[np.float64]  # [Q, S]  until the outcome is decided under this policy

    @property
    def states(self) -> int:
        """Number of state indices, S."""
        return int(self.action.shape[1])

    @property
    def memories(self) -> int:
        """Number of memories, Q."""
        return int(self.action.shape[0])

    def encode(self, state: State, *, base: int | None = None) -> int:
        """The index of a state; what it leaves out is taken from `base` (default: the initial state).

        Raises StateError for what the world does not have, and for a state that breaks its constraints.
        """
        index = self._index(state, base)
        self._check(index)
        return index

    def decode(self, index: int) -> dict[str, dict[str, str]]:
        """The state of an index: object -> attribute -> value."""
        return decode_state(index, self.variables, strides(self.variables))

    def step(self, state: int | State, memory: int) -> Step:
        """What to do in `state` (an index, or by name) with the memory before its label is read.

        A state by name is complete: what was not observed is not made up. Raises StateError for a state that
        leaves out an attribute, has what the world does not, or breaks its constraints, and
        InvalidMemoryError for a memory the policy does not have.
        """
        if not 0 <= memory < self.memories:
            raise InvalidMemoryError(f"memory {memory} is not one of 0 to {self.memories - 1}")
        index = self._observed(state) if isinstance(state, Mapping) else state
        self._check(index)
        action = int(self.action[memory, index])
        probability = float(self.probability[memory, index])
        after = int(self.next_memory[memory, index])
        done = bool(self.accepted[after])
        return Step(
            action=self.actions[action] if action >= 0 else None,
            memory=after,
            probability=probability,
            expected_steps=float(self.expected_steps[memory, index]),
            done=done,
            status="satisfied" if done else "running" if action != NOTHING else "lost",
        )

    def _index(self, state: State, base: int | None) -> int:
        """As `encode`, constraints not looked at."""
        start = self.initial_state if base is None else base
        return encode_state(state, self.variables, strides(self.variables), start)

    def _observed(self, state: State) -> int:
        """The index of a state that names every variable."""
        index = self._index(state, None)  # wrong names first: a misspelt attribute is missing as well
        missing = [(v.object, v.attribute) for v in self.variables if v.attribute not in state.get(v.object, {})]
        if missing:
            listed = ", ".join(f"{attribute} of {name}" for name, attribute in missing[:MAX_PLACES])
            more = f" and {len(missing) - MAX_PLACES} more" if len(missing) > MAX_PLACES else ""
            raise StateError(
                f"the state is not complete, and a step needs every attribute; missing: {clipped(listed)}{more}",
                places=[Place(pointer(path), "missing") for path in missing[:MAX_PLACES]],
            )
        return index

    def _check(self, index: int) -> None:
        if not 0 <= index < self.states:
            raise StateError(f"state {index} is not one of 0 to {self.states - 1}")
        if self.next_memory[0, index] == INVALID:
            raise StateError(f"the world does not allow this state: {self.decode(index)}")
