"""What a translator is, and what it gives: contextual queries with their probabilities."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Protocol

from models.queries import Query

BEAM_WIDTH = 5
"""Readings that a translator's search keeps, and so the most candidates it gives."""
NEGATIONS = frozenset(
    [
        "never",
        "not",
        "don't",
        "dont",
        "cannot",
        "can't",
        "won't",
        "without",
        "avoid",
        "except",
        "unless",
        "nobody",
        "nothing",
    ]
)
"""Words that turn a command round. No single task class says such a thing, and a network that learned from commands may
read "never pick up the sphere" as it reads "pick up the sphere"; so what reads single tasks does not read these at all.
They are left to `models.language.composition`, which finds the clause that they forbid."""


@dataclass(frozen=True, slots=True)
class Translation:
    """A reading of a text: the query, and the translator's probability for it, between 0 and 1."""

    query: Query
    confidence: float


class Translator(Protocol):
    """What turns a text into contextual queries."""

    def translate(self, text: str, *, candidates: int = 1) -> tuple[Translation, ...]:
        """Up to `candidates` readings, best first; none when no task fits the text.

        The same text always gives the same readings. The confidences of distinct readings add up to at most 1.

        Raises:
            TextTooLongError: the text is beyond the limits of `models.language.tokens`.
        """
