"""What a trained network of `models.language.spans.network` says of texts, without torch: as its `forward` and its
`emissions`.

Shapes: B texts, S words, D encoder, H states, K task classes, L tags.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any, Self

import numpy as np
from numpy.typing import NDArray

from models.language.encoder import WordReader
from models.language.runtime import Floats, Graph, Session, Tensors
from models.language.spans.model import SpanModel

GATES = (1, 0, 2)
"""torch has the gates of a GRU in the order reset, update, new; ONNX wants update, reset, new."""


@dataclass(frozen=True, slots=True, eq=False)
class SpanScorer:
    """A network that reads."""

    model: SpanModel
    encoder: WordReader
    numbers: Mapping[str, int]  # of the words with embeddings
    _session: Session

    @classmethod
    def of(cls, model: SpanModel, words: WordReader) -> Self:
        """The network of a model, which is given the vectors of words by `words`."""
        numbers = {word: number for number, word in enumerate(model.config.words, start=1)}
        return cls(model, words, numbers, _session(model))

    def scores(self, texts: Sequence[Sequence[str]]) -> tuple[Floats, Floats]:
        """The scores [B, K + 1] of the tasks, not normalised, and the states [B, S, H] of folded words, of which the
        scores of tags are made; 0 beyond the end of a text.
        """
        tensors, lengths = self.model.tensors, np.array([len(text) for text in texts], np.int32)
        known = np.zeros((len(texts), max(lengths)), np.intp)
        for row, text in enumerate(texts):
            known[row, : len(text)] = [self.numbers.get(word, 0) for word in text]
        embedded, vectors = tensors["embedding.weight"][known], self.encoder.read(texts)
        (states,) = self._session.run(embedded=embedded, vectors=vectors, lengths=lengths)
        here = (np.arange(states.shape[1]) < lengths[:, None])[:, :, None]  # [B, S, 1]
        highest = np.where(here, states, np.float32(-1.0)).max(axis=1)  # [B, H]; a GRU's states lie between -1 and 1
        mean = states.sum(axis=1) / lengths[:, None].astype(np.float32)  # [B, H]
        read = np.concatenate([highest, mean], axis=1)
        return read @ tensors["task.weight"].T + tensors["task.bias"], states

    def emissions(self, states: Floats, tasks: Sequence[int], tags: int) -> NDArray[np.float64]:
        """[N, S, tags] the scores of the first tags of a text's words, whose states are [S, H], under N of the
        tasks.
        """
        config, tensors = self.model.config, self.model.tensors
        weight = tensors["tag.weight"].reshape(len(config.tasks), config.tags, -1)[tasks, :tags]  # [N, tags, H]
        bias = tensors["tag.bias"].reshape(len(config.tasks), config.tags)[tasks, :tags]  # [N, tags]
        found: NDArray[np.float64] = (states @ weight.transpose(0, 2, 1) + bias[:, None]).astype(np.float64)
        return found


def _session(model: SpanModel) -> Session:
    """The states [B, S, H] of words with embeddings [B, S, E] and vectors [B, S, D] in texts of lengths [B]."""
    tensors, graph = model.tensors, Graph()
    meant = graph.node("Tanh", graph.linear("vectors", tensors["projection.weight"], tensors["projection.bias"]))
    read = graph.node("Concat", "embedded", meant, axis=2)
    read = graph.node("Transpose", read, perm=(1, 0, 2))  # words come first in a GRU
    for layer in range(model.config.layers):
        read = _gru(graph, tensors, layer, read, model.config.encoder)
    states = graph.node("Transpose", read, perm=(1, 0, 2))
    return graph.session({"embedded": (np.float32, 3), "vectors": (np.float32, 3), "lengths": (np.int32, 1)}, [states])


def _gru(graph: Graph, tensors: Tensors, layer: int, given: str, size: int) -> str:
    """[S, B, H] a layer in both directions over [S, B, given]."""

    def both(kind: str) -> Floats:
        names = (f"encoder.{kind}_l{layer}{direction}" for direction in ("", "_reverse"))
        return np.stack([_reordered(tensors[name], size) for name in names])

    weights = [graph.weight(both(kind)) for kind in ("weight_ih", "weight_hh")]
    biases = graph.weight(np.concatenate([both("bias_ih"), both("bias_hh")], axis=1))
    form: dict[str, Any] = {"hidden_size": size, "direction": "bidirectional", "linear_before_reset": 1}
    states = graph.node("GRU", given, *weights, biases, "lengths", **form)  # [S, 2, B, size]
    states = graph.node("Transpose", states, perm=(0, 2, 1, 3))
    return graph.node("Reshape", states, graph.weight(np.array([0, 0, -1], np.int64)))


def _reordered(stacked: Floats, size: int) -> Floats:
    """Three gates of so many rows in the order of ONNX."""
    return np.concatenate([stacked[gate * size : (gate + 1) * size] for gate in GATES])
