"""What a translator is, and what it gives: contextual queries with their probabilities."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import Protocol

from models.queries import Query

SURE = 0.995
"""No network is believed more than this."""
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


def weighed(near: Sequence[Translation], heard: Sequence[Translation]) -> tuple[Translation, ...]:
    """The readings of two sources together: the odds of each are lowered by how sure the other is."""
    if not near or not heard:
        return (*near, *heard)
    sums = [sum(translation.confidence for translation in source) for source in (near, heard)]
    first, second = (min(SURE, total) for total in sums)
    one, other = first * (1.0 - second), second * (1.0 - first)
    scale = (first + second - first * second) / (one + other)  # of one of them being right at all
    found: dict[object, Translation] = {}
    for source, share, total in ((near, one * scale, sums[0]), (heard, other * scale, sums[1])):
        for translation in source:
            part = translation.confidence / total * share
            known = found.get(translation.query)
            sure = part if known is None else part + known.confidence
            found[translation.query] = replace(translation, confidence=min(1.0, sure))
    return tuple(sorted(found.values(), key=lambda t: (-t.confidence, str(t.query))))
