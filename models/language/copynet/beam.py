"""Beam search: the most probable output sequences, best first."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass
from typing import Protocol, Self, TypeVar

import torch
from torch import Tensor


class Selectable(Protocol):
    """The state of N partial sequences."""

    def select(self, rows: Tensor) -> Self:
        """The states at `rows` [M]."""


_State = TypeVar("_State", bound=Selectable)
Step = Callable[[Tensor, _State], tuple[Tensor, _State]]
"""From the last words [N] and states of N sequences to log-probabilities [N, E] of the next word, and new states."""


@dataclass(frozen=True, slots=True)
class Hypothesis:
    """An output sequence, `end` last, and its log-probability: the sum over its words, not divided by its length."""

    words: tuple[int, ...]
    log_probability: float


def beam_search(
    step: Step[_State], state: _State, *, start: int, end: int, width: int, steps: int
) -> tuple[Hypothesis, ...]:
    """The best sequences that reach `end` within `steps` words, at most `width`, most probable first.

    Keeps the `width` most probable unfinished sequences at every step. It stops early when no unfinished sequence can
    overtake: a sequence only loses probability as it grows. With a width of at least the number of prefixes nothing is
    cut off and the search is exhaustive. `state` holds one sequence.
    """
    finished: list[Hypothesis] = []
    prefixes: list[tuple[int, ...]] = [()]
    last = torch.tensor([start])  # [N]
    totals = torch.zeros(1)  # [N]
    for _ in range(steps):
        log_probabilities, state = step(last, state)  # [N, E]
        totals = totals[:, None] + log_probabilities  # [N, E]
        for prefix, total in zip(prefixes, totals[:, end].tolist(), strict=True):
            if total > -math.inf:
                finished.append(Hypothesis((*prefix, end), total))
        finished = sorted(finished, key=lambda hypothesis: -hypothesis.log_probability)[:width]
        totals[:, end] = -torch.inf
        size = totals.shape[1]
        best, places = totals.flatten().topk(min(width, totals.numel()))  # [N'], most probable first
        worst = finished[-1].log_probability if len(finished) == width else -math.inf
        alive = int((best > worst).sum())
        if alive == 0:
            break
        rows, words = places[:alive] // size, places[:alive] % size  # [N']
        prefixes = [(*prefixes[row], word) for row, word in zip(rows.tolist(), words.tolist(), strict=True)]
        last, totals, state = words, best[:alive], state.select(rows)
    return tuple(finished)
