"""Token buckets: how often each client may ask.

A bucket holds up to `burst` tokens and gains `rate` of them a second; a request takes one (RFC 2697 calls the like a
meter). Only so many buckets are kept; the one that was used longest ago is forgotten first, which is to be full again.
"""

from __future__ import annotations

import time
from collections import OrderedDict
from collections.abc import Callable

MOST_CLIENTS = 10_000
"""Buckets that are kept."""


class TokenBuckets:
    """A bucket for each client, by any name; one thread uses them."""

    def __init__(self, rate: float, burst: int, *, clock: Callable[[], float] = time.monotonic) -> None:
        self._rate, self._burst, self._clock = rate, float(burst), clock
        self._buckets: OrderedDict[str, tuple[float, float]] = OrderedDict()  # tokens, when they were counted

    def take(self, client: str) -> float:
        """Take a token: 0, or where there is none, the seconds until there is."""
        now = self._clock()
        tokens, counted = self._buckets.get(client, (self._burst, now))
        tokens = min(self._burst, tokens + (now - counted) * self._rate)
        taken = tokens >= 1.0
        self._buckets[client] = (tokens - 1.0 if taken else tokens, now)
        self._buckets.move_to_end(client)
        if len(self._buckets) > MOST_CLIENTS:
            self._buckets.popitem(last=False)
        return 0.0 if taken else (1.0 - tokens) / self._rate
