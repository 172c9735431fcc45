"""What translates says what was trained: ONNX Runtime against torch, with weights of every size."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
import pytest
import torch
from hypothesis import given, settings
from hypothesis import strategies as st

from models.language.runtime import Floats
from models.language.spans.config import SpanConfig
from models.language.spans.model import SpanModel
from models.language.spans.network import SpanNet, TextBatch
from models.language.spans.scorer import SpanScorer

WORDS = ("go", "take", "the", "to")
texts = st.lists(st.lists(st.sampled_from([*WORDS, "mug", "attic"]), min_size=1, max_size=9), min_size=1, max_size=4)


class Drawn:
    """Any vectors; those of a word are always the same."""

    size = 6

    def read(self, texts: Sequence[Sequence[str]]) -> Floats:
        found = np.zeros((len(texts), max(map(len, texts)), self.size), np.float32)
        for row, text in enumerate(texts):
            for place, word in enumerate(text):
                found[row, place] = np.random.default_rng(sum(map(ord, word))).normal(size=self.size)
        return found


def network(layers: int) -> SpanNet:
    config = SpanConfig(WORDS, (("go", 1), ("take", 2), ("wait", 0)), Drawn.size, 5, 7, 4, layers)
    with torch.random.fork_rng(devices=[]):
        torch.manual_seed(layers)
        return SpanNet(config).eval()


@pytest.mark.parametrize("layers", [1, 2, 3])
@given(asked=texts)
@settings(max_examples=15, deadline=None)
def test_it_scores_as_in_training(layers: int, asked: list[list[str]]) -> None:
    trained = network(layers)
    scorer = SpanScorer.of(SpanModel(trained.config, trained.tensors(), 1.0, {}), Drawn())
    numbers = {word: number for number, word in enumerate(WORDS, start=1)}
    with torch.inference_mode():
        expected = trained(TextBatch.of(asked, numbers, Drawn()))
        tags = trained.tag(expected.states).unflatten(2, (3, trained.config.tags))  # [B, S, K, L]
    tasks, states = scorer.scores(asked)
    np.testing.assert_allclose(tasks, expected.tasks, atol=1e-5)
    np.testing.assert_allclose(states, expected.states, atol=1e-5)
    for row, text in enumerate(asked):
        found = scorer.emissions(states[row, : len(text)], [2, 0], 3)
        np.testing.assert_allclose(found, tags[row, : len(text), [2, 0], :3].transpose(0, 1), atol=1e-5)


@pytest.mark.parametrize("layers", [1, 2, 3])
def test_a_configuration_knows_the_shapes_of_its_tensors(layers: int) -> None:
    trained = network(layers)
    assert trained.config.shapes() == {name: tensor.shape for name, tensor in trained.tensors().items()}


def test_a_network_comes_back() -> None:
    trained = network(2)
    again = SpanNet.of(SpanModel(trained.config, trained.tensors(), 1.0, {}))
    assert all(np.array_equal(tensor, again.tensors()[name]) for name, tensor in trained.tensors().items())
