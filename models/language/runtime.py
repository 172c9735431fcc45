"""Trained networks as ONNX Runtime runs them, on one thread.

torch trains, ONNX Runtime translates: its layers are laid out once for the processor, a call costs little, which counts
for a text of a dozen words, and it is loaded in no time. What only translates does not load torch at all.
`python -m benchmarks.translate` and `python -m benchmarks.startup` measure both.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any

import numpy as np
import onnxruntime
from numpy.typing import NDArray
from onnx import NodeProto, TensorProto, helper, numpy_helper

OPSET, CONTRIBUTED_OPSET, IR_VERSION = 17, 1, 9
"""Versions of the operators, of those that ONNX Runtime adds, and of the format."""
CONTRIBUTED = "com.microsoft"
"""The domain of the operators that ONNX Runtime adds: layers of transformers as one operator each."""
ERRORS = 3
"""The least severe messages that ONNX Runtime writes to stderr; its warnings are for those who write operators."""

Floats = NDArray[np.float32]
Tensors = Mapping[str, Floats]
"""The tensors of a network by name, as torch names them."""


@dataclass(frozen=True, slots=True)
class Graph:
    """A network under construction. Values are known by names, which are given in order."""

    _nodes: list[NodeProto] = field(default_factory=list)
    _weights: list[TensorProto] = field(default_factory=list)

    def weight(self, array: NDArray[Any]) -> str:
        """A value that never changes."""
        name = f"weight_{len(self._weights)}"
        self._weights.append(numpy_helper.from_array(np.ascontiguousarray(array), name))
        return name

    def node(self, operator: str, *inputs: str, domain: str = "", **attributes: Any) -> str:
        """The first output of an operator; an input that is left out is ""."""
        name = f"value_{len(self._nodes)}"
        self._nodes.append(helper.make_node(operator, inputs, [name], domain=domain, **attributes))
        return name

    def linear(self, given: str, weight: Floats, bias: Floats) -> str:
        """`given` [..., I] times `weight` [O, I] plus `bias` [O]."""
        return self.node("Add", self.node("MatMul", given, self.weight(weight.T)), self.weight(bias))

    def session(self, inputs: Mapping[str, tuple[type[np.generic], int]], outputs: Sequence[str]) -> Session:
        """What computes `outputs` from `inputs`, which have a type and a number of dimensions each."""
        given = [_described(name, kind, rank) for name, (kind, rank) in inputs.items()]
        wanted = [helper.make_empty_tensor_value_info(name) for name in outputs]
        graph = helper.make_graph(self._nodes, "network", given, wanted, self._weights)
        versions = [helper.make_opsetid("", OPSET), helper.make_opsetid(CONTRIBUTED, CONTRIBUTED_OPSET)]
        model = helper.make_model(graph, opset_imports=versions, ir_version=IR_VERSION)
        options = onnxruntime.SessionOptions()
        options.intra_op_num_threads = options.inter_op_num_threads = 1  # more make one text slower
        options.log_severity_level = ERRORS
        made = onnxruntime.InferenceSession(model.SerializeToString(), options, providers=["CPUExecutionProvider"])
        return Session(made, tuple(outputs))


@dataclass(frozen=True, slots=True, eq=False)
class Session:
    """A network that can be run, by several threads at a time."""

    _session: Any
    _outputs: tuple[str, ...]

    def run(self, **inputs: NDArray[Any]) -> list[Floats]:
        """The outputs, in their order."""
        found: list[Floats] = self._session.run(self._outputs, inputs)
        return found


def _described(name: str, kind: type[np.generic], rank: int) -> Any:
    return helper.make_tensor_value_info(name, helper.np_dtype_to_tensor_dtype(np.dtype(kind)), [None] * rank)
