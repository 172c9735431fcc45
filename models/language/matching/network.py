"""The network that compares commands: what is asked for, apart from what it is asked of.

MiniLM's vectors of the words (all six layers: what a sentence asks for is in the upper ones) are read in three ways: a
conditional random field finds the words that name things; the mean of the other words, projected, says what is asked
for, and is near to that of another command which asks for the same; and each mention, with the words before it, gets a
vector of the part it plays, near to that of the mention with the same part in another command. Nothing here knows a
task: all of them are examples to compare with, as in prototypical networks (Snell et al., NeurIPS 2017).

Shapes: B texts, S words, D encoder, V vectors of commands, R of roles, 3 tags (outside, begin, go on).
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import torch
from torch import Tensor, nn
from torch.nn import functional

from models.language.spans.crf import FORBIDDEN
from models.language.spans.tags import Span

TAGS = 3
OUTSIDE, BEGIN, ON = range(TAGS)
LEFT = 2
"""Words before a mention that tell the part it plays: "to the", "instead of the"."""


@dataclass(frozen=True, slots=True)
class MatchConfig:
    """The sizes of a network; `vector` is D, `command` is V, `role` is R."""

    vector: int
    hidden: int = 512
    command: int = 256
    role: int = 96
    dropout: float = 0.3


class MatchNet(nn.Module):
    """Three readings of the vectors of words."""

    allowed: Tensor
    allowed_start: Tensor

    def __init__(self, config: MatchConfig) -> None:
        super().__init__()
        self.config = config
        self.dropout = nn.Dropout(config.dropout)
        self.command = nn.Sequential(
            nn.Linear(config.vector, config.hidden),
            nn.GELU(),
            nn.Dropout(config.dropout),
            nn.Linear(config.hidden, config.command),
        )
        self.role = nn.Linear(2 * config.vector, config.role)
        self.tag = nn.Linear(config.vector, TAGS)
        self.transition = nn.Parameter(torch.zeros(TAGS, TAGS))
        moves = torch.zeros(TAGS, TAGS)
        moves[OUTSIDE, ON] = FORBIDDEN
        self.register_buffer("allowed", moves, persistent=False)
        self.register_buffer("allowed_start", torch.tensor([0.0, 0.0, FORBIDDEN]), persistent=False)

    def commands(self, vectors: Tensor, free: Tensor) -> Tensor:
        """[B, V] unit vectors of what is asked for.

        Args:
            vectors: [B, S, D].
            free: [B, S], 1 for the words that name nothing, 0 for the others and beyond the end of a text; a text of
                nothing but names counts as a whole.
        """
        count = free.sum(dim=1, keepdim=True)  # [B, 1]
        mean = (vectors * free[:, :, None]).sum(dim=1) / count.clamp(min=1.0)  # [B, D]
        return functional.normalize(self.command(self.dropout(mean)), dim=1)

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
