"""The transitions of a world, listed."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

STAY = -1
"""The action of a state in which no action is enabled: nothing is done and the state stays."""


@dataclass(frozen=True, slots=True, eq=False)
class Transitions:
    """Choices (a state with one of its enabled actions) sorted by state, then by action; outcomes sorted by choice.

    All probabilities are positive, and those of a choice sum to 1 up to rounding (`scaled`). C choices, E outcomes.
    """

    first_choice: NDArray[np.int32]  # [S + 1]
    action: NDArray[np.int32]  # [C]  index of the action, or STAY
    cost: NDArray[np.float64]  # [C]
    first_outcome: NDArray[np.int32]  # [C + 1]
    successor: NDArray[np.int32]  # [E]
    probability: NDArray[np.float64]  # [E]


ROUNDOFF = 1e-15
"""How far the probabilities of a choice may be from 1 in sum without being scaled."""


def scaled(probability: NDArray[np.float64], total: NDArray[np.float64]) -> NDArray[np.float64]:
    """Probabilities exact to rounding: a world may give some that sum to 1 only nearly, which long runs would notice.

    `total` are the sums, in a shape that broadcasts.
    """
    off = np.abs(total - 1) > ROUNDOFF
    return probability / np.where(off & (total > 0), total, 1.0) if off.any() else probability
