"""Whether confidences are probabilities: reliability by bins, expected calibration error (Naeini et al., AAAI 2015)."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

BINS = 15
"""Bins of equal width over confidences from 0 to 1."""


@dataclass(frozen=True, slots=True)
class Bin:
    """Answers with a confidence above `low` and up to `high`: how many, how sure, and the part of them that is right.

    `confidence` and `accuracy` are means, 0 in an empty bin.
    """

    low: float
    high: float
    count: int
    confidence: float
    accuracy: float


def reliability(confidences: Sequence[float], right: Sequence[bool], *, bins: int = BINS) -> tuple[Bin, ...]:
    """The answers by confidence, in bins of equal width; a confidence of 0 falls into the first."""
    members: list[list[tuple[float, bool]]] = [[] for _ in range(bins)]
    for confidence, outcome in zip(confidences, right, strict=True):
        number = next(n for n in range(bins) if confidence <= (n + 1) / bins or n == bins - 1)
        members[number].append((confidence, outcome))
    return tuple(
        Bin(
            low=number / bins,
            high=(number + 1) / bins,
            count=len(group),
            confidence=sum(c for c, _ in group) / max(len(group), 1),
            accuracy=sum(r for _, r in group) / max(len(group), 1),
        )
        for number, group in enumerate(members)
    )


def calibration_error(table: Sequence[Bin]) -> float:
    """The mean difference between confidence and accuracy over the bins, weighted by their counts; 0 of no answer."""
    total = sum(entry.count for entry in table)
    return sum(entry.count * abs(entry.confidence - entry.accuracy) for entry in table) / max(total, 1)
