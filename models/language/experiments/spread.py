"""What several seeds say together."""

from __future__ import annotations

import statistics
from collections.abc import Sequence
from dataclasses import dataclass

DIGITS = 4
"""Decimal places that results keep."""


@dataclass(frozen=True, slots=True)
class Spread:
    """Mean, standard deviation of the sample (0 of one seed), least and greatest of one number over seeds."""

    mean: float
    deviation: float
    low: float
    high: float

    @classmethod
    def of(cls, values: Sequence[float]) -> Spread:
        """The spread of at least one value."""
        deviation = statistics.stdev(values) if len(values) > 1 else 0.0
        numbers = (statistics.fmean(values), deviation, min(values), max(values))
        return cls(*(round(number, DIGITS) for number in numbers))
