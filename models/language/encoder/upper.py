"""The upper layers of MiniLM, adapted: what they lack for a purpose is added as matrices of low rank.

Low-rank adaptation (Hu et al., "LoRA: low-rank adaptation of large language models", ICLR 2022): a frozen linear layer
W becomes W + BA with small A and B, which alone are fitted and stored.

Shapes: B texts, P pieces, H hidden numbers, R rank.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence

import torch
from torch import Tensor, nn
from torch.nn import functional

from models.language.encoder.minilm import LAYERS, LOWER, Layer, Pieced, encoder, word_means

ADAPTED = ("attend", "attended", "widen", "narrow")
"""The linear layers of a `Layer` that are adapted."""


class UpperLayers(nn.Module):
    """Copies of the layers above the first `LOWER`, with adapters of a rank; only these have gradients."""

    def __init__(self, rank: int, *, dropout: float) -> None:
        """Raises WeightsError when MiniLM is not installed."""
        super().__init__()
        self.layers = nn.ModuleList(encoder().copied_layer(number) for number in range(LOWER, LAYERS))
        self.dropout = nn.Dropout(dropout)
        for layer in self._layers():
            for name in ADAPTED:
                setattr(layer, name, Adapted(getattr(layer, name), rank))

    def forward(self, texts: Sequence[Pieced]) -> Tensor:
        """[B, S, 2 H] the vectors of words: the lower layers', and those of all; 0 beyond the end of a text."""
        lower, owner, mask = _padded(texts)
        states = lower
        for layer in self.layers:
            states = self.dropout(layer(states, mask))
        return word_means(torch.cat([lower, states], dim=2), owner, max(text.count for text in texts))

    def merge(self) -> None:
        """Put the adapters into the layers that they adapt: reading is as fast as without any, and fitting is over."""
        for layer in self._layers():
            for name in ADAPTED:
                setattr(layer, name, getattr(layer, name).merged())

    def _layers(self) -> Iterator[Layer]:
        return (layer for layer in self.layers if isinstance(layer, Layer))


class Adapted(nn.Module):
    """A frozen linear layer with an adapter, which at first adds nothing."""

    def __init__(self, frozen: nn.Linear, rank: int) -> None:
        super().__init__()
        self.frozen = frozen
        self.down = nn.Parameter(torch.randn(rank, frozen.in_features) / frozen.in_features**0.5)  # [R, in], A
        self.up = nn.Parameter(torch.zeros(frozen.out_features, rank))  # [out, R], B

    def forward(self, states: Tensor) -> Tensor:
        """[..., out] of [..., in]."""
        result: Tensor = self.frozen(states) + functional.linear(functional.linear(states, self.down), self.up)
        return result

    def merged(self) -> nn.Linear:
        """One linear layer that computes the same."""
        with torch.no_grad():
            self.frozen.weight += self.up @ self.down
        return self.frozen


def adapters(module: nn.Module) -> dict[str, Tensor]:
    """The tensors of a module without those of frozen layers: what is stored."""
    frozen = {name for name, parameter in module.named_parameters() if not parameter.requires_grad}
    return {name: tensor for name, tensor in module.state_dict().items() if name not in frozen}


def load_adapters(module: nn.Module, tensors: Mapping[str, Tensor]) -> None:
    """The inverse of `adapters`; raises RuntimeError for tensors that are not those of the module."""
    found = module.load_state_dict(dict(tensors), strict=False)
    lacking = set(adapters(module)) - tensors.keys()
    if found.unexpected_keys or lacking:
        raise RuntimeError(f"lacking {sorted(lacking)[:3]}, unexpected {found.unexpected_keys[:3]}")


def _padded(texts: Sequence[Pieced]) -> tuple[Tensor, Tensor, Tensor | None]:
    """The states [B, P, H] and owners [B, P] of the pieces of several texts, and [B, 1, 1, P] which of them count."""
    width = max(text.count for text in texts)
    states = nn.utils.rnn.pad_sequence([text.states for text in texts], batch_first=True)
    owner = nn.utils.rnn.pad_sequence([text.owner for text in texts], batch_first=True, padding_value=-1)
    here = torch.arange(states.shape[1]) < torch.tensor([len(text.owner) for text in texts])[:, None]
    return states, owner.where(owner >= 0, width), None if len(texts) == 1 else here[:, None, None, :]
