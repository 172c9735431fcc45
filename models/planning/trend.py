"""How many sweeps an iteration still needs, judging by how fast it has closed in on its aim so far.

What ends an iteration (a rise, a gap, a number of values that still change) shrinks by about the same ratio in every
sweep once the slowest part is all that is left. The ratio of the last sweeps, extrapolated to the aim, is the estimate.
"""

from __future__ import annotations

import math
from collections import deque

WINDOW = 40
"""Sweeps that the ratio is taken over."""

UNKNOWN = math.nan
"""Sweeps left where there is no telling."""


class Trend:
    """What is left of one iteration that ends when its measure is at most `aim`, or after `most` sweeps."""

    def __init__(self, aim: float, *, most: float = math.inf) -> None:
        self._aim, self._most = math.log(aim), most
        self._sweeps = 0
        self._first = self._least = math.inf  # logarithms of the measure
        self._recent: deque[float] = deque(maxlen=WINDOW)  # the least so far, after each sweep

    def left(self, measure: float) -> float:
        """Sweeps left after another sweep, at the end of which the measure is this; UNKNOWN before it ever shrank."""
        self._sweeps += 1
        now = math.log(measure) if measure > 0 else -math.inf
        if now <= self._aim:
            return 0.0
        if self._first == math.inf:
            self._first = now
        self._least = min(self._least, now)
        self._recent.append(self._least)
        rate = (self._recent[0] - self._least) / max(1, len(self._recent) - 1)
        if rate <= 0:  # it pauses: over all sweeps
            rate = (self._first - self._least) / max(1, self._sweeps - 1)
        if not 0 < rate < math.inf:
            return UNKNOWN
        return min((self._least - self._aim) / rate, max(0.0, self._most - self._sweeps))
