"""Beam search against enumeration of every sequence."""

from __future__ import annotations

import math
from dataclasses import dataclass
from itertools import product

import pytest
import torch
from torch import Tensor

from models.language.copynet.beam import beam_search

START, END, SIZE, STEPS = 4, 0, 4, 4


@dataclass
class Chain:
    """The last two words of each sequence: the state of a second-order Markov chain over words."""

    table: Tensor  # [SIZE + 1, SIZE + 1, SIZE] log-probabilities
    before: Tensor  # [N]

    def select(self, rows: Tensor) -> Chain:
        return Chain(self.table, self.before[rows])


def _step(last: Tensor, state: Chain) -> tuple[Tensor, Chain]:
    return state.table[state.before, last], Chain(state.table, last)


def _table(seed: int) -> Tensor:
    generator = torch.Generator().manual_seed(seed)
    return (2 * torch.randn(SIZE + 1, SIZE + 1, SIZE, generator=generator)).log_softmax(dim=2)


def _enumerated(table: Tensor) -> list[tuple[tuple[int, ...], float]]:
    found = []
    for length in range(STEPS):
        for words in product(range(1, SIZE), repeat=length):
            sequence = (*words, END)
            history = (START, START, *sequence)
            total = sum(table[history[i], history[i + 1], history[i + 2]].item() for i in range(len(sequence)))
            found.append((sequence, total))
    return sorted(found, key=lambda item: -item[1])


@pytest.mark.parametrize("seed", range(10))
def test_wide_beam_is_exhaustive(seed: int) -> None:
    table = _table(seed)
    expected = _enumerated(table)
    found = beam_search(_step, Chain(table, torch.tensor([START])), start=START, end=END, width=1000, steps=STEPS)
    assert [hypothesis.words for hypothesis in found] == [words for words, _ in expected]
    assert [h.log_probability for h in found] == pytest.approx([total for _, total in expected], abs=1e-5)
    assert sum(math.exp(h.log_probability) for h in found) <= 1.0 + 1e-6


@pytest.mark.parametrize("width", [1, 2, 5])
@pytest.mark.parametrize("seed", range(10))
def test_narrow_beam(seed: int, width: int) -> None:
    """Never better than the best there are, ordered, distinct, and scored as the chain scores them."""
    table = _table(seed)
    expected = dict(_enumerated(table))
    found = beam_search(_step, Chain(table, torch.tensor([START])), start=START, end=END, width=width, steps=STEPS)
    assert 0 < len({hypothesis.words for hypothesis in found}) == len(found) <= width
    for hypothesis in found:
        assert hypothesis.log_probability == pytest.approx(expected[hypothesis.words], abs=1e-5)
    assert list(found) == sorted(found, key=lambda h: -h.log_probability)


def test_width_one_is_not_greedy_about_the_end() -> None:
    """The likelier first word leads to a worse sequence than ending at once; both are seen."""
    table = torch.full((SIZE + 1, SIZE + 1, SIZE), 0.25).log()
    table[START, START] = torch.tensor([0.4, 0.6, 0.0, 0.0]).log()
    found = beam_search(_step, Chain(table, torch.tensor([START])), start=START, end=END, width=1, steps=STEPS)
    assert [hypothesis.words for hypothesis in found] == [(END,)]
    assert math.exp(found[0].log_probability) == pytest.approx(0.4)


def test_nothing_that_ends() -> None:
    table = torch.full((SIZE + 1, SIZE + 1, SIZE), 1 / 3).log()
    table[:, :, END] = -torch.inf
    assert beam_search(_step, Chain(table, torch.tensor([START])), start=START, end=END, width=3, steps=STEPS) == ()
