"""An encoder that reads each text once: what makes many trainings on the same texts cheap."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field
from typing import Protocol

import numpy as np

from models.language.runtime import Floats


class WordReader(Protocol):
    """What gives words their vectors."""

    @property
    def size(self) -> int:
        """Numbers in the vector of a word, D."""

    def read(self, texts: Sequence[Sequence[str]]) -> Floats:
        """[B, S, D] the vectors of folded words; 0 beyond the end of a text."""


@dataclass(frozen=True, slots=True, eq=False)
class RememberingReader:
    """As `reader`, but each text is read once and its vectors are kept, a few kilobytes a word.

    A text is read alone: then its vectors do not depend on the texts that were asked for with it. In training, where
    that does not matter, new texts are read `together`.
    """

    reader: WordReader
    together: bool = False
    _known: dict[tuple[str, ...], Floats] = field(default_factory=dict, repr=False)

    @property
    def size(self) -> int:
        """See `WordReader`."""
        return self.reader.size

    def read(self, texts: Sequence[Sequence[str]]) -> Floats:
        """See `WordReader`."""
        asked = [tuple(text) for text in texts]
        new = [text for text in dict.fromkeys(asked) if text not in self._known]
        parts = [[text] for text in new] if not self.together else [new] if new else []
        for part in parts:
            for text, vectors in zip(part, self.reader.read(part), strict=True):
                self._known[text] = vectors[: len(text)].copy()
        found = np.zeros((len(asked), max(map(len, asked)), self.size), np.float32)
        for row, text in enumerate(asked):
            found[row, : len(text)] = self._known[text]
        return found
