"""The optimality operator of a numeric problem, and where it runs: compiled loops on a CPU, tensors on a CUDA device.

Both improve the same vectors towards the same values; only the order of a sweep differs.
"""

from __future__ import annotations

from typing import Any, Protocol

import numpy as np
from numpy.typing import NDArray

from models.planning.choices import Choices, Vector
from models.planning.errors import DeviceUnavailableError
from models.planning.kernels import sweeps
from models.planning.options import Device

DEVICE_FROM = 1_000_000
"""Outcomes from which device "auto" moves to a CUDA device."""


PASSES = 10
"""Most passes over the choices taken, for one over all of them: they are a fraction of all, and mostly stay."""

SETTLED = 0.1
"""How much less a pass changes than the one over all choices when another is not worth it."""

LEAP = 4
"""Passes over the choices taken, between one extrapolation and the next."""

LEAST_RATIO, MOST_RATIO = 0.3, 0.99
"""Ratios of the change in a pass to that in the one before between which values are extrapolated."""


class Operator(Protocol):
    """One pass at a time over `choices`. Vectors are the operator's own: `vector` makes them, `numpy` reads them."""

    choices: Choices

    def vector(self, values: Vector | float) -> Any:
        """[n] from values by unknown, or one value for all."""

    def numpy(self, x: Any) -> Vector:
        """[n] values by unknown."""

    def at(self, x: Any, unknown: int) -> float:
        """The value of one unknown."""

    def narrow(self, lower: Any, upper: Any, sweep: int) -> float:
        """Improve bounds of maximal values in place, rounded outwards; returns the greatest gap."""

    def ascend(self, lower: Any) -> float:
        """Modified policy iteration on lower bounds of maximal values, in place, rounded down; see `improve`. What a
        policy makes of a lower bound is one. Returns the greatest rise in the first pass.
        """

    def cover(self, upper: Any) -> float:
        """One pass over candidates for upper bounds of maximal values, in place, rounded up; returns how much one grew
        at most. Where none grew all are upper bounds.
        """

    def improve(self, x: Any) -> float:
        """Modified policy iteration on minimal values, in place: one pass over all choices, and a few over those that
        were the best (Puterman and Shin, "Modified policy iteration algorithms for discounted Markov decision
        problems", 1978). Returns the greatest change in the first pass.
        """

    def settle(self, x: Any, sweep: int) -> float:
        """One step of the chain, where each unknown has one choice, in place; returns the greatest change."""

    def greedy(self, x: Any, *, maximise: bool, tie: float, least: float = 1.0) -> tuple[NDArray[Any], float, float]:
        """[n] by unknown, the first choice whose value is best up to `tie` · max(least, |best|).

        Also how far the value of a choice taken exceeds `x`, at most, and how far the best one falls short.
        """


class KernelOperator:
    """See `Operator`: Gauss-Seidel sweeps in alternating directions, on one thread."""

    def __init__(self, choices: Choices) -> None:
        self.choices = choices
        self._arrays = choices.arrays
        self._chain = np.arange(choices.unknowns, dtype=np.uint32)
        self._policy = self._arrays[0][:-1].copy()
        self._difference, self._saved = np.empty(choices.unknowns), np.empty(choices.unknowns)
        self._leaps = True

    def vector(self, values: Vector | float) -> Vector:
        """See `Operator.vector`."""
        return np.full(self.choices.unknowns, values) if isinstance(values, float) else values.astype(np.float64)

    def numpy(self, x: Vector) -> Vector:
        """See `Operator.numpy`."""
        return x

    def at(self, x: Vector, unknown: int) -> float:
        """See `Operator.at`."""
        return float(x[unknown])

    def narrow(self, lower: Vector, upper: Vector, sweep: int) -> float:
        """See `Operator.narrow`."""
        return float(sweeps.narrow(*self._arrays, lower, upper, self.choices.roundoff, sweep % 2 == 0))

    def ascend(self, lower: Vector) -> float:
        """See `Operator.ascend`."""
        margin = self.choices.roundoff
        rise = float(sweeps.ascend(*self._arrays, lower, margin, self._policy))
        for _ in range(PASSES):
            if sweeps.follow(self._policy, *self._arrays[1:], lower, margin) <= SETTLED * rise:
                break
        return rise

    def cover(self, upper: Vector) -> float:
        """See `Operator.cover`."""
        return float(sweeps.cover(*self._arrays, upper, self.choices.roundoff))

    def improve(self, x: Vector) -> float:
        """See `Operator.improve`. The slowest part of what is missing shrinks by one ratio in every pass, so its sum is
        added at once: MacQueen, "A modified dynamic programming method for Markovian decision problems" (1966), without
        the bounds. What does not bring the passes closer to each other is taken back, and not tried again.
        """
        change = float(sweeps.improve(*self._arrays, x, self._policy))
        total, leaped = np.inf, False
        for number in range(1, PASSES + 1):
            before = total
            small, total = sweeps.advance(self._policy, *self._arrays[1:], x, self._difference)
            if leaped and total > before:
                self._leaps, leaped = False, False
                np.copyto(x, self._saved)
                continue
            ratio, leaped = (total / before if before > 0 else 0.0), False
            if small <= SETTLED * change:
                break
            if self._leaps and number % LEAP == 0 and LEAST_RATIO < ratio < MOST_RATIO:
                np.copyto(self._saved, x)
                x += self._difference * (ratio / (1.0 - ratio))
                total, leaped = total * ratio, True
        return change

    def settle(self, x: Vector, sweep: int) -> float:
        """See `Operator.settle`."""
        return float(sweeps.settle(self._chain, *self._arrays[1:], x, sweep % 2 == 0))

    def greedy(
        self, x: Vector, *, maximise: bool, tie: float, least: float = 1.0
    ) -> tuple[NDArray[np.int32], float, float]:
        """See `Operator.greedy`."""
        policy = np.empty(self.choices.unknowns, dtype=np.int32)
        above, below = sweeps.greedy(*self._arrays, x, maximise, tie, least, policy)
        return policy, float(above), float(below)


def operator_of(choices: Choices, device: Device) -> Operator:
    """The operator on the device asked for; raises DeviceUnavailableError."""
    if device == "cpu" or (device == "auto" and len(choices.successor) < DEVICE_FROM):
        return KernelOperator(choices)
    import torch  # seconds to load, and of no use without a CUDA device

    if torch.cuda.is_available():
        from models.planning.tensors import TensorOperator

        return TensorOperator(choices, torch.device("cuda"))
    if device == "cuda":
        raise DeviceUnavailableError("there is no CUDA device on this machine")
    return KernelOperator(choices)
