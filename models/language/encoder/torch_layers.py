"""Layers of BERT as torch's: to train networks on a GPU, or to train the layers themselves."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from typing import TypeVar

import numpy as np
import torch
from numpy.typing import NDArray
from torch import Tensor, nn
from torch.nn import functional

from models.language.encoder.layers import ATTENTION, EPSILON, HEADS, Build, Layers, joined, layer_name
from models.language.runtime import Floats, Tensors

L = TypeVar("L", bound=nn.Module)


def on(device: str) -> Build:
    """What builds layers that run on a device."""

    def build(tensors: Tensors, numbers: Iterable[int]) -> Layers:
        layers = [Layer(tensors, layer_name(number)).to(device) for number in numbers]

        @torch.inference_mode()
        def run(states: Floats, here: NDArray[np.int32]) -> Sequence[Floats]:
            given, mask = torch.from_numpy(states).to(device), torch.from_numpy(here).to(device).bool()
            after: list[Tensor] = []
            for layer in layers:
                given = layer(given, mask[:, None, None, :])
                after.append(given)
            return [states.cpu().numpy() for states in after]

        return run

    return build


class Layer(nn.Module):
    """One layer; the same computation as `models.language.encoder.layers.build` lays out."""

    def __init__(self, tensors: Tensors, name: str) -> None:
        super().__init__()
        self.attend = _linear(*joined(tensors, name))
        self.attended = _linear(*_named(tensors, f"{name}.attention.output.dense"))
        self.attended_norm = _norm(*_named(tensors, f"{name}.attention.output.LayerNorm"))
        self.widen = _linear(*_named(tensors, f"{name}.intermediate.dense"))
        self.narrow = _linear(*_named(tensors, f"{name}.output.dense"))
        self.narrow_norm = _norm(*_named(tensors, f"{name}.output.LayerNorm"))

    def forward(self, states: Tensor, mask: Tensor) -> Tensor:
        """[B, P, H]; `mask` [B, 1, 1, P] says which pieces count."""
        parts = self.attend(states).unflatten(2, (3, HEADS, -1)).permute(2, 0, 3, 1, 4)  # [3, B, heads, P, H / heads]
        heads = functional.scaled_dot_product_attention(parts[0], parts[1], parts[2], attn_mask=mask)
        states = self.attended_norm(states + self.attended(heads.transpose(1, 2).flatten(2)))
        result: Tensor = self.narrow_norm(states + self.narrow(functional.gelu(self.widen(states))))
        return result

    def tensors(self, name: str) -> Tensors:
        """What the layer is made of, named as MiniLM's: the inverse of making it."""
        found: dict[str, Tensor] = {}
        for kind, whole in (("weight", self.attend.weight), ("bias", self.attend.bias)):
            found |= {f"attention.self.{p}.{kind}": t for p, t in zip(ATTENTION, whole.chunk(3), strict=True)}
        parts: dict[str, nn.Linear | nn.LayerNorm] = {
            "attention.output.dense": self.attended,
            "attention.output.LayerNorm": self.attended_norm,
            "intermediate.dense": self.widen,
            "output.dense": self.narrow,
            "output.LayerNorm": self.narrow_norm,
        }
        for part, layer in parts.items():
            found |= {f"{part}.weight": layer.weight, f"{part}.bias": layer.bias}
        return {f"{name}.{part}": tensor.detach().cpu().numpy().copy() for part, tensor in found.items()}


def _named(tensors: Tensors, name: str) -> tuple[Floats, Floats]:
    return tensors[f"{name}.weight"], tensors[f"{name}.bias"]


def _linear(weight: Floats, bias: Floats) -> nn.Linear:
    return _filled(nn.Linear(weight.shape[1], weight.shape[0]), weight, bias)


def _norm(weight: Floats, bias: Floats) -> nn.LayerNorm:
    return _filled(nn.LayerNorm(len(weight), eps=EPSILON), weight, bias)


def _filled(layer: L, weight: Floats, bias: Floats) -> L:
    layer.load_state_dict({"weight": torch.from_numpy(weight), "bias": torch.from_numpy(bias)})
    return layer
