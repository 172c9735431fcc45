"""The optimality operator as torch tensors, on a CPU or a CUDA device through the same code.

The choices of all unknowns are one CSR matrix, so a sweep is one sparse product and a few maxima. Its rows
are ordered by jagged diagonals: unknowns with most choices first, then the first choice of every unknown, the
second choice of every unknown that has two, and so on. The j-th choices are then a contiguous run of rows
that lines up with the first unknowns, and the maximum over choices needs no index.
"""

from __future__ import annotations

import warnings

import numpy as np
import torch
from numpy.typing import NDArray

from models.planning.choices import Choices, Vector
from models.planning.ragged import offsets, owners, spans


class TensorOperator:
    """See `models.planning.operator.Operator`; vectors are in an order of their own."""

    def __init__(self, choices: Choices, device: torch.device) -> None:
        self.choices = choices
        self.device = device
        counts = np.diff(choices.first_choice)
        order = np.argsort(-counts, kind="stable").astype(np.int32)  # unknown at each position
        self.position = np.empty_like(order)
        self.position[order] = np.arange(len(order), dtype=np.int32)
        owner = owners(choices.first_choice)
        rank = np.arange(len(owner), dtype=np.int32) - np.repeat(choices.first_choice[:-1], counts)
        self._runs = offsets(np.bincount(rank))  # how many unknowns have a j-th choice
        row = self._runs[rank] + self.position[owner]
        self._choice = np.empty_like(owner)  # choice of each row
        self._choice[row] = np.arange(len(owner), dtype=np.int32)
        self._matrix = self._sparse(choices)
        self._constant = self._tensor(choices.constant[self._choice])
        self._values = torch.empty(len(owner), dtype=torch.float64, device=self.device)
        self._slots = [self._values[int(a) : int(b)] for a, b in zip(self._runs, self._runs[1:], strict=False)]

    def vector(self, values: Vector | float) -> torch.Tensor:
        """See `Operator.vector`."""
        if isinstance(values, float):
            return torch.full((self.choices.unknowns,), values, dtype=torch.float64, device=self.device)
        ordered = np.empty_like(values)
        ordered[self.position] = values
        return self._tensor(ordered)

    def numpy(self, x: torch.Tensor) -> Vector:
        """See `Operator.numpy`."""
        values: Vector = x.cpu().numpy()[self.position]
        return values

    def at(self, x: torch.Tensor, unknown: int) -> float:
        """See `Operator.at`."""
        return float(x[int(self.position[unknown])])

    def narrow(self, lower: torch.Tensor, upper: torch.Tensor, sweep: int) -> float:  # noqa: ARG002  # all at once, in no order
        """See `Operator.narrow`."""
        margin = self.choices.roundoff
        torch.maximum(lower, self._apply(lower, maximise=True).mul_(1.0 - margin), out=lower)
        torch.minimum(upper, self._apply(upper, maximise=True).mul_(1.0 + margin), out=upper)
        return float((upper - lower).max())

    def ascend(self, lower: torch.Tensor) -> float:
        """See `Operator.ascend`; with no further passes."""
        out = self._apply(lower, maximise=True).mul_(1.0 - self.choices.roundoff)
        rise = float((out - lower).max())
        torch.maximum(lower, out, out=lower)
        return max(rise, 0.0)

    def cover(self, upper: torch.Tensor) -> float:
        """See `Operator.cover`."""
        out = self._apply(upper, maximise=True).mul_(1.0 + self.choices.roundoff)
        growth = float((out - upper).max())
        upper.copy_(out)
        return max(growth, 0.0)

    def improve(self, x: torch.Tensor) -> float:
        """See `Operator.improve`; with no further passes."""
        out = self._apply(x, maximise=False)
        change = float((out - x).abs().max())
        x.copy_(out)
        return change

    def settle(self, x: torch.Tensor, sweep: int) -> float:  # noqa: ARG002  # all at once, in no order
        """See `Operator.settle`."""
        out = self._apply(x, maximise=True)
        change = float((out - x).abs().max())
        x.copy_(out)
        return change

    def greedy(
        self, x: torch.Tensor, *, maximise: bool, tie: float, least: float = 1.0
    ) -> tuple[NDArray[np.int32], float, float]:
        """See `Operator.greedy`."""
        best = self._apply(x, maximise=maximise)
        slack = tie * torch.clamp(best.abs(), min=least)
        limit = best - slack if maximise else best + slack
        rank = torch.zeros(len(best), dtype=torch.int64, device=self.device)
        for number in reversed(range(len(self._slots))):
            slot = self._slots[number]
            length = len(slot)
            good = slot >= limit[:length] if maximise else slot <= limit[:length]
            rank[:length][good] = number
        row = self._runs[rank.cpu().numpy()] + np.arange(len(best))
        excess = self._values[self._tensor(row)] - x
        short = x - best
        return self._choice[row][self.position], float(excess.max()), float(short.max())

    def _apply(self, x: torch.Tensor, *, maximise: bool) -> torch.Tensor:
        """The best over each unknown's choices of their value."""
        best = torch.maximum if maximise else torch.minimum
        torch.addmv(self._constant, self._matrix, x, out=self._values)
        out = self._slots[0].clone()
        for slot in self._slots[1:]:
            head = out[: len(slot)]
            best(head, slot, out=head)
        return out

    def _tensor(self, array: NDArray[np.generic]) -> torch.Tensor:
        return torch.from_numpy(np.ascontiguousarray(array)).to(self.device)

    def _sparse(self, choices: Choices) -> torch.Tensor:
        outcome = spans(choices.first_outcome, self._choice)
        first = offsets(np.diff(choices.first_outcome)[self._choice])
        unchecked = torch.sparse.check_sparse_tensor_invariants(False)  # type: ignore[no-untyped-call]  # CUDA asks for it
        with warnings.catch_warnings(), unchecked:
            warnings.filterwarnings("ignore", message=".*Sparse CSR tensor support.*")
            return torch.sparse_csr_tensor(
                self._tensor(first),  # 32-bit indices: the vendor's kernels take them without a conversion
                self._tensor(self.position[choices.successor[outcome]]),
                self._tensor(choices.probability[outcome]),
                size=(len(self._choice), choices.unknowns),
            )
