"""The network that compares commands: what is asked for, apart from what it is asked of.

MiniLM reads the words, all of its layers, of which the upper ones are fitted here: what a sentence asks for is in them,
and they hold opposites for alike. What they make of the words is read in three ways: a conditional random field finds
the words that name things; the mean of all others is the vector of what is asked for (Reimers and Gurevych,
"Sentence-BERT", EMNLP 2019); and each mention, with the words before it, gets a vector of the part it plays, near to
that of the mention with the same part in another command. Nothing here knows a task: all of them are examples to
compare with, as in prototypical networks (Snell et al., NeurIPS 2017).

Shapes: B texts, P pieces, S words, H hidden numbers of MiniLM, D = 2 H, R of roles, 3 tags (outside, begin, go on).
"""

from __future__ import annotations

from collections.abc import Sequence

import torch
from torch import Tensor, nn
from torch.nn import functional

from models.language.encoder.layers import layer_name
from models.language.encoder.torch_layers import Layer
from models.language.matching.config import LEFT, TAGS, UPPER, MatchConfig
from models.language.matching.heads import Heads, forbidden
from models.language.runtime import Floats, Tensors
from models.language.spans.tags import Span

LAYER_DROPOUT = 0.1
"""Part of what each layer is given that is left out in training."""


class MatchNet(nn.Module):
    """MiniLM's upper layers, and three readings of the vectors of words."""

    allowed: Tensor
    allowed_start: Tensor

    def __init__(self, config: MatchConfig, upper: Tensors) -> None:
        """With layers as MiniLM's tensors `upper` say, to begin with."""
        super().__init__()
        self.config = config
        self.layers = nn.ModuleList(Layer(upper, layer_name(number)) for number in UPPER)
        self.layer_dropout = nn.Dropout(LAYER_DROPOUT)
        self.dropout = nn.Dropout(config.dropout)
        self.role = nn.Linear(2 * config.vector, config.role)
        self.tag = nn.Linear(config.vector, TAGS)
        self.transition = nn.Parameter(torch.zeros(TAGS, TAGS))
        moves, start = (torch.from_numpy(scores).float() for scores in forbidden())
        self.register_buffer("allowed", moves, persistent=False)
        self.register_buffer("allowed_start", start, persistent=False)

    def heads(self) -> Heads:
        """What was learned besides the layers, to be used without torch."""
        learned = {name: tensor.numpy().copy() for name, tensor in self.state_dict().items()}
        return Heads(self.config, {name: learned[name] for name in self.config.shapes()})

    def upper(self) -> Tensors:
        """The layers, named as MiniLM's."""
        found: dict[str, Floats] = {}
        for number, layer in zip(UPPER, self.layers, strict=True):
            assert isinstance(layer, Layer)
            found |= layer.tensors(layer_name(number))
        return found

    def read(self, states: Tensor, here: Tensor, pooling: Tensor) -> Tensor:
        """[B, S, D] the vectors of words, of the states [B, P, H] that MiniLM's lower layers made of pieces, of which
        those count that are `here` [B, P]; `pooling` [B, S, P] says how much of a word each of its pieces is.
        """
        upper = states
        for layer in self.layers:
            upper = layer(self.layer_dropout(upper), here[:, None, None, :])
        return pooling @ torch.cat([states, upper], dim=2)

    def asked(self, vectors: Tensor, free: Tensor) -> Tensor:
        """[B, H] unit vectors of what texts with the vectors [B, S, D] ask for; `free` [B, S] is 1 for the words that
        name nothing, 0 for the others.
        """
        return functional.normalize((vectors[:, :, self.config.hidden :] * free[:, :, None]).sum(dim=1), dim=1)

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
