"""What a trained network of `models.language.matching.network` makes of the vectors of one text, without torch.

Shapes: S words, D encoder, V its upper half, R of roles, M mentions, W ways to see which words are free, 3 tags.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from models.language.matching.config import LEFT, ON, OUTSIDE, TAGS, MatchConfig
from models.language.runtime import Floats, Tensors
from models.language.spans.tags import FORBIDDEN, Span

LEAST_LENGTH = np.float32(1e-12)
"""What a vector is divided by at least, to make its length 1."""


@dataclass(frozen=True, slots=True, eq=False)
class Heads:
    """Three readings of the vectors of words; the tensors have the shapes `MatchConfig.shapes`."""

    config: MatchConfig
    tensors: Tensors

    def asked(self, vectors: Floats, ways: Sequence[Sequence[int]]) -> Floats:
        """[W, V] unit vectors of what a text with the vectors [S, D] asks for, by which of its words are free."""
        upper = vectors[:, self.config.hidden :]
        return _unit(np.stack([upper[list(free)].mean(axis=0) for free in ways]))

    def roles(self, vectors: Floats, mentions: Sequence[Span]) -> Floats:
        """[M, R] unit vectors of the parts that mentions play."""
        nothing = np.zeros(self.config.vector, np.float32)
        parts = np.zeros((len(mentions), 2 * self.config.vector), np.float32)
        for row, (begin, end) in enumerate(mentions):
            before = vectors[max(0, begin - LEFT) : begin].mean(axis=0) if begin else nothing
            parts[row] = np.concatenate([vectors[begin:end].mean(axis=0), before])
        return _unit(self._linear("role", parts))

    def tags(self, vectors: Floats) -> NDArray[np.float64]:
        """[S, 3] the scores of the tags of words."""
        return self._linear("tag", vectors).astype(np.float64)

    def moves(self) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
        """The scores [3, 3] of neighbouring tags, and [3] of the first."""
        allowed, start = forbidden()
        return self.tensors["transition"].astype(np.float64) + allowed, start

    def _linear(self, name: str, given: Floats) -> Floats:
        found: Floats = given @ self.tensors[f"{name}.weight"].T + self.tensors[f"{name}.bias"]
        return found


def forbidden() -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Scores [3, 3] of pairs of neighbouring tags and [3] of the first tag: 0, or `FORBIDDEN`."""
    moves, start = np.zeros((TAGS, TAGS)), np.zeros(TAGS)
    moves[OUTSIDE, ON] = start[ON] = FORBIDDEN
    return moves, start


def _unit(vectors: Floats) -> Floats:
    """The vectors with length 1."""
    found: Floats = vectors / np.maximum(np.linalg.norm(vectors, axis=1, keepdims=True), LEAST_LENGTH)
    return found
