"""What compares commands says what was trained: ONNX Runtime and NumPy against torch."""

from __future__ import annotations

from functools import cache

import numpy as np
import torch
from hypothesis import given
from hypothesis import strategies as st

from models.language.encoder.layers import build
from models.language.matching.config import UPPER, MatchConfig
from models.language.matching.network import MatchNet

HIDDEN = 24
CONFIG = MatchConfig(vector=2 * HIDDEN, role=3)


@cache
def network() -> MatchNet:
    generator = np.random.default_rng(1)
    upper = {
        name: generator.normal(scale=0.2, size=shape).astype(np.float32)
        for name, shape in CONFIG.upper_shapes().items()
    }
    with torch.random.fork_rng(devices=[]):
        torch.manual_seed(1)
        made = MatchNet(CONFIG, upper).eval()
        torch.nn.init.normal_(made.transition)
        return made.requires_grad_(False)


def drawn(seed: int, *shape: int) -> np.ndarray[tuple[int, ...], np.dtype[np.float32]]:
    return np.random.default_rng(seed).normal(size=shape).astype(np.float32)


@given(st.integers(1, 6), st.data())
def test_it_reads_as_in_training(count: int, data: st.DataObject) -> None:
    trained, vectors = network(), drawn(count, count, 2 * HIDDEN)
    heads, given_ = trained.heads(), torch.from_numpy(vectors)
    places = st.tuples(st.integers(0, count - 1), st.integers(1, count)).filter(lambda span: span[0] < span[1])
    mentions = data.draw(st.lists(places, min_size=1, max_size=3))
    ways = data.draw(st.lists(st.sets(st.integers(0, count - 1), min_size=1).map(sorted), min_size=1, max_size=3))
    for free, asked in zip(ways, heads.asked(vectors, ways), strict=True):
        mask = torch.tensor([[float(place in free) for place in range(count)]])
        np.testing.assert_allclose(asked, trained.asked(given_[None], mask)[0], atol=1e-5)
        mean = vectors[free, HIDDEN:].mean(axis=0)
        np.testing.assert_allclose(asked, mean / np.linalg.norm(mean), atol=1e-5)
    np.testing.assert_allclose(heads.roles(vectors, mentions), trained.roles(given_, mentions), atol=1e-5)
    np.testing.assert_allclose(heads.tags(vectors), trained.tags(given_[None])[0], atol=1e-5)
    moves, start = heads.moves()
    np.testing.assert_allclose(moves, trained.transition + trained.allowed, rtol=1e-6)
    np.testing.assert_allclose(start, trained.allowed_start)


@given(st.lists(st.integers(1, 4), min_size=1, max_size=3), st.integers(0, 9))
def test_the_layers_read_as_in_training(lengths: list[int], seed: int) -> None:
    """Texts of one piece a word, between a first and a last piece."""
    trained, pieces, width = network(), max(lengths) + 2, max(lengths)
    lower, here = drawn(seed, len(lengths), pieces, HIDDEN), np.zeros((len(lengths), pieces), np.int32)
    pooling = torch.zeros(len(lengths), width, pieces)
    for row, length in enumerate(lengths):
        here[row, : length + 2] = 1
        for word in range(length):
            pooling[row, word, word + 1] = 1.0
    found = trained.read(torch.from_numpy(lower), torch.from_numpy(here).bool(), pooling).numpy()
    after = build(trained.upper(), UPPER)(lower, here)[-1]
    for row, length in enumerate(lengths):
        expected = np.concatenate([lower, after], axis=2)[row, 1 : length + 1]
        np.testing.assert_allclose(found[row, :length], expected, atol=1e-4)
        assert not found[row, length:].any()


def test_no_mention_plays_no_part() -> None:
    assert network().heads().roles(np.zeros((2, 2 * HIDDEN), np.float32), []).shape == (0, 3)


def test_a_configuration_knows_the_shapes_of_its_tensors() -> None:
    trained = network()
    assert CONFIG.shapes() == {name: tensor.shape for name, tensor in trained.heads().tensors.items()}
    assert CONFIG.upper_shapes() == {name: tensor.shape for name, tensor in trained.upper().items()}
