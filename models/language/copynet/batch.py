"""Commands and queries as padded tensors."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import torch
from torch import Tensor

from models.language.copynet.vocabulary import Source, Vocabulary


@dataclass(frozen=True, slots=True)
class SourceBatch:
    """B texts of up to S words, padded at the end."""

    ids: Tensor  # [B, S] int64, embeddings
    extended: Tensor  # [B, S] int64, words; -1 at padding, which equals no word
    mask: Tensor  # [B, S] bool, where a word is
    lengths: Tensor  # [B] int64
    size: int  # E, words of the vocabulary and the most unknown words of one text

    @classmethod
    def of(cls, sources: Sequence[Source], vocabulary: Vocabulary) -> SourceBatch:
        """Pad texts; each must have a word."""
        lengths = torch.tensor([len(source.ids) for source in sources])  # [B]
        extended = _padded([source.extended for source in sources], -1)  # [B, S]
        return cls(
            ids=_padded([source.ids for source in sources], vocabulary.pad),
            extended=extended,
            mask=extended >= 0,
            lengths=lengths,
            size=len(vocabulary) + max(len(source.unknown) for source in sources),
        )

    def repeat(self, count: int) -> SourceBatch:
        """One text `count` times over."""
        return SourceBatch(
            ids=self.ids.expand(count, -1),  # [count, S]
            extended=self.extended.expand(count, -1),  # [count, S]
            mask=self.mask.expand(count, -1),  # [count, S]
            lengths=self.lengths.expand(count),  # [count]
            size=self.size,
        )


@dataclass(frozen=True, slots=True)
class TargetBatch:
    """B output sequences of up to T words, padded at the end."""

    previous: Tensor  # [B, T] int64 extended, the word before each: `START`, then the words but the last
    words: Tensor  # [B, T] int64 extended
    mask: Tensor  # [B, T] bool, where a word is

    @classmethod
    def of(cls, targets: Sequence[Sequence[int]], vocabulary: Vocabulary) -> TargetBatch:
        """Pad sequences of extended numbers, each with `END` last."""
        words = _padded(targets, -1)  # [B, T]
        mask = words >= 0  # [B, T]
        words = words.masked_fill(~mask, vocabulary.end)  # [B, T]
        start = torch.full((len(targets), 1), vocabulary.start)  # [B, 1]
        return cls(torch.cat([start, words[:, :-1]], dim=1), words, mask)


def _padded(rows: Sequence[Sequence[int]], filler: int) -> Tensor:
    width = max(len(row) for row in rows)
    return torch.tensor([[*row, *[filler] * (width - len(row))] for row in rows])  # [B, width] int64
