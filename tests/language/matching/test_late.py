"""Late interaction: arrays against plain loops, in use and in training."""

from __future__ import annotations

import math
from collections.abc import Sequence
from statistics import mean

import numpy as np
import torch
from hypothesis import given
from hypothesis import strategies as st
from numpy.typing import NDArray

from models.language.matching.late import Command, Known, KnownWords
from models.language.matching.network import Commands

Numbers = NDArray[np.float32]
WORDS, SIZE = 4, 3


def drawn(seed: int, count: int) -> tuple[Numbers, Numbers]:
    """Unit vectors of words, and how much each matters."""
    generator = np.random.default_rng(seed)
    words = generator.normal(size=(count, SIZE))
    return (words / np.linalg.norm(words, axis=1, keepdims=True)).astype(np.float32), generator.uniform(
        0.1, 2, count
    ).astype(np.float32)


def plain(one: Numbers, salience: Numbers, other: Numbers, others: Numbers) -> float:
    """How near two commands are, in loops: each word looks for its nearest in the other command."""
    there = sum(s * max(float(a @ b) for b in other) for a, s in zip(one, salience, strict=True)) / salience.sum()
    back = sum(s * max(float(a @ b) for a in one) for b, s in zip(other, others, strict=True)) / others.sum()
    return float((there + back) / 2)


def known(seed: int, count: int) -> Known:
    words, salience = drawn(seed, count)
    return Known(words, salience / salience.sum(), np.zeros((0, 2), np.float32))


def soft_mean(numbers: Sequence[float], sharpness: float) -> float:
    return math.log(mean(math.exp(sharpness * number) for number in numbers)) / sharpness


@given(st.lists(st.lists(st.integers(1, WORDS), max_size=3), min_size=1, max_size=4), st.data())
def test_nearness_to_a_task_is_a_soft_mean_over_its_commands(tasks: list[list[int]], data: st.DataObject) -> None:
    shelf = [[known(100 * i + j, count) for j, count in enumerate(task)] for i, task in enumerate(tasks)]
    words, salience = drawn(7, WORDS)
    ways = data.draw(st.lists(st.sets(st.integers(0, WORDS - 1), min_size=1).map(sorted), min_size=1, max_size=3))
    sharpness = data.draw(st.sampled_from([1.0, 5.0, 20.0]))
    near = KnownWords.of(shelf).nearness(Command(words, salience), ways, sharpness)
    for row, free in enumerate(ways):
        each = [[plain(words[free], salience[free], one.words, one.weights) for one in task] for task in shelf]
        expected = [soft_mean(task, sharpness) if task else -1.0 for task in each]
        assert np.allclose(near[row], expected, atol=1e-5)
        between = [(mean(task) - 1e-5, max(task) + 1e-5) for task in each if task]
        assert all(low <= n <= high for n, (low, high) in zip(near[row, [bool(t) for t in each]], between, strict=True))


@given(st.lists(st.sets(st.integers(0, WORDS - 1), min_size=1).map(sorted), min_size=1, max_size=4))
def test_training_sees_the_same_nearness(frees: list[list[int]]) -> None:
    read = [drawn(seed, WORDS) for seed in range(len(frees))]
    free = torch.tensor([[float(place in kept) for place in range(WORDS)] for kept in frees])
    commands = Commands(*(torch.tensor(np.stack(parts)) for parts in zip(*read, strict=True)))
    near = commands.nearness(free).numpy()
    for row, (words, salience) in enumerate(read):
        for column, (others, matters) in enumerate(read):
            one, other = frees[row], frees[column]
            expected = plain(words[one], salience[one], others[other], matters[other])
            assert np.isclose(near[row, column], expected, atol=1e-5)
