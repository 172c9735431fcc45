"""Late interaction: how near a command is to others, word by word (Khattab and Zaharia, "ColBERT", SIGIR 2020).

Shapes: S words, F of them free (they name nothing), V vectors of words, R of roles, N known commands with T free words
in all, M ways to see which words are free, K tasks.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Self

import numpy as np
from numpy.typing import NDArray

from models.language.matching.heads import Heads
from models.language.runtime import Floats

Vectors = Floats


@dataclass(frozen=True, slots=True, eq=False)
class Known:
    """What was read in an example or a card: vectors of its free words, [F, V], how much each of them matters, [F],
    adding up to 1, and vectors of the arguments' roles, [A, R].
    """

    words: Vectors
    weights: Vectors
    roles: Vectors


@dataclass(frozen=True, slots=True, eq=False)
class Command:
    """What the words of a text ask for, [S, V], and how much each matters, [S]."""

    words: Vectors
    salience: Vectors

    @classmethod
    def of(cls, heads: Heads, vectors: Vectors) -> Self:
        """Of words with the vectors [S, D]."""
        return cls(heads.words(vectors), heads.salience(vectors))

    def weights(self, free: Sequence[int]) -> Vectors:
        """[F] how much each of the free words matters, adding up to 1."""
        salience = self.salience[list(free)]
        weights: Vectors = salience / salience.sum()
        return weights


@dataclass(frozen=True, slots=True, eq=False)
class KnownWords:
    """The free words of known commands as arrays: vectors [T, V], weights [T], where each command begins [N], where the
    commands of each task that has any begin among these, how many they are, and which tasks those are.
    """

    words: Vectors
    weights: Vectors
    begins: NDArray[np.intp]
    firsts: NDArray[np.intp]
    counts: NDArray[np.intp]
    owners: NDArray[np.intp]
    tasks: int  # K

    @classmethod
    def of(cls, known: Sequence[Sequence[Known]]) -> Self:
        """Of the commands of each task."""
        flat = [one for group in known for one in group]
        counts = np.array([len(group) for group in known], dtype=np.intp)
        owners = np.flatnonzero(counts)
        return cls(
            np.concatenate([one.words for one in flat]) if flat else np.zeros((0, 0), np.float32),
            np.concatenate([one.weights for one in flat]) if flat else np.zeros(0, np.float32),
            _starts(np.array([len(one.weights) for one in flat], dtype=np.intp)),
            _starts(counts[owners]),
            counts[owners],
            owners,
            len(known),
        )

    def nearness(self, command: Command, ways: Sequence[Sequence[int]], sharpness: float) -> Vectors:
        """[M, K] of a command, seen in M ways that differ in which words are free, to each task; -1 without commands.

        That to a single command is as `models.language.matching.network.Commands.nearness`. Of several, it is the
        logarithm of the mean of exp(sharpness * nearness), divided by the sharpness: between their mean, at 0, and the
        nearest, at infinity. The nearest alone would favour tasks with many examples, of which one is always near.
        """
        near = np.full((len(ways), self.tasks), -1.0, np.float32)
        if len(self.owners):
            each = command.words @ self.words.T  # [S, T]
            for row, free in enumerate(ways):
                odds = np.exp(sharpness * self._both_ways(each[free], command, free))  # [N]
                means = np.add.reduceat(odds, self.firsts) / self.counts
                near[row, self.owners] = np.log(means) / sharpness
        return near

    def _both_ways(self, each: Vectors, command: Command, free: Sequence[int]) -> Vectors:
        """[N] of a command to each that is known; `each` [F, T] are the similarities of words."""
        found = command.weights(free) @ np.maximum.reduceat(each, self.begins, axis=1)  # [N], its words in the others
        others = np.add.reduceat(self.weights * each.max(axis=0), self.begins)  # [N], theirs in it
        nearness: Vectors = ((found + others) / 2).astype(np.float32)
        return nearness


def _starts(counts: NDArray[np.intp]) -> NDArray[np.intp]:
    """Where parts of these lengths begin, one after the other; none is empty."""
    return np.cumsum(counts) - counts
