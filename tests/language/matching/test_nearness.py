"""Nearness to what is known: arrays against plain loops."""

from __future__ import annotations

import math
from collections.abc import Sequence
from statistics import mean

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from numpy.typing import NDArray

from models.language.matching.nearness import Known, KnownCommands, free_words

Numbers = NDArray[np.float32]
SIZE = 3


def unit(seed: int) -> Numbers:
    vector = np.random.default_rng(seed).normal(size=SIZE)
    return (vector / np.linalg.norm(vector)).astype(np.float32)


def soft_mean(numbers: Sequence[float], sharpness: float) -> float:
    return math.log(mean(math.exp(sharpness * number) for number in numbers)) / sharpness


@given(
    st.lists(st.integers(0, 4), min_size=1, max_size=4),
    st.integers(1, 3),
    st.sampled_from([1.0, 5.0, 20.0]),
)
def test_nearness_to_a_task_is_a_soft_mean_over_its_commands(counts: list[int], ways: int, sharpness: float) -> None:
    known = [[unit(100 * task + number) for number in range(count)] for task, count in enumerate(counts)]
    none = np.zeros((0, 2), np.float32)
    shelf = KnownCommands.of([[Known(asked, none) for asked in task] for task in known])
    asked = [unit(1000 + way) for way in range(ways)]
    near = shelf.nearness(np.stack(asked), sharpness)
    assert near.shape == (ways, len(counts))
    for row, one in enumerate(asked):
        for column, task in enumerate(known):
            cosines = [sum(float(a) * float(b) for a, b in zip(one, other, strict=True)) for other in task]
            assert near[row, column] == pytest.approx(soft_mean(cosines, sharpness) if task else -1.0, abs=1e-5)
            if task:
                assert mean(cosines) - 1e-5 <= near[row, column] <= max(cosines) + 1e-5


def test_words_that_name_nothing_are_free() -> None:
    assert free_words(5, [(1, 2), (3, 5)]) == [0, 2]
    assert free_words(3, []) == [0, 1, 2]
    assert free_words(2, [(0, 2)]) == [0, 1], "where all of them name something, what is asked for is in them"
