"""Layers of BERT (Devlin et al. 2019), as ONNX Runtime runs them.

Shapes: B texts, P pieces, H hidden numbers.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from typing import Protocol

import numpy as np
from numpy.typing import NDArray

from models.language.runtime import CONTRIBUTED, Floats, Graph, Tensors

HEADS, WIDER = 12, 4
"""Parts that attention is split into, and how many times wider the feed-forward network is than what it is given."""
ATTENTION = ("query", "key", "value")
EPSILON = 1e-12
"""What layer normalisation adds to a variance."""


class Layers(Protocol):
    """Some layers, one after the other."""

    def __call__(self, states: Floats, here: NDArray[np.int32]) -> Sequence[Floats]:
        """[B, P, H] after each layer, of states [B, P, H], of which those count that are `here` [B, P]."""


class Build(Protocol):
    """What makes layers of the tensors of a model."""

    def __call__(self, tensors: Tensors, numbers: Iterable[int]) -> Layers:
        """Those of these numbers; raises KeyError for a tensor that is missing."""


def build(tensors: Tensors, numbers: Iterable[int]) -> Layers:
    """See `Build`."""
    graph = Graph()
    states, after = "states", []
    for number in numbers:
        states = _layer(graph, tensors, layer_name(number), states)
        after.append(states)
    session = graph.session({"states": (np.float32, 3), "here": (np.int32, 2)}, after)
    return lambda states, here: session.run(states=states, here=here)


def layer_name(number: int) -> str:
    """What the names of the tensors of a layer begin with."""
    return f"encoder.layer.{number}"


def layer_shapes(number: int, hidden: int) -> dict[str, tuple[int, ...]]:
    """The shapes of the tensors of a layer, by name."""
    name, wide = layer_name(number), WIDER * hidden
    linear = {
        **{f"attention.self.{part}": (hidden, hidden) for part in ATTENTION},
        "attention.output.dense": (hidden, hidden),
        "intermediate.dense": (wide, hidden),
        "output.dense": (hidden, wide),
    }
    shapes: dict[str, tuple[int, ...]] = {f"{name}.{part}.weight": shape for part, shape in linear.items()}
    shapes |= {f"{name}.{part}.bias": shape[:1] for part, shape in linear.items()}
    norms = [f"{name}.{part}.LayerNorm" for part in ("attention.output", "output")]
    return shapes | {f"{norm}.{kind}": (hidden,) for norm in norms for kind in ("weight", "bias")}


def joined(tensors: Tensors, name: str) -> tuple[Floats, Floats]:
    """The weight [3 H, H] and the bias [3 H] of queries, keys and values side by side."""
    parts = [f"{name}.attention.self.{part}" for part in ATTENTION]
    weight, bias = (np.concatenate([tensors[f"{part}.{kind}"] for part in parts]) for kind in ("weight", "bias"))
    return weight, bias


def _layer(graph: Graph, tensors: Tensors, name: str, states: str) -> str:
    """Attention and a feed-forward network; the bias of each comes with what is done next."""

    def product(given: str, part: str) -> tuple[str, str]:
        weight, bias = (tensors[f"{name}.{part}.{kind}"] for kind in ("weight", "bias"))
        return graph.node("MatMul", given, graph.weight(weight.T)), graph.weight(bias)

    def added(given: tuple[str, str], to: str, part: str) -> str:
        norm = [graph.weight(tensors[f"{name}.{part}.LayerNorm.{kind}"]) for kind in ("weight", "bias")]
        value, bias = given
        fused = "SkipLayerNormalization"
        return graph.node(fused, value, to, *norm, bias, domain=CONTRIBUTED, epsilon=EPSILON)

    weight, bias = joined(tensors, name)
    parts = (graph.weight(weight.T), graph.weight(bias))
    heads = graph.node("Attention", states, *parts, "here", domain=CONTRIBUTED, num_heads=HEADS)
    attended = added(product(heads, "attention.output.dense"), states, "attention.output")
    wide = graph.node("BiasGelu", *product(attended, "intermediate.dense"), domain=CONTRIBUTED)
    return added(product(wide, "output.dense"), attended, "output")
