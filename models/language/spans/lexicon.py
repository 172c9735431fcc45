"""What words mean before any task is learned: a vector for every word, known or not.

The vectors are the input embeddings of MiniLM's word pieces (Wang et al. 2020; the sentence-transformers model
all-MiniLM-L6-v2, Apache 2.0), reduced to their first principal components and kept as bytes. They were learned from
general text, so that "turquoise" lies near "green" and "hallway" near "bedroom" for words that no training command
holds. A word of several pieces has the mean of their vectors; there is always one, as letters are pieces.
`models.language.spans.build_lexicon` makes the files.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from functools import cache
from importlib.resources import files
from pathlib import Path
from typing import Self

import numpy as np
from numpy.typing import NDArray
from safetensors import SafetensorError
from safetensors.numpy import load as load_tensors

from models.language.errors import WeightsError

UNKNOWN = "[UNK]"
MAX_PIECES = 8
"""Pieces of a word that count, and the longest prefix that is cut into pieces is MAX_LETTERS long."""
MAX_LETTERS = 40
TRAITS = 3
"""Numbers beside the piece vectors: whether the word is one piece, whether it is three or more, whether it has a digit.
Names that nobody ever heard, and slips of the pen, fall into many pieces."""


@dataclass(frozen=True, slots=True)
class Lexicon:
    """Word pieces and their vectors.

    Attributes:
        pieces: number of each piece; one that continues a word starts with "##".
        table: [P, D - TRAITS] int8.
        scale: what the bytes are multiplied with.
    """

    pieces: Mapping[str, int]
    table: NDArray[np.int8]
    scale: float
    _known: dict[str, NDArray[np.float32]] = field(default_factory=dict, repr=False, compare=False)

    @property
    def size(self) -> int:
        """Numbers in the vector of a word, D."""
        return int(self.table.shape[1]) + TRAITS

    @classmethod
    def load(cls, folder: Path | None = None) -> Self:
        """The lexicon of a folder, or the one that is shipped.

        Raises:
            WeightsError: a file is missing or damaged, or the two do not fit together.
        """
        place = files("models.language") / "weights" if folder is None else folder
        try:
            pieces = (place / "lexicon.txt").read_text(encoding="utf-8").split("\n")[:-1]
            tensors = load_tensors((place / "lexicon.safetensors").read_bytes())
            table, scale = tensors["pieces"], float(tensors["scale"][0])
        except OSError as error:
            raise WeightsError(f"the lexicon cannot be read: {error.strerror} ({error.filename})") from None
        except (SafetensorError, KeyError, UnicodeDecodeError) as error:
            raise WeightsError(f"the lexicon is damaged: {error}") from None
        if table.ndim != 2 or table.dtype != np.int8 or len(table) != len(pieces) or UNKNOWN not in pieces:
            raise WeightsError("the files of the lexicon do not fit together")
        return cls({piece: number for number, piece in enumerate(pieces)}, table, scale)

    def cut(self, word: str) -> tuple[int, ...]:
        """The pieces of a folded word, longest first from the left; UNKNOWN for a letter that is no piece."""
        numbers: list[int] = []
        start, word = 0, word[:MAX_LETTERS]
        while start < len(word) and len(numbers) < MAX_PIECES:
            ends = range(len(word), start, -1)
            found = next((end for end in ends if self._piece(word, start, end) in self.pieces), None)
            numbers.append(self.pieces[UNKNOWN if found is None else self._piece(word, start, found)])
            start = start + 1 if found is None else found
        return tuple(numbers)

    def vector(self, word: str) -> NDArray[np.float32]:
        """The vector [D] of a folded word."""
        vector = self._known.get(word)
        if vector is None:
            numbers = self.cut(word)
            mean = self.table[list(numbers)].astype(np.float32).mean(axis=0) * self.scale  # [D - TRAITS]
            traits = [len(numbers) == 1, len(numbers) > 2, any(letter.isdigit() for letter in word)]
            vector = np.concatenate([mean, np.array(traits, dtype=np.float32)])
            if len(self._known) >= 50_000:  # names come from anywhere; what is kept is bounded
                self._known.clear()
            self._known[word] = vector
        return vector

    def vectors(self, words: Sequence[str]) -> NDArray[np.float32]:
        """The vectors [S, D] of the words of a text."""
        return np.stack([self.vector(word) for word in words])

    def silent(self) -> Lexicon:
        """The same pieces with vectors that say nothing, to measure what the vectors are worth."""
        return Lexicon(self.pieces, np.zeros_like(self.table), self.scale)

    @staticmethod
    def _piece(word: str, start: int, end: int) -> str:
        return f"##{word[start:end]}" if start else word[start:end]


@cache
def lexicon() -> Lexicon:
    """The lexicon that is shipped, loaded once."""
    return Lexicon.load()
