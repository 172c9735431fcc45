"""Linear layers laid out once for the processor, for inference only.

`torch.nn.functional.linear` lays the weights out anew at every call, which for the few rows of one text takes longer
than the arithmetic. oneDNN can keep its own layout; on machines where torch lacks it, the layer is an ordinary one.
"""

from __future__ import annotations

import torch
from torch import Tensor, nn
from torch.nn import functional

ROWS = 16
"""Words and pieces of a usual text: the layout is chosen for as many rows. Others are as right, if less fast."""


class PackedLinear(nn.Module):
    """`weight` [O, I] and `bias` [O] applied to the last dimension of [..., I]; not `packed` it can leave the processor
    for another device.
    """

    _weight: Tensor
    _bias: Tensor

    def __init__(self, weight: Tensor, bias: Tensor, *, packed: bool = True) -> None:
        super().__init__()
        self._packs = packed and bool(torch.backends.mkldnn.is_available())  # type: ignore[no-untyped-call]
        if self._packs:
            weight = torch.ops.mkldnn._reorder_linear_weight(weight.clone(), ROWS)
        self.register_buffer("_weight", weight, persistent=False)
        self.register_buffer("_bias", bias, persistent=False)

    def forward(self, given: Tensor) -> Tensor:
        """[..., O]."""
        if not self._packs:
            return functional.linear(given, self._weight, self._bias)
        result: Tensor = torch.ops.mkldnn._linear_pointwise(given, self._weight, self._bias, "none", [], "")
        return result
