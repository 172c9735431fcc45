"""Reading out against enumeration of every tag sequence, and against the field that training uses."""

from __future__ import annotations

import math
from itertools import pairwise, product

import numpy as np
import pytest
import torch
from hypothesis import given, settings
from hypothesis import strategies as st

from models.language.spans.crf import log_partition
from models.language.spans.decoding import TagScores, best_sequences, log_totals
from models.language.spans.tags import FORBIDDEN


def random_fields(seed: int, fields: int, length: int, tags: int) -> tuple[TagScores, TagScores, TagScores]:
    draw = np.random.default_rng(seed).standard_normal
    return draw((fields, length, tags)), draw((fields, tags, tags)), draw((fields, tags))


def by_hand(emissions: TagScores, transitions: TagScores, start: TagScores, tags: tuple[int, ...]) -> float:
    total = float(start[tags[0]]) + sum(float(emissions[place, tag]) for place, tag in enumerate(tags))
    return total + sum(float(transitions[one, two]) for one, two in pairwise(tags))


@given(
    seed=st.integers(0, 10_000),
    fields=st.integers(1, 3),
    length=st.integers(1, 5),
    tags=st.integers(1, 3),
    count=st.integers(1, 12),
)
@settings(max_examples=40, deadline=None)
def test_best_sequences_are_the_best_of_all_in_order(
    seed: int, fields: int, length: int, tags: int, count: int
) -> None:
    scores = random_fields(seed, fields, length, tags)
    for field, found in zip(zip(*scores, strict=True), best_sequences(*scores, count=count), strict=True):
        every = sorted((by_hand(*field, sequence) for sequence in product(range(tags), repeat=length)), reverse=True)
        assert [value for value, _ in found] == pytest.approx(every[:count])
        assert len({sequence for _, sequence in found}) == len(found)
        for value, sequence in found:
            assert by_hand(*field, sequence) == pytest.approx(value)


def test_sequences_that_score_too_little_are_left_out() -> None:
    scores = random_fields(0, 2, 4, 3)
    every = best_sequences(*scores, count=1000)
    least = [found[20][0] for found in every]
    assert best_sequences(*scores, count=1000, least=least) == [found[:20] for found in every]
    assert best_sequences(*scores, count=5, least=least) == [found[:5] for found in every]


@given(seed=st.integers(0, 10_000), fields=st.integers(1, 3), length=st.integers(1, 5), tags=st.integers(2, 3))
@settings(max_examples=40, deadline=None)
def test_the_total_is_that_of_all_sequences_and_the_one_of_training(
    seed: int, fields: int, length: int, tags: int
) -> None:
    emissions, transitions, start = random_fields(seed, fields, length, tags)
    transitions[:, 0, 1] = start[:, 1] = FORBIDDEN
    totals = log_totals(emissions, transitions, start)
    for field, total in zip(zip(emissions, transitions, start, strict=True), totals, strict=True):
        every = (by_hand(*field, tags) for tags in product(range(tags), repeat=length))
        assert total == pytest.approx(math.log(math.fsum(map(math.exp, every))))
    batch = [torch.from_numpy(scores) for scores in (emissions, transitions, start)]
    assert totals == pytest.approx(log_partition(*batch, torch.full((fields,), length)).numpy())


def test_forbidden_moves_are_never_made() -> None:
    transitions = np.array([[[0.0, FORBIDDEN], [0.0, 0.0]]])  # never from 0 to 1
    (found,) = best_sequences(np.zeros((1, 3, 2)), transitions, np.zeros((1, 2)), count=8)
    assert sorted(sequence for _, sequence in found) == [(0, 0, 0), (1, 0, 0), (1, 1, 0), (1, 1, 1)]
