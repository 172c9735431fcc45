"""The mixed-radix numbering of states, from the variables alone, so that a stored policy needs no world."""

from __future__ import annotations

from collections.abc import Sequence
from math import prod

from models.world import Variable


def strides(variables: Sequence[Variable]) -> tuple[int, ...]:
    """How much one digit of each variable counts; the first variable is the most significant."""
    sizes = [len(variable.values) for variable in variables]
    return tuple(prod(sizes[place + 1 :]) for place in range(len(sizes)))


def size(variables: Sequence[Variable]) -> int:
    """Number of state indices."""
    return prod(len(variable.values) for variable in variables)
