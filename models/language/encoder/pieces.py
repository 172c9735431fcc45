"""Words cut into the pieces that MiniLM knows."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Self

from models.language.errors import WeightsError

UNKNOWN, START, END = "[UNK]", "[CLS]", "[SEP]"
MAX_PIECES = 8
"""Pieces of a word that count, and the longest prefix that is cut into pieces is MAX_LETTERS long."""
MAX_LETTERS = 40


@dataclass(frozen=True, slots=True)
class Pieces:
    """The number of each piece; one that continues a word starts with "##"."""

    numbers: Mapping[str, int]

    @classmethod
    def load(cls, file: Path) -> Self:
        """One piece on each line; raises WeightsError."""
        try:
            pieces = file.read_text(encoding="utf-8").split("\n")[:-1]
        except OSError as error:
            raise WeightsError(f"the pieces of words cannot be read: {error.strerror} ({error.filename})") from None
        except UnicodeDecodeError as error:
            raise WeightsError(f"the pieces of words are damaged: {error}") from None
        if not {UNKNOWN, START, END} <= set(pieces):
            raise WeightsError(f"the pieces of words in {file} lack {UNKNOWN}, {START} or {END}")
        return cls({piece: number for number, piece in enumerate(pieces)})

    def cut(self, word: str) -> tuple[int, ...]:
        """The pieces of a folded word, longest first from the left; UNKNOWN for a letter that is no piece."""
        numbers: list[int] = []
        start, word = 0, word[:MAX_LETTERS]
        while start < len(word) and len(numbers) < MAX_PIECES:
            ends = range(len(word), start, -1)
            found = next((end for end in ends if _piece(word, start, end) in self.numbers), None)
            numbers.append(self.numbers[UNKNOWN if found is None else _piece(word, start, found)])
            start = start + 1 if found is None else found
        return tuple(numbers)

    def cut_text(self, text: Sequence[str], most: int) -> tuple[list[int], list[int]]:
        """The numbers of a text's pieces between START and END, at most `most`, and for each of them but these two the
        place of its word.
        """
        cuts = [self.cut(word) for word in text]
        inner = [(number, place) for place, cut in enumerate(cuts) for number in cut][: most - 2]
        numbers = [self.numbers[START], *(number for number, _ in inner), self.numbers[END]]
        return numbers, [place for _, place in inner]


def _piece(word: str, start: int, end: int) -> str:
    return f"##{word[start:end]}" if start else word[start:end]
