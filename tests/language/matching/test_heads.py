"""What compares commands says what was trained: NumPy against torch."""

from __future__ import annotations

import numpy as np
import torch
from hypothesis import given
from hypothesis import strategies as st

from models.language.matching.config import MatchConfig
from models.language.matching.network import MatchNet


def network() -> MatchNet:
    with torch.random.fork_rng(devices=[]):
        torch.manual_seed(1)
        made = MatchNet(MatchConfig(vector=8, role=3)).eval()
        torch.nn.init.normal_(made.word.weight)
        torch.nn.init.normal_(made.salience.weight)
        torch.nn.init.normal_(made.transition)
        return made.requires_grad_(False)


@given(st.integers(1, 6), st.data())
def test_it_reads_as_in_training(count: int, data: st.DataObject) -> None:
    trained, vectors = network(), np.random.default_rng(count).normal(size=(count, 8)).astype(np.float32)
    heads, given_ = trained.heads(), torch.from_numpy(vectors)
    places = st.tuples(st.integers(0, count - 1), st.integers(1, count)).filter(lambda span: span[0] < span[1])
    mentions = data.draw(st.lists(places, min_size=1, max_size=3))
    words, salience = trained.commands(given_[None])
    np.testing.assert_allclose(heads.words(vectors), words[0], atol=1e-5)
    np.testing.assert_allclose(heads.salience(vectors), salience[0], atol=1e-5)
    np.testing.assert_allclose(heads.roles(vectors, mentions), trained.roles(given_, mentions), atol=1e-5)
    np.testing.assert_allclose(heads.tags(vectors), trained.tags(given_[None])[0], atol=1e-5)
    moves, start = heads.moves()
    np.testing.assert_allclose(moves, trained.transition + trained.allowed, rtol=1e-6)
    np.testing.assert_allclose(start, trained.allowed_start)


def test_no_mention_plays_no_part() -> None:
    assert network().heads().roles(np.zeros((2, 8), np.float32), []).shape == (0, 3)


def test_a_configuration_knows_the_shapes_of_its_tensors() -> None:
    trained = network()
    assert trained.config.shapes() == {name: tensor.shape for name, tensor in trained.heads().tensors.items()}
