"""Words and marks of punctuation as vectors: a mark has none, so that a text is read alike with and without marks.

The network of compositions tells marks by their embeddings. As a text's words are read without marks, as for the
network of single tasks, MiniLM's lower layers read the text once for both.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Self

import numpy as np

from models.language.encoder import Encoder, WordReader, encoder
from models.language.runtime import Floats
from models.language.tokens import is_mark


@dataclass(frozen=True, slots=True, eq=False)
class MarkedReader:
    """As `reader`, for texts with marks."""

    reader: WordReader

    @classmethod
    def load(cls, words: Encoder | None = None) -> Self:
        """What the networks of compositions read with: all layers of an encoder, or of the one that is installed."""
        return cls((words or encoder()).deep)

    @property
    def size(self) -> int:
        """See `WordReader`."""
        return self.reader.size

    def read(self, texts: Sequence[Sequence[str]]) -> Floats:
        """See `WordReader`; 0 for marks."""
        places = [[place for place, word in enumerate(text) if not is_mark(word)] for text in texts]
        plain = [tuple(text[place] for place in kept) for text, kept in zip(texts, places, strict=True)]
        if all(len(kept) == len(text) for kept, text in zip(places, texts, strict=True)):
            return self.reader.read(plain)
        width = max(map(len, texts))
        spoken = [row for row, kept in enumerate(places) if kept]
        if not spoken:
            return np.zeros((len(texts), width, self.size), np.float32)
        found = self.reader.read([plain[row] for row in spoken])
        vectors = np.zeros((len(texts), width, self.size), np.float32)
        for row, read in zip(spoken, found, strict=True):
            vectors[row, places[row]] = read[: len(places[row])]
        return vectors
