"""Texts as the matching network is given them in training: read by MiniLM's lower layers once, which stay as they are.

Shapes: B texts, P pieces, S words, H hidden numbers of MiniLM, D = 2 H.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
import torch
from torch import Tensor

from models.language.encoder import Encoder
from models.language.matching.config import BEGIN, ON, OUTSIDE
from models.language.matching.lessons import Lesson, Said, texts_of
from models.language.matching.nearness import free_words
from models.language.matching.network import MatchNet
from models.language.runtime import Floats

Text = tuple[str, ...]
TOGETHER = 64
"""Texts that are read at a time."""


class Lower(NamedTuple):
    """The states [P, H] of the pieces of a text, in half precision, and the places of the words that those between the
    first and the last belong to.
    """

    states: Tensor
    owners: Sequence[int]


class Batch(NamedTuple):
    """States [B, P, H], which of them count [B, P], how much of each word each piece is [B, S, P], free words [B, S],
    tags [B, S] and lengths [B].
    """

    states: Tensor
    here: Tensor
    pooling: Tensor
    free: Tensor
    tags: Tensor
    lengths: Tensor


@dataclass(frozen=True, slots=True, eq=False)
class Course:
    """Lessons and texts that ask for nothing, with what the lower layers make of all of them."""

    lessons: Sequence[Lesson]
    refused: Sequence[Said]
    lower: Mapping[Text, Lower]

    @classmethod
    def of(cls, lessons: Sequence[Lesson], refused: Sequence[Said], encoder: Encoder) -> Course:
        """Read every text once."""
        lower: dict[Text, Lower] = {}
        for part in _parts(text.words for text in [*texts_of(lessons), *refused]):
            read = encoder.lower(part)
            states = torch.from_numpy(read.after[-1].astype(np.float16))
            pieces = read.here.sum(axis=1)
            for row, text in enumerate(part):
                lower[text] = Lower(states[row, : pieces[row]].clone(), read.owners[row])
        return cls(lessons, refused, lower)

    def batch(self, texts: Sequence[Said]) -> Batch:
        """Some of the texts."""
        lower = [self.lower[text.words] for text in texts]
        states = torch.nn.utils.rnn.pad_sequence([each.states.float() for each in lower], batch_first=True)
        lengths = torch.tensor([len(text.words) for text in texts])
        size = (len(texts), int(lengths.max()))
        here, pooling = torch.zeros(states.shape[:2], dtype=torch.bool), torch.zeros(*size, states.shape[1])
        free, tags = torch.zeros(size), torch.full(size, OUTSIDE)
        for row, (text, each) in enumerate(zip(texts, lower, strict=True)):
            here[row, : len(each.states)] = True
            pieces = Counter(each.owners)
            for place, word in enumerate(each.owners, start=1):
                pooling[row, word, place] = 1 / pieces[word]
            free[row, free_words(len(text.words), text.every)] = 1.0
            for begin, end in text.every:
                tags[row, begin], tags[row, begin + 1 : end] = BEGIN, ON
        return Batch(states, here, pooling, free, tags, lengths)

    @torch.no_grad()
    def read(self, network: MatchNet) -> dict[Text, Floats]:
        """The vectors [S, D] that a network makes of the words of each text."""
        found: dict[Text, Floats] = {}
        for part in _parts(self.lower):
            batch = self.batch([Said(text, (), ()) for text in part])
            vectors = network.read(batch.states, batch.here, batch.pooling).half().numpy()
            found.update((text, each[: len(text)].copy()) for text, each in zip(part, vectors, strict=True))
        return found


def _parts(texts: Iterable[Text]) -> Iterable[Sequence[Text]]:
    """Different texts, some at a time: short ones together."""
    said = sorted(set(texts), key=lambda text: (len(text), text))
    return (said[start : start + TOGETHER] for start in range(0, len(said), TOGETHER))
