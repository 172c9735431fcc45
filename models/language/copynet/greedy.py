"""Greedy decoding of many texts at once: the most probable word at every step."""

from __future__ import annotations

from collections.abc import Sequence

import torch

from models.language.copynet.batch import SourceBatch
from models.language.copynet.network import CopyNet, log_probabilities
from models.language.copynet.vocabulary import Source, Vocabulary

BATCH = 512
"""Texts decoded together."""


@torch.inference_mode()
def greedy_search(
    network: CopyNet, vocabulary: Vocabulary, sources: Sequence[Source], *, steps: int
) -> list[tuple[int, ...]]:
    """The output sequence of each text as extended numbers, `END` last.

    A sequence that has not ended after `steps` words is cut there. Texts of similar length go together, to pad less.
    """
    order = sorted(range(len(sources)), key=lambda index: len(sources[index].ids))
    found: list[tuple[int, ...]] = [()] * len(sources)
    for start in range(0, len(order), BATCH):
        chunk = order[start : start + BATCH]
        said = _decode(network, vocabulary, [sources[index] for index in chunk], steps)
        for index, words in zip(chunk, said, strict=True):
            found[index] = words
    return found


def _decode(network: CopyNet, vocabulary: Vocabulary, sources: Sequence[Source], steps: int) -> list[tuple[int, ...]]:
    """`greedy_search` of one batch."""
    source = SourceBatch.of(sources, vocabulary)
    memory, state = network.encode(source)
    last = torch.full((len(sources),), vocabulary.start)  # [B]
    ended = torch.zeros(len(sources), dtype=torch.bool)  # [B]
    said = []
    for _ in range(steps):
        scores, state = network.step(last, state, memory)  # [B, G + S]
        last = log_probabilities(scores, source).argmax(dim=1)  # [B]
        said.append(last)
        ended |= last == vocabulary.end
        if bool(ended.all()):
            break
    rows = torch.stack(said, dim=1).tolist()  # [B, T]
    return [tuple(row[: row.index(vocabulary.end) + 1] if vocabulary.end in row else row) for row in rows]
