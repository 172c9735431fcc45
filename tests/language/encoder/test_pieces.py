"""Cutting words into pieces."""

from __future__ import annotations

from pathlib import Path

import pytest

from models.language import WeightsError
from models.language.encoder.pieces import MAX_LETTERS, MAX_PIECES, Pieces

KNOWN = ["[UNK]", "[CLS]", "[SEP]", "a", "b", "c", "##a", "##b", "##c", "ab", "##bc", "abc"]


@pytest.fixture
def pieces() -> Pieces:
    return Pieces({piece: number for number, piece in enumerate(KNOWN)})


@pytest.mark.parametrize(
    ("word", "cut"),
    [
        ("abc", ["abc"]),
        ("abcb", ["abc", "##b"]),
        ("abbc", ["ab", "##bc"]),
        ("bbc", ["b", "##bc"]),
        ("xa", ["[UNK]", "##a"]),
        ("é", ["[UNK]"]),
        ("", []),
        ("a" * 100, ["a", *["##a"] * (MAX_PIECES - 1)]),
    ],
)
def test_words_are_cut_into_their_longest_pieces(pieces: Pieces, word: str, cut: list[str]) -> None:
    assert [KNOWN[number] for number in pieces.cut(word)] == cut
    assert MAX_PIECES <= MAX_LETTERS


def test_the_pieces_of_a_text_stand_between_start_and_end(pieces: Pieces) -> None:
    numbers, places = pieces.cut_text(["abcb", "a"], most=10)
    assert [KNOWN[number] for number in numbers] == ["[CLS]", "abc", "##b", "a", "[SEP]"]
    assert places == [0, 0, 1]
    numbers, places = pieces.cut_text(["abcb", "a"], most=4)
    assert [KNOWN[number] for number in numbers] == ["[CLS]", "abc", "##b", "[SEP]"]
    assert places == [0, 0]


def test_files_that_are_wrong(tmp_path: Path) -> None:
    with pytest.raises(WeightsError, match=r"vocab\.txt"):
        Pieces.load(tmp_path / "vocab.txt")
    (tmp_path / "vocab.txt").write_text("[UNK]\na\n")
    with pytest.raises(WeightsError, match=r"lack"):
        Pieces.load(tmp_path / "vocab.txt")
    (tmp_path / "vocab.txt").write_bytes(b"\xff\xfe")
    with pytest.raises(WeightsError, match="damaged"):
        Pieces.load(tmp_path / "vocab.txt")
