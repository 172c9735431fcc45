"""The random field against enumeration of every tag sequence."""

from __future__ import annotations

import math
from itertools import pairwise, product

import pytest
import torch
from hypothesis import given, settings
from hypothesis import strategies as st
from torch import Tensor

from models.language.spans.crf import log_partition, score


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
