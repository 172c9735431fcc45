"""The best outputs of a trained network: their probabilities are those of the loss."""

from __future__ import annotations

import math

import pytest

from models.language.copynet import Models, outputs
from models.language.copynet.items import to_batch
from models.language.copynet.network import loss
from models.language.copynet.search import best_outputs, first_words
from models.language.tokens import words

TEXTS = ["Go to the bank", "Head for the grand zorb", "Go to the park, then go to the zoo"]


def _probability(models: Models, text: tuple[str, ...], answer: tuple[str, ...]) -> float:
    source, target = to_batch([text], [answer], [()], models.cq.vocabulary)
    return math.exp(-loss(models.cq.network(source, target), source, target).item())


@pytest.mark.parametrize("text", TEXTS)
def test_best_outputs(small: Models, text: str) -> None:
    spoken = words(text)
    found = best_outputs(small.cq, spoken, width=5)
    assert len({answer for answer, _ in found}) == len(found) == 5
    assert [p for _, p in found] == sorted((p for _, p in found), reverse=True)
    assert sum(p for _, p in found) <= 1.0 + 1e-6
    for answer, probability in found:
        assert probability == pytest.approx(_probability(small, spoken, answer), rel=1e-4)
    (greedy,) = outputs(small.cq, [text])
    assert found[0][1] >= _probability(small, spoken, greedy) * (1 - 1e-4)


@pytest.mark.parametrize("text", TEXTS)
def test_first_words(small: Models, text: str) -> None:
    """Every output that begins with a word has at most its probability, and the greedy one begins with the best."""
    spoken = words(text)
    first = first_words(small.cq, spoken, width=100)
    assert len(first) == small.cq.vocabulary.outputs
    assert sum(p for _, p in first) <= 1.0 + 1e-6
    assert [p for _, p in first] == sorted((p for _, p in first), reverse=True)
    assert first_words(small.cq, spoken, width=2) == first[:2]
    assert first[0][0] == outputs(small.cq, [text], steps=1)[0][0]
    for word, probability in first:
        same = sum(p for answer, p in best_outputs(small.cq, spoken, width=20) if answer[0] == word)
        assert same <= probability + 1e-6
