"""A policy: what a robot does in every state with every memory.

The robot's loop: observe the state s, look up (memory, s), keep the memory that comes back, do the action,
observe again. Memory starts at `initial_memory`: it is the state of the formula's automaton. The lookup reads the
label of s, `after = successors[memory, letter[s]]`, and what to do stands in the row of `after`. Where no action is
enabled there is none to do, though nothing is decided: the robot lets one step pass and observes again.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any, Literal

import numpy as np
from numpy.typing import NDArray

from models.errors import Place
from models.planning import codec
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
"""In `letter`: the state breaks the world's constraints."""

MAX_PLACES = 20
"""Most attributes named that a state leaves out."""

Status = Literal["running", "sustaining", "satisfied", "lost"]


@dataclass(frozen=True, slots=True)
class Step:
    """What to do now.

    `status` is "satisfied" (`done`: the formula holds whatever follows; stop), "sustaining" (the formula holds if the
    robot goes on for ever as the policy says), "lost" (it cannot be satisfied from here, `probability` is 0 and
    `action` None: a robot should stop and ask for another task) or "running". `action` may be None while the status is
    "running" or "sustaining": the world enables no action in this state, so there is nothing to do but to let one step
    pass, then observe and ask again with the new memory. Hence None alone does not mean the end; `status` does.
    `expected_steps` counts the steps, waits included, until the status is another than "running"; `probability` is that
    of satisfying the formula.
    """

    action: str | None  # None: stop if the status is "satisfied" or "lost", else wait one step
    memory: int  # after reading the label of the state: the one to send with the next state
    probability: float
    expected_steps: float
    done: bool
    status: Status


