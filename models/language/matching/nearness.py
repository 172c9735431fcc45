"""How near a command is to others: each is one vector, the mean of those of its free words (Reimers and Gurevych,
"Sentence-BERT", EMNLP 2019).

Shapes: S words, V the vector of a command, R of roles, N known commands, M ways to see which words are free, K tasks.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from typing import Self

import numpy as np
from numpy.typing import NDArray

from models.language.runtime import Floats
from models.language.spans.tags import Span

Vectors = Floats


@dataclass(frozen=True, slots=True, eq=False)
class Known:
    """What was read in an example or a card: the unit vector of what it asks for, [V], and those of the arguments'
    roles, [A, R].
    """

    asked: Vectors
    roles: Vectors


@dataclass(frozen=True, slots=True, eq=False)
class KnownCommands:
    """Known commands as arrays: vectors [N, V], where those of each task that has any begin, how many they are, and
    which tasks those are.
    """

    asked: Vectors
    firsts: NDArray[np.intp]
    counts: NDArray[np.intp]
    owners: NDArray[np.intp]
    tasks: int  # K

    @classmethod
    def of(cls, known: Sequence[Sequence[Known]]) -> Self:
        """Of the commands of each task."""
        flat = [one.asked for group in known for one in group]
        sizes = np.array([len(group) for group in known], dtype=np.intp)
        owners = np.flatnonzero(sizes)
        counts = sizes[owners]
        asked = np.stack(flat) if flat else np.zeros((0, 0), np.float32)
        return cls(asked, np.cumsum(counts) - counts, counts, owners, len(known))

    def nearness(self, asked: Vectors, sharpness: float) -> Vectors:
        """[M, K] of a command, seen in M ways as the unit vectors [M, V], to each task; -1 without commands.

        That to a single command is their cosine. Of several, it is the logarithm of the mean of exp(sharpness *
        nearness), divided by the sharpness: between their mean, at 0, and the nearest, at infinity. The nearest alone
        would favour tasks with many examples, of which one is always near.
        """
        near = np.full((len(asked), self.tasks), -1.0, np.float32)
        if len(self.owners) and len(asked):
            odds = np.exp(sharpness * (asked @ self.asked.T))  # [M, N]
            near[:, self.owners] = np.log(np.add.reduceat(odds, self.firsts, axis=1) / self.counts) / sharpness
        return near


def free_words(count: int, spans: Iterable[Span]) -> list[int]:
    """The places of the words, of so many, that name nothing; all where nothing else is said."""
    named = {place for begin, end in spans for place in range(begin, end)}
    return [place for place in range(count) if place not in named] or list(range(count))
