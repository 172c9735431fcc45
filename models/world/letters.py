"""How alike texts can be at most, by their letters alone: many at once."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

_BINS = 64  # letters are counted modulo this: those that share a bin only make the bound looser


class LetterCounts:
    """Texts of at most 255 characters, by how often each letter occurs in them."""

    def __init__(self, texts: Sequence[str]) -> None:
        self._lengths = np.array([len(text) for text in texts], dtype=np.int64)  # [N]
        rows = np.repeat(np.arange(len(texts)), self._lengths) * _BINS
        counts = np.bincount(rows + _bins("".join(texts)), minlength=len(texts) * _BINS)
        self._counts = counts.reshape(len(texts), _BINS).astype(np.uint8)  # [N, bins]

    def bounds(self, text: str) -> NDArray[np.float64]:
        """For each text, a number [N] that the `ratio` of `difflib.SequenceMatcher` with `text` does not exceed."""
        counts = np.bincount(_bins(text), minlength=_BINS).astype(np.uint8)
        common = np.minimum(self._counts, counts).sum(axis=1, dtype=np.int64)
        bounds: NDArray[np.float64] = 2.0 * common / np.maximum(self._lengths + len(text), 1)
        return bounds


def _bins(text: str) -> NDArray[np.int64]:
    return np.frombuffer(text.encode("utf-32-le"), dtype=np.uint32).astype(np.int64) % _BINS