@dataclass(frozen=True, slots=True, eq=False)
class Policy:
    """Arrays over states, for each memory that decides nothing, and the names to read them with.

    Every product state has its entry, also those that the initial state never leads to, so a robot that was
    moved may carry on from where it is. Q memories, L letters, S places, R rows: the memories in which the formula is
    neither sure to hold nor sure to fail. A place is a state as far as the policy tells states apart: Σ stride · digit
    over the variables. One with the stride 0 does not matter as long as its digit is `harmless`. Where `indices` is not
    None, only states with a sum in there were planned for, as no other can be reached; the place is that in `indices`.
    """

    variables: tuple[Variable, ...]  # the digits of a state index, the most significant first
    strides: tuple[int, ...]  # by variable, for the place
    harmless: tuple[tuple[int, ...], ...]  # by variable: the digits for which the policy was made
    indices: NDArray[np.int64] | None  # [S] ascending; None: every place is one of its own
    actions: tuple[str, ...]
    formula: str  # infix
    atoms: tuple[str, ...]  # infix; bit i of a letter of the automaton
    hoa: str  # the automaton
    initial_state: int
    initial_memory: int
    successors: NDArray[np.int32]  # [Q, L]
    accepted: NDArray[np.bool_]  # [Q]  the formula holds whatever follows
    row: NDArray[np.int32]  # [Q]  the row of a memory, -1 where it is decided
    letter: NDArray[np.signedinteger]  # [S]  what is read in a state, or INVALID
    action: NDArray[np.signedinteger]  # [R, S] after reading; index into `actions`, NOTHING or WAIT
    probability: NDArray[Any]  # [R, S] after reading; of satisfying the formula under this policy
    expected_steps: NDArray[np.float64]  # [R, S] after reading; until it is decided, or only has to be kept up

    @property
    def places(self) -> int:
        """Number of places, S."""
        return len(self.letter)

    @property
    def states(self) -> int:
        """Number of state indices of the world."""
        return codec.size(self.variables)

    @property
    def memories(self) -> int:
        """Number of memories, Q."""
        return len(self.row)

    def place(self, state: NDArray[np.int64]) -> NDArray[np.int64]:
        """The places of states of the world; of one that was not planned for, another's (see `planned`)."""
        found = self._sum(state)
        if self.indices is None:
            return found
        return np.minimum(np.searchsorted(self.indices, found), len(self.indices) - 1)

    def planned(self, state: NDArray[np.int64]) -> NDArray[np.bool_]:
        """Whether states of the world are among those planned for."""
        if self.indices is None:
            return np.ones(state.shape, dtype=np.bool_)
        known: NDArray[np.bool_] = self.indices[self.place(state)] == self._sum(state)
        return known

    def _sum(self, state: NDArray[np.int64]) -> NDArray[np.int64]:
        """Σ stride · digit."""
        outer = codec.strides(self.variables)
        if self.strides == outer:
            return state
        found = np.zeros_like(state)
        for variable, inner, stride in zip(self.variables, self.strides, outer, strict=True):
            found += state // stride % len(variable.values) * inner
        return found

    def reading(self, state: NDArray[np.int64]) -> NDArray[np.signedinteger]:
        """What is read in states of the world."""
        letter: NDArray[np.signedinteger] = self.letter[self.place(state)]
        return letter

    def after(self, state: NDArray[np.int64], memory: NDArray[np.int32]) -> NDArray[np.int32]:
        """The memories after reading valid states; shapes broadcast."""
        after: NDArray[np.int32] = self.successors[memory, self.reading(state)]
        return after

    def acting(self, state: NDArray[np.int64], after: NDArray[np.int32]) -> NDArray[np.int64]:
        """Index into `actions`, NOTHING or WAIT, by state and memory after reading it; shapes broadcast."""
        row = self.row[after]
        found = np.where(row >= 0, self.action[row, self.place(state)] if len(self.action) else NOTHING, NOTHING)
        return found.astype(np.int64)

    def sustaining(self, state: NDArray[np.int64], after: NDArray[np.int32]) -> NDArray[np.bool_]:
        """Whether the formula holds if the policy is followed for ever; arguments as for `acting`."""
        settled = self.expected_steps[self.row[after], self.place(state)] == 0 if len(self.action) else False
        going: NDArray[np.bool_] = settled & (self.acting(state, after) != NOTHING)
        return going

    def encode(self, state: State, *, base: int | None = None) -> int:
        """The index of a state; what it leaves out is taken from `base` (default: the initial state).

        Raises StateError for what the world does not have, and for a state that breaks its constraints.
        """
        index = self._index(state, base)
        self._check(index)
        return index

    def decode(self, index: int) -> dict[str, dict[str, str]]:
        """The state of an index: object -> attribute -> value."""
        return decode_state(index, self.variables, codec.strides(self.variables))

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
        place = int(self.place(np.array([index]))[0])
        after = int(self.successors[memory, self.letter[place]])
        row = int(self.row[after])
        if row < 0:
            done = bool(self.accepted[after])
            return Step(None, after, float(done), 0.0, done, "satisfied" if done else "lost")
        action = int(self.action[row, place])
        steps = float(self.expected_steps[row, place])
        return Step(
            action=self.actions[action] if action >= 0 else None,
            memory=after,
            probability=float(self.probability[row, place]),
            expected_steps=steps,
            done=False,
            status="lost" if action == NOTHING else "sustaining" if steps == 0 else "running",
        )

    def _index(self, state: State, base: int | None) -> int:
        """As `encode`, constraints not looked at."""
        start = self.initial_state if base is None else base
        return encode_state(state, self.variables, codec.strides(self.variables), start)

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
        state = np.array([index])
        if not self.planned(state)[0]:
            raise StateError("the plan was made for what can be reached from where it began; this cannot: plan again")
        if self.letter[int(self.place(state)[0])] == INVALID:
            raise StateError(f"the world does not allow this state: {self.decode(index)}")
        for variable, outer, allowed in zip(self.variables, codec.strides(self.variables), self.harmless, strict=True):
            digit = index // outer % len(variable.values)
            if len(allowed) < len(variable.values) and digit not in allowed:
                where = f"{variable.object}.{variable.attribute} is {variable.values[digit]}"
                detail = f"the plan was made for states in which this does not matter, but here {where}: plan again"
                raise StateError(detail, places=[Place(pointer((variable.object, variable.attribute)), detail)])
