"""MiniLM's vectors: the same whatever else is read, alike for what means alike, and those of torch's own layers."""

from __future__ import annotations

from importlib.util import find_spec
from pathlib import Path

import numpy as np
import pytest
import torch
from safetensors.torch import load_file, save
from torch import Tensor, nn

from models.language import WeightsError
from models.language.encoder import Encoder, encoder
from models.language.encoder.layers import HEADS
from models.language.encoder.minilm import KEPT, LAYERS, LOWER, MOST_PIECES, PACKAGE
from models.language.encoder.pieces import Pieces
from models.language.encoder.torch_layers import on
from models.language.runtime import Floats
from models.language.tokens import words

SHIP = tuple(words("put the cylinder in the box then put the box in the bedroom"))


def folder() -> Path:
    found = find_spec(PACKAGE)
    assert found is not None
    assert found.submodule_search_locations
    return Path(found.submodule_search_locations[0]) / "model"


def test_a_text_has_the_same_vectors_alone_and_with_others() -> None:
    alone = encoder().read([SHIP])
    together = encoder().read([("go",), SHIP, SHIP[:4]])
    assert alone.shape == (1, len(SHIP), encoder().size)
    np.testing.assert_allclose(together[1], alone[0], atol=1e-4)
    assert not together[0, 1:].any()
    assert np.array_equal(encoder().read([SHIP]), alone)


def test_words_mean_something_where_they_stand() -> None:
    def vector(text: str, word: str) -> Floats:
        spoken = text.split()
        return encoder().read([spoken])[0, spoken.index(word)]

    def near(one: Floats, other: Floats) -> float:
        return float(one @ other / np.linalg.norm(one) / np.linalg.norm(other))

    fruit, color = vector("pick up the orange", "orange"), vector("paint the wall orange now", "orange")
    apple = vector("pick up the apple", "apple")
    assert near(fruit, apple) > near(color, apple)
    assert near(fruit, color) < 0.999


def test_the_layers_compute_what_torchs_encoder_does() -> None:
    """torch.nn.TransformerEncoderLayer with the same weights is an independent implementation of the same layer."""
    weights = load_file(folder() / "model.safetensors")
    numbers, _ = encoder().pieces.cut_text(SHIP, MOST_PIECES)
    embedded = (
        weights["embeddings.word_embeddings.weight"][numbers] + weights["embeddings.token_type_embeddings.weight"][0]
    )
    embedded = embedded + weights["embeddings.position_embeddings.weight"][: len(numbers)]
    norm = (weights["embeddings.LayerNorm.weight"], weights["embeddings.LayerNorm.bias"])
    states = nn.functional.layer_norm(embedded, (embedded.shape[1],), *norm, eps=1e-12)[None]
    after = []
    for number in range(LAYERS):
        states = _reference(weights, f"encoder.layer.{number}")(states)
        after.append(states.detach()[0, 1:-1].numpy())
    lower, deep = ([*KEPT], [LOWER - 1, LAYERS - 1])
    for found, kept in ((encoder().read([SHIP])[0], lower), (encoder().deep.read([SHIP])[0], deep)):
        np.testing.assert_allclose(found, np.concatenate([after[number] for number in kept], axis=1), atol=1e-4)


def test_a_word_is_the_mean_of_its_pieces() -> None:
    """Each piece as a word of its own stands where it stood, so the layers see no difference."""
    text = ("grab", "the", "screwdrivers")
    pieces = [encoder().pieces.cut(word) for word in text]
    assert [len(each) for each in pieces] == [1, 1, 3]

    class Apart(Pieces):
        def cut(self, word: str) -> tuple[int, ...]:
            return (int(word),)

    apart = Encoder.load()
    apart.pieces = Apart(encoder().pieces.numbers)
    each = apart.read([[str(number) for cut in pieces for number in cut]])[0]
    np.testing.assert_allclose(encoder().read([text])[0], [each[0], each[1], each[2:].mean(axis=0)], atol=1e-5)


def test_torch_reads_alike() -> None:
    """On a device of torch's, where networks may be trained; this one is always there."""
    other = Encoder.load(build=on("cpu"))
    texts = [SHIP, ("go",), SHIP[:4]]
    np.testing.assert_allclose(other.read(texts), encoder().read(texts), atol=1e-4)
    np.testing.assert_allclose(other.deep.read(texts), encoder().deep.read(texts), atol=1e-4)


def _reference(weights: dict[str, Tensor], name: str) -> nn.TransformerEncoderLayer:
    layer = nn.TransformerEncoderLayer(
        384, HEADS, 1536, dropout=0.0, activation="gelu", layer_norm_eps=1e-12, batch_first=True
    )
    parts = [f"{name}.attention.self.{part}" for part in ("query", "key", "value")]
    state = {
        "self_attn.in_proj_weight": torch.cat([weights[f"{part}.weight"] for part in parts]),
        "self_attn.in_proj_bias": torch.cat([weights[f"{part}.bias"] for part in parts]),
    }
    for ours, theirs in (
        ("self_attn.out_proj", "attention.output.dense"),
        ("norm1", "attention.output.LayerNorm"),
        ("linear1", "intermediate.dense"),
        ("linear2", "output.dense"),
        ("norm2", "output.LayerNorm"),
    ):
        state |= {f"{ours}.{kind}": weights[f"{name}.{theirs}.{kind}"] for kind in ("weight", "bias")}
    layer.load_state_dict(state)
    return layer.eval()


def test_a_text_beyond_its_positions_ends_in_zeros() -> None:
    long = ["unbelievably"] * 400
    vectors = encoder().read([long])[0]
    assert vectors[0].any()
    assert not vectors[-1].any()


def test_files_that_are_wrong(tmp_path: Path) -> None:
    (tmp_path / "vocab.txt").write_bytes((folder() / "vocab.txt").read_bytes())
    with pytest.raises(WeightsError, match=r"model\.safetensors"):
        Encoder.load(tmp_path)
    (tmp_path / "model.safetensors").write_bytes(b"no")
    with pytest.raises(WeightsError, match="damaged"):
        Encoder.load(tmp_path)
    (tmp_path / "model.safetensors").write_bytes(save({"embeddings.word_embeddings.weight": torch.zeros(2, 2)}))
    with pytest.raises(WeightsError, match="lack"):
        Encoder.load(tmp_path)
