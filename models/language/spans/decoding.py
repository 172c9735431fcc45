"""Reading a conditional random field out: the tag sequences of one text that score best, and the score of all together.

In NumPy, because a text is short: most of the time of each step is the call, and NumPy's calls cost a fraction of
torch's. Training, which needs gradients and batches, uses `crf`.

Shapes: S words, L tags. Scores are logarithms and not normalised.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from models.language.spans.crf import FORBIDDEN

TagScores = NDArray[np.float64]


def log_total(emissions: TagScores, transitions: TagScores, start: TagScores) -> float:
    """The logarithm of the summed exponentials of all tag sequences' scores: `crf.log_partition` of one text.

    Args:
        emissions: [S, L].
        transitions: [L, L], from the first tag to the second.
        start: [L], for the first word.
    """
    alpha = start + emissions[0]  # [L]
    moves = np.exp(transitions)  # [L, L]
    for emission in emissions[1:]:
        top = alpha.max()
        with np.errstate(divide="ignore"):  # a tag that nothing leads to has the logarithm of 0
            alpha = np.log(np.exp(alpha - top) @ moves) + top + emission
    top = alpha.max()
    return float(np.log(np.exp(alpha - top).sum()) + top)


def best_sequences(
    emissions: TagScores, transitions: TagScores, start: TagScores, *, count: int, least: float = FORBIDDEN / 2
) -> tuple[tuple[float, tuple[int, ...]], ...]:
    """The tag sequences with the highest scores, best first, at most `count` (Viterbi, k best).

    Sequences with a score below `least` are left out, and those with a `FORBIDDEN` move. Other arguments as
    `log_total`.
    """
    least = max(least, FORBIDDEN / 2)
    tags = emissions.shape[1]
    scores = (start + emissions[0])[:, None]  # [L, K], per last tag the best sequences so far, best first
    pointers: list[NDArray[np.intp]] = []
    for emission in emissions[1:]:
        reached = (scores[:, :, None] + transitions[:, None, :]).reshape(-1, tags)  # [L * K, L]
        places = np.argsort(-reached, axis=0, kind="stable")[:count]  # [K', L]
        pointers.append(places)
        scores = np.take_along_axis(reached, places, axis=0).T + emission[:, None]  # [L, K']
    flat = scores.ravel()
    places = np.argsort(-flat, kind="stable")[:count]
    backward = [pointer.tolist() for pointer in reversed(pointers)]
    widths = [1, *(len(pointer) for pointer in pointers)]
    return tuple(
        (float(flat[place]), _trace(backward, widths, place)) for place in places.tolist() if flat[place] > least
    )


def _trace(backward: list[list[list[int]]], widths: list[int], place: int) -> tuple[int, ...]:
    """The sequence behind a place, which is a tag times the number of sequences kept, plus the rank among them."""
    tag, rank = divmod(place, widths[-1])
    sequence = [tag]
    for pointer, width in zip(backward, reversed(widths[:-1]), strict=True):
        tag, rank = divmod(pointer[rank][tag], width)
        sequence.append(tag)
    return tuple(reversed(sequence))
