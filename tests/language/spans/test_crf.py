"""The random field against enumeration of every tag sequence."""

from __future__ import annotations

import math
from itertools import pairwise, product

import pytest
import torch
from hypothesis import given, settings
from hypothesis import strategies as st
from torch import Tensor

from models.language.spans.crf import FORBIDDEN, best_sequences, log_partition, score


def random_field(seed: int, texts: int, length: int, tags: int) -> tuple[Tensor, Tensor, Tensor]:
    generator = torch.Generator().manual_seed(seed)

    def draw(*shape: int) -> Tensor:
        return torch.randn(*shape, generator=generator, dtype=torch.float64)

    return draw(texts, length, tags), draw(texts, tags, tags), draw(texts, tags)


def by_hand(emissions: Tensor, transitions: Tensor, start: Tensor, tags: tuple[int, ...]) -> float:
    total = float(start[tags[0]])
    total += sum(float(emissions[place, tag]) for place, tag in enumerate(tags))
    return total + sum(float(transitions[one, two]) for one, two in pairwise(tags))


@given(seed=st.integers(0, 10_000), length=st.integers(1, 5), tags=st.integers(1, 3))
@settings(max_examples=30, deadline=None)
def test_partition_and_scores_are_those_of_all_sequences(seed: int, length: int, tags: int) -> None:
    emissions, transitions, start = random_field(seed, 2, length, tags)
    lengths = torch.tensor([length, max(1, length - 1)])
    total = log_partition(emissions, transitions, start, lengths)
    for text in range(2):
        count = int(lengths[text])
        scores = {
            sequence: by_hand(emissions[text], transitions[text], start[text], sequence)
            for sequence in product(range(tags), repeat=count)
        }
        assert float(total[text]) == pytest.approx(math.log(sum(map(math.exp, scores.values()))))
        sequence = list(scores)[seed % len(scores)]
        padded = torch.tensor([[*sequence, *[0] * (length - count)]] * 2)
        assert float(score(emissions, transitions, start, lengths, padded)[text]) == pytest.approx(scores[sequence])


@given(seed=st.integers(0, 10_000), length=st.integers(1, 5), tags=st.integers(1, 3), count=st.integers(1, 12))
@settings(max_examples=40, deadline=None)
def test_best_sequences_are_the_best_of_all_in_order(seed: int, length: int, tags: int, count: int) -> None:
    emissions, transitions, start = (tensor[0] for tensor in random_field(seed, 1, length, tags))
    every = sorted(
        (by_hand(emissions, transitions, start, sequence) for sequence in product(range(tags), repeat=length)),
        reverse=True,
    )
    found = best_sequences(emissions, transitions, start, count=count)
    assert [value for value, _ in found] == pytest.approx(every[:count])
    assert len({sequence for _, sequence in found}) == len(found)
    for value, sequence in found:
        assert by_hand(emissions, transitions, start, sequence) == pytest.approx(value)


def test_forbidden_moves_are_never_made() -> None:
    transitions = torch.tensor([[0.0, FORBIDDEN], [0.0, 0.0]])  # never from 0 to 1
    found = best_sequences(torch.zeros(3, 2), transitions, torch.zeros(2), count=8)
    assert sorted(sequence for _, sequence in found) == [(0, 0, 0), (1, 0, 0), (1, 1, 0), (1, 1, 1)]
