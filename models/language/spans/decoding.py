"""Reading conditional random fields out: the tag sequences of one text that score best, and the score of all together,
under several fields at once.

In NumPy, because a text is short: most of the time of each step is the call, and NumPy's calls cost a fraction of
torch's. Training, which needs gradients and batches of texts, uses `crf`.

Shapes: N fields, S words, L tags. Scores are logarithms and not normalised.
"""

from __future__ import annotations

import heapq
from collections.abc import Iterator, Sequence
from itertools import islice

import numpy as np
from numpy.typing import NDArray

from models.language.spans.tags import FORBIDDEN

TagScores = NDArray[np.float64]
Tagged = tuple[float, tuple[int, ...]]
"""A tag sequence with its score."""
LEAST = FORBIDDEN / 2
"""Sequences below are those with a `FORBIDDEN` move."""


def log_totals(emissions: TagScores, transitions: TagScores, start: TagScores) -> TagScores:
    """The logarithms [N] of the summed exponentials of all tag sequences' scores: `crf.log_partition` of one text.

    Args:
        emissions: [N, S, L].
        transitions: [N, L, L], from the first tag to the second.
        start: [N, L], for the first word.
    """
    moves = np.exp(transitions)  # [N, L, L]
    alpha = (start + emissions[:, 0])[:, None]  # [N, 1, L]
    with np.errstate(divide="ignore"):  # a tag that nothing leads to has the logarithm of 0
        for place in range(1, emissions.shape[1]):
            top = alpha.max(axis=2, keepdims=True)
            alpha = np.log(np.exp(alpha - top) @ moves) + top + emissions[:, place, None]
    top = alpha.max(axis=2)
    totals: TagScores = (np.log(np.exp(alpha - top[:, :, None]).sum(axis=2)) + top)[:, 0]
    return totals


def best_sequences(
    emissions: TagScores, transitions: TagScores, start: TagScores, *, count: int, least: Sequence[float] | None = None
) -> list[tuple[Tagged, ...]]:
    """For each field the tag sequences with the highest scores, best first, at most `count`.

    The best that can follow each tag is computed once, from the end (Viterbi, backwards); with it as the bound, which
    is exact, a best-first search (A*) opens no sequence that is not among those given. Equal scores come in the order
    of the tags.

    Sequences that score at most `least` [N] are left out, and those with a `FORBIDDEN` move. Other arguments as
    `log_totals`.
    """
    fields, words, tags = emissions.shape
    ahead = np.zeros((fields, tags))  # the best that can follow each tag
    lost = np.empty((words - 1, fields, tags, tags))  # by how much each next tag falls short of it
    for place in range(words - 2, -1, -1):
        following = transitions + (emissions[:, place + 1] + ahead)[:, None]  # [N, L, L]
        ahead = following.max(axis=2)
        lost[place] = ahead[:, :, None] - following
    first = start + emissions[:, 0] + ahead  # [N, L]
    bounds = [LEAST] * fields if least is None else [max(LEAST, bound) for bound in least]
    return [
        tuple(islice(_best_first(first[field], lost[:, field], bound), count)) for field, bound in enumerate(bounds)
    ]


def _best_first(first: TagScores, lost: TagScores, least: float) -> Iterator[Tagged]:
    """The sequences that score more than `least`, best first. `first` is [L], `lost` is [S - 1, L, L]."""
    found: list[Tagged] = [(-score, (tag,)) for tag, score in enumerate(first.tolist()) if score > least]
    losses: list[list[list[float]]] = lost.tolist()  # one call, instead of one for each sequence that is opened
    heapq.heapify(found)
    while found:
        negative, tags = heapq.heappop(found)
        if len(tags) > len(losses):
            yield -negative, tags
            continue
        room = -negative - least
        for tag, loss in enumerate(losses[len(tags) - 1][tags[-1]]):
            if loss < room:
                heapq.heappush(found, (negative + loss, (*tags, tag)))
