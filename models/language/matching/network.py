"""The network that compares commands: what is asked for, apart from what it is asked of.

MiniLM reads the words, all of its layers: what a sentence asks for is in the upper ones. Its vectors are read in three
ways: a conditional random field finds the words that name things; each of the other words, moved a little, is looked
for in another command, which asks for the same when all that matters is found there (late interaction: Khattab and
Zaharia, "ColBERT", SIGIR 2020); and each mention, with the words before it, gets a vector of the part it plays, near to
that of the mention with the same part in another command. Nothing here knows a task: all of them are examples to
compare with, as in prototypical networks (Snell et al., NeurIPS 2017).

Shapes: B texts, S words, D encoder, V its upper half, R of roles, 3 tags (outside, begin, go on).
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

import torch
from torch import Tensor, nn
from torch.nn import functional

from models.language.matching.config import LEFT, TAGS, MatchConfig
from models.language.matching.heads import Heads, forbidden
from models.language.spans.tags import Span


class Commands(NamedTuple):
    """B commands: unit vectors of what each word asks for, [B, S, V], and how much each matters, [B, S]."""

    words: Tensor
    salience: Tensor

    def nearness(self, free: Tensor) -> Tensor:
        """[B, B] of each command to each, between -1 and 1: what matters in one is found in the other, on average of
        both ways. `free` [B, S] is 1 for the words that count, of which each command has one, 0 for the others.
        """
        weights = self.salience * free
        weights = weights / weights.sum(dim=1, keepdim=True)  # [B, S]
        near = torch.einsum("nsv,mtv->nmst", self.words, self.words)
        found = near.masked_fill(free[None, :, None, :] == 0, -1.0).amax(dim=3)  # [B, B, S], of one's words in other
        one_way = (found * weights[:, None, :]).sum(dim=2)  # [B, B]
        return (one_way + one_way.T) / 2


class MatchNet(nn.Module):
    """Three readings of the vectors of words."""

    allowed: Tensor
    allowed_start: Tensor

    def __init__(self, config: MatchConfig) -> None:
        super().__init__()
        self.config = config
        self.dropout = nn.Dropout(config.dropout)
        self.word = nn.Linear(config.word, config.word)
        self.salience = nn.Linear(config.vector, 1)
        for layer in (self.word, self.salience):
            nn.init.zeros_(layer.weight)
        self.role = nn.Linear(2 * config.vector, config.role)
        self.tag = nn.Linear(config.vector, TAGS)
        self.transition = nn.Parameter(torch.zeros(TAGS, TAGS))
        moves, start = (torch.from_numpy(scores).float() for scores in forbidden())
        self.register_buffer("allowed", moves, persistent=False)
        self.register_buffer("allowed_start", start, persistent=False)

    def heads(self) -> Heads:
        """What was learned, to be used without torch."""
        return Heads(self.config, {name: tensor.numpy().copy() for name, tensor in self.state_dict().items()})

    def commands(self, vectors: Tensor) -> Commands:
        """What words with the vectors [B, S, D] ask for.

        Words are what MiniLM makes of them, and what is learned is added to it: from a few hundred tasks less can be
        learned than MiniLM knows.
        """
        upper = vectors[:, :, self.config.word :]
        words = functional.normalize(upper + self.word(self.dropout(upper)), dim=2)
        return Commands(words, functional.softplus(self.salience(self.dropout(vectors))).squeeze(2))

    @torch.no_grad()
    def centre(self, vectors: Tensor) -> None:
        """Begin from what tells words apart: take away the mean of vectors [N, D], which all have in common."""
        self.word.bias.copy_(-vectors[:, self.config.word :].mean(dim=0))

    def roles(self, vectors: Tensor, mentions: Sequence[Span]) -> Tensor:
        """[M, R] unit vectors of the parts that mentions play in a text with the vectors [S, D]."""
        parts = []
        for begin, end in mentions:
            before = vectors[max(0, begin - LEFT) : begin]
            left = before.mean(dim=0) if begin else torch.zeros_like(vectors[0])
            parts.append(torch.cat([vectors[begin:end].mean(dim=0), left]))
        return functional.normalize(self.role(self.dropout(torch.stack(parts))), dim=1)

    def tags(self, vectors: Tensor) -> Tensor:
        """[B, S, 3] the scores of the tags of words."""
        emissions: Tensor = self.tag(self.dropout(vectors))
        return emissions
