"""What planning consumes: a finite world with named variables, named actions and vectorised dynamics.

A state is one dense integer, a mixed-radix number: the first variable is the most significant digit. All
arrays are indexed by such numbers, or by batches of them.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Protocol

import numpy as np
from numpy.typing import NDArray

from models.logic.formula import Atom
from models.world.transitions import Transitions

State = Mapping[str, Mapping[str, str]]
"""object -> attribute -> value, all by name."""


@dataclass(frozen=True, slots=True)
class Variable:
    """One state variable: an attribute of an object over a finite list of value names."""

    object: str
    attribute: str
    values: tuple[str, ...]


@dataclass(frozen=True, slots=True, eq=False)
class Outcomes:
    """What one action does in `n` states: `k` outcomes each.

    Where `enabled`, the probabilities of a state's outcomes sum to 1, outcomes with the same successor are
    merged into the first of them, and an outcome that cannot happen has probability 0 and the state itself as
    successor. Where not enabled every probability is 0 and every successor is the state itself.
    """

    enabled: NDArray[np.bool_]  # [n]
    probability: NDArray[np.float64]  # [k, n]
    successor: NDArray[np.int64]  # [k, n]


class World(Protocol):
    """A compiled environment.

    The label of the initial state counts; each action enters a state whose label is read next. A state in
    which no action is enabled stops for ever.
    """

    @property
    def name(self) -> str:
        """The environment's name."""

    @property
    def variables(self) -> tuple[Variable, ...]:
        """The digits of a state, the most significant first."""

    @property
    def actions(self) -> tuple[str, ...]:
        """Grounded action names: `north`, `pick(cylinder)`."""

    @property
    def size(self) -> int:
        """Number of dense state indices: the product of the variables' sizes."""

    @property
    def initial(self) -> int:
        """The index of the environment's initial state."""

    def valid(self, states: NDArray[np.int64] | None = None) -> NDArray[np.bool_]:
        """[n] whether a state satisfies the domain's constraints; None is all states in order.

        Every successor of a valid state is valid.
        """

    def encode(self, state: State, *, base: int | None = None) -> int:
        """The index of a state; what it leaves out is taken from `base` (default: the initial state).

        Raises StateError (with places in `state`) for an unknown object, attribute or value, or a forbidden
        state.
        """

    def decode(self, index: int) -> dict[str, dict[str, str]]:
        """The state of an index, in the order of `variables`; inverse of `encode`."""

    def labels(self, atoms: Sequence[Atom], states: NDArray[np.int64] | None = None) -> NDArray[np.bool_]:
        """[len(atoms), n] which atoms hold in which states; None is all states in order.

        Raises UnknownPropositionError, UnknownObjectError or TypeMismatchError for an atom not of this world.
        """

    def outcomes(self, action: int, states: NDArray[np.int64] | None = None) -> Outcomes:
        """What the action at an index of `actions` does in `states`; None is all states in order."""

    def cost(self, action: int, states: NDArray[np.int64] | None = None) -> NDArray[np.float64]:
        """[n] what it costs to do the action in `states` where it is enabled, above 0; None is all states in order."""

    @property
    def listed(self) -> Transitions | None:
        """The transitions, where the world has them listed already."""
