"""The most probable outputs of a network for one text, with their probabilities."""

from __future__ import annotations

import math
from collections.abc import Sequence

import torch
from torch import Tensor

from models.language.copynet.batch import SourceBatch
from models.language.copynet.beam import beam_search
from models.language.copynet.network import State, log_probabilities
from models.language.copynet.weights import Model

MAX_OUTPUT = 48
"""Longest output sequence, in words and brackets."""
Output = tuple[tuple[str, ...], float]
"""Output words and their probability, between 0 and 1."""


@torch.inference_mode()
def best_outputs(model: Model, spoken: Sequence[str], *, width: int) -> tuple[Output, ...]:
    """The best whole outputs by beam search, at most `width`, most probable first; `spoken` has a word or more.

    The probability is that of the whole sequence, not divided by its length.
    """
    vocabulary = model.vocabulary
    source = vocabulary.source(spoken)
    memory, state = model.network.encode(SourceBatch.of([source], vocabulary))

    def step(last: Tensor, state: State) -> tuple[Tensor, State]:
        repeated = memory.repeat(len(last))
        scores, state = model.network.step(last, state, repeated)  # [N, G + S]
        return log_probabilities(scores, repeated.source), state

    found = beam_search(step, state, start=vocabulary.start, end=vocabulary.end, width=width, steps=MAX_OUTPUT)
    return tuple(
        (vocabulary.spell(hypothesis.words, source.unknown), min(1.0, math.exp(hypothesis.log_probability)))
        for hypothesis in found
    )


@torch.inference_mode()
def first_words(model: Model, spoken: Sequence[str], *, width: int) -> tuple[tuple[str, float], ...]:
    """The most probable first words that the network generates, at most `width`: for a query, its task class."""
    vocabulary = model.vocabulary
    memory, state = model.network.encode(SourceBatch.of([vocabulary.source(spoken)], vocabulary))
    scores, _ = model.network.step(torch.tensor([vocabulary.start]), state, memory)  # [1, G + S]
    probability = log_probabilities(scores, memory.source)[0, : vocabulary.outputs].exp()  # [G]
    best, numbers = probability.topk(min(width, vocabulary.outputs))
    return tuple(
        (vocabulary.words[number], min(1.0, p)) for number, p in zip(numbers.tolist(), best.tolist(), strict=True)
    )
