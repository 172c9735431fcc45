from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from safetensors.numpy import save

from models.language.errors import WeightsError
from models.language.spans.build_lexicon import build
from models.language.spans.lexicon import MAX_PIECES, TRAITS, Lexicon, lexicon

PIECES = ["[UNK]", "tape", "ta", "##pe", "##r", "measure", "##s", "a", "##a"]


@pytest.fixture
def small() -> Lexicon:
    table = np.arange(len(PIECES) * 2, dtype=np.int8).reshape(-1, 2)
    return Lexicon({piece: number for number, piece in enumerate(PIECES)}, table, 0.5)


@pytest.mark.parametrize(
    ("word", "pieces"),
    [
        ("tape", ["tape"]),
        ("taper", ["tape", "##r"]),  # longest first, as MiniLM's tokeniser cuts
        ("measures", ["measure", "##s"]),
        ("xa", ["[UNK]", "##a"]),
        ("a" * 100, ["a", *["##a"] * (MAX_PIECES - 1)]),
    ],
)
def test_words_are_cut_into_their_longest_pieces(small: Lexicon, word: str, pieces: list[str]) -> None:
    assert small.cut(word) == tuple(PIECES.index(piece) for piece in pieces)


def test_a_vector_is_the_mean_of_the_pieces_and_what_the_word_looks_like(small: Lexicon) -> None:
    # tape is row 1: (2, 3), ##r row 4: (8, 9); halved; two pieces, so neither one nor many; no digit
    assert small.vector("taper").tolist() == [2.5, 3.0, 0.0, 0.0, 0.0]
    assert small.vector("tape").tolist() == [1.0, 1.5, 1.0, 0.0, 0.0]
    assert small.vector("a2b").tolist()[-TRAITS:] == [0.0, 1.0, 1.0]
    assert small.vectors(["tape", "taper"]).shape == (2, small.size)
    assert small.silent().vector("taper").tolist() == [0.0, 0.0, 0.0, 0.0, 0.0]


def test_the_shipped_lexicon_knows_what_words_are_like() -> None:
    def likeness(one: str, two: str) -> float:
        left, right = (lexicon().vector(word)[:-TRAITS] for word in (one, two))
        return float(left @ right / np.linalg.norm(left) / np.linalg.norm(right))

    assert likeness("turquoise", "green") > likeness("turquoise", "hammer")
    assert likeness("hallway", "bedroom") > likeness("hallway", "green")
    assert lexicon().cut("turquoise") == (lexicon().pieces["turquoise"],)


def test_building_keeps_the_directions_in_which_the_vectors_differ(tmp_path: Path) -> None:
    generator = np.random.default_rng(0)
    axis = generator.normal(size=(1, 384))
    strength = generator.normal(size=(50, 1))
    vectors = (strength * axis + 1e-3 * generator.normal(size=(50, 384)) + 7.0).astype(np.float32)
    (tmp_path / "vocab.txt").write_text("".join(f"piece{n}\n" for n in range(49)) + "[UNK]\n")
    (tmp_path / "model.safetensors").write_bytes(save({"embeddings.word_embeddings.weight": vectors}))
    build(tmp_path, tmp_path / "out", size=1)
    made = Lexicon.load(tmp_path / "out")
    first = made.table[:, 0].astype(float)
    assert abs(np.corrcoef(first, strength[:, 0])[0, 1]) > 0.99
    before = {path.name: path.read_bytes() for path in (tmp_path / "out").iterdir()}
    build(tmp_path, tmp_path / "out", size=1)
    assert {path.name: path.read_bytes() for path in (tmp_path / "out").iterdir()} == before


def test_a_damaged_lexicon_is_refused(tmp_path: Path) -> None:
    with pytest.raises(WeightsError, match=r"lexicon\.txt"):
        Lexicon.load(tmp_path)
    (tmp_path / "lexicon.txt").write_text("[UNK]\na\n")
    (tmp_path / "lexicon.safetensors").write_bytes(b"no")
    with pytest.raises(WeightsError, match="damaged"):
        Lexicon.load(tmp_path)
    tensors = {"pieces": np.zeros((3, 2), dtype=np.int8), "scale": np.ones(1, dtype=np.float32)}
    (tmp_path / "lexicon.safetensors").write_bytes(save(tensors))
    with pytest.raises(WeightsError, match="fit together"):
        Lexicon.load(tmp_path)
