"""Words and marks of punctuation as vectors: a mark has none, so that a text is read alike with and without marks.

The network of compositions tells marks by their embeddings. As a text's words are read without marks, as for the
network of single tasks, MiniLM's lower layers read the text once for both.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Self

import torch
from torch import Tensor

from models.language.encoder import DeepReader, WordReader, encoder
from models.language.tokens import is_mark


@dataclass(frozen=True, slots=True, eq=False)
class MarkedReader:
    """As `reader`, for texts with marks."""

    reader: WordReader

    @classmethod
    def load(cls) -> Self:
        """What the network of compositions reads with: all layers of the encoder that is installed."""
        return cls(DeepReader(encoder()))

    @property
    def size(self) -> int:
        """See `WordReader`."""
        return self.reader.size

    def read(self, texts: Sequence[Sequence[str]]) -> Tensor:
        """See `WordReader`; 0 for marks."""
        places = [[place for place, word in enumerate(text) if not is_mark(word)] for text in texts]
        plain = [tuple(text[place] for place in kept) for text, kept in zip(texts, places, strict=True)]
        if all(len(kept) == len(text) for kept, text in zip(places, texts, strict=True)):
            return self.reader.read(plain)
        vectors = torch.zeros(len(texts), max(map(len, texts)), self.size)
        spoken = [row for row, kept in enumerate(places) if kept]
        if spoken:
            for row, read in zip(spoken, self.reader.read([plain[row] for row in spoken]), strict=True):
                vectors[row, places[row]] = read[: len(places[row])]
        return vectors
