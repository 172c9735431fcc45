"""What a solver finds: a policy over all states and bounds of its values where the plan starts."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray


@dataclass(frozen=True, slots=True, eq=False)
class Solution:
    """Arrays by row (the memories that decide nothing, in order) and state, after reading the state's label.

    R rows, S states, K accepting end components. `steps` are bounds of the least expected steps, `lower` and `upper` of
    the greatest probability, in the state that was asked for.
    """

    letter: NDArray[np.signedinteger]  # [S]  what is read in a state, or INVALID
    action: NDArray[np.signedinteger]  # [R, S]  index, NOTHING or WAIT
    probability: NDArray[Any]  # [R, S]
    expected_steps: NDArray[np.float64]  # [R, S]
    lower: float
    upper: float
    steps: tuple[float, float]
    component: NDArray[np.int32] | None  # [R, S]  the end component, -1 for none; None where there is none at all
    rounds: NDArray[np.float64]  # [K, 2]  bounds of the expected steps of a round


def smallest(array: NDArray[np.integer]) -> NDArray[np.signedinteger]:
    """The same numbers in the narrowest signed type that holds them."""
    low, high = int(array.min(initial=0)), int(array.max(initial=0))
    kind = next(k for k in (np.int8, np.int16, np.int32) if np.iinfo(k).min <= low and high <= np.iinfo(k).max)
    return array.astype(kind)
