"""Reading out against enumeration of every tag sequence, and against the field that training uses."""

from __future__ import annotations

import math
from itertools import pairwise, product

import numpy as np
import pytest
import torch
from hypothesis import given, settings
from hypothesis import strategies as st

from models.language.spans.crf import FORBIDDEN, log_partition
from models.language.spans.decoding import TagScores, best_sequences, log_total


def random_field(seed: int, length: int, tags: int) -> tuple[TagScores, TagScores, TagScores]:
    draw = np.random.default_rng(seed).standard_normal
    return draw((length, tags)), draw((tags, tags)), draw(tags)


def by_hand(emissions: TagScores, transitions: TagScores, start: TagScores, tags: tuple[int, ...]) -> float:
    total = float(start[tags[0]]) + sum(float(emissions[place, tag]) for place, tag in enumerate(tags))
    return total + sum(float(transitions[one, two]) for one, two in pairwise(tags))


@given(seed=st.integers(0, 10_000), length=st.integers(1, 5), tags=st.integers(1, 3), count=st.integers(1, 12))
@settings(max_examples=40, deadline=None)
def test_best_sequences_are_the_best_of_all_in_order(seed: int, length: int, tags: int, count: int) -> None:
    field = random_field(seed, length, tags)
    every = sorted((by_hand(*field, sequence) for sequence in product(range(tags), repeat=length)), reverse=True)
    found = best_sequences(*field, count=count)
    assert [value for value, _ in found] == pytest.approx(every[:count])
    assert len({sequence for _, sequence in found}) == len(found)
    for value, sequence in found:
        assert by_hand(*field, sequence) == pytest.approx(value)


@given(seed=st.integers(0, 10_000), length=st.integers(1, 5), tags=st.integers(2, 3))
@settings(max_examples=40, deadline=None)
def test_the_total_is_that_of_all_sequences_and_the_one_of_training(seed: int, length: int, tags: int) -> None:
    emissions, transitions, start = random_field(seed, length, tags)
    transitions[0, 1] = start[1] = FORBIDDEN
    every = (by_hand(emissions, transitions, start, tags) for tags in product(range(tags), repeat=length))
    total = log_total(emissions, transitions, start)
    assert total == pytest.approx(math.log(math.fsum(map(math.exp, every))))
    batch = [torch.from_numpy(scores)[None] for scores in (emissions, transitions, start)]
    assert total == pytest.approx(float(log_partition(*batch, torch.tensor([length]))))


def test_forbidden_moves_are_never_made() -> None:
    transitions = np.array([[0.0, FORBIDDEN], [0.0, 0.0]])  # never from 0 to 1
    found = best_sequences(np.zeros((3, 2)), transitions, np.zeros(2), count=8)
    assert sorted(sequence for _, sequence in found) == [(0, 0, 0), (1, 0, 0), (1, 1, 0), (1, 1, 1)]
