"""The one numeric kernel: an optimality operator over sparse choices, as torch tensors on a CPU or a CUDA
device.

The choices of all unknowns are one CSR matrix, so a sweep is one sparse product and a few maxima. Its rows
are ordered by jagged diagonals: unknowns with most choices first, then the first choice of every unknown, the
second choice of every unknown that has two, and so on. The j-th choices are then a contiguous run of rows
that lines up with the first unknowns, and the maximum over choices needs no index.
"""

from __future__ import annotations

import os
import warnings
from collections.abc import Iterator
from contextlib import contextmanager

import numpy as np
import torch
from numpy.typing import NDArray

from models.planning.choices import Choices, Vector
from models.planning.errors import DeviceUnavailableError
from models.planning.options import Device
from models.planning.ragged import offsets, spans

THREADS_FROM = 4_000_000
"""Outcomes from which a sweep is spread over all cores. A sweep waits for memory more than for arithmetic: two cores
gain a fifth when they are idle, and lose half when they are not, since every operation waits for the slower one."""

DEVICE_FROM = 1_000_000
"""Outcomes from which device "auto" moves to a CUDA device."""


class Bellman:
    """x ↦ the best over each unknown's choices of their value; vectors of this class are in its own order."""

    def __init__(self, choices: Choices, *, maximise: bool, device: Device = "cpu") -> None:
        self.choices = choices
        self.outcomes = len(choices.successor)
        self.device = _device(device, self.outcomes)
        self._best = torch.maximum if maximise else torch.minimum
        self._maximise = maximise
        counts = np.bincount(choices.owner, minlength=choices.unknowns)
        order = np.argsort(-counts, kind="stable").astype(np.int32)  # unknown at each position
        self.position = np.empty_like(order)
        self.position[order] = np.arange(len(order), dtype=np.int32)
        by_owner = np.argsort(choices.owner, kind="stable").astype(np.int32)
        first = offsets(counts)
        rank = np.arange(len(by_owner), dtype=np.int32) - np.repeat(first[:-1], counts)
        lengths = np.bincount(rank)  # how many unknowns have a j-th choice
        self._runs = offsets(lengths)
        row = self._runs[rank] + self.position[choices.owner[by_owner]]
        self._choice = np.empty_like(by_owner)  # choice of each row
        self._choice[row] = by_owner
        self._matrix = self._sparse(choices)
        self._constant = self._tensor(choices.constant[self._choice])
        self._values = torch.empty(len(by_owner), dtype=torch.float64, device=self.device)
        self._slots = [self._values[int(a) : int(b)] for a, b in zip(self._runs, self._runs[1:], strict=False)]

    def _tensor(self, array: NDArray[np.generic]) -> torch.Tensor:
        return torch.from_numpy(np.ascontiguousarray(array)).to(self.device)

    def _sparse(self, choices: Choices) -> torch.Tensor:
        outcome = spans(choices.first_outcome, self._choice)
        first = offsets(np.diff(choices.first_outcome)[self._choice])
        with warnings.catch_warnings():
            warnings.filterwarnings("ignore", message=".*Sparse CSR tensor support.*")
            return torch.sparse_csr_tensor(
                self._tensor(first),  # 32-bit indices: the vendor's kernels take them without a conversion
                self._tensor(self.position[choices.successor[outcome]]),
                self._tensor(choices.probability[outcome]),
                size=(len(self._choice), choices.unknowns),
                check_invariants=False,
            )

    def vector(self, values: Vector | float) -> torch.Tensor:
        """[n] from values by unknown, or one value for all."""
        if isinstance(values, float):
            return torch.full((self.choices.unknowns,), values, dtype=torch.float64, device=self.device)
        ordered = np.empty_like(values)
        ordered[self.position] = values
        return self._tensor(ordered)

    def numpy(self, x: torch.Tensor) -> Vector:
        """[n] values by unknown."""
        values: Vector = x.cpu().numpy()[self.position]
        return values

    def sweep(self, x: torch.Tensor, out: torch.Tensor) -> None:
        """One application, from `x` into `out`."""
        torch.addmv(self._constant, self._matrix, x, out=self._values)
        out.copy_(self._slots[0])
        for slot in self._slots[1:]:
            head = out[: len(slot)]
            self._best(head, slot, out=head)

    def greedy(self, x: torch.Tensor, tie: float) -> tuple[NDArray[np.int32], float]:
        """[n] by unknown, the first choice whose value is best up to `tie` · max(1, |best|).

        Also how far the value of a choice taken exceeds `x`, at most.
        """
        best = torch.empty_like(x)
        self.sweep(x, best)
        slack = tie * torch.clamp(best.abs(), min=1.0)
        limit = best - slack if self._maximise else best + slack
        rank = torch.zeros(len(best), dtype=torch.int64, device=self.device)
        for number in reversed(range(len(self._slots))):
            slot = self._slots[number]
            length = len(slot)
            good = slot >= limit[:length] if self._maximise else slot <= limit[:length]
            rank[:length][good] = number
        row = self._runs[rank.cpu().numpy()] + np.arange(len(best))
        rise = float((self._values[self._tensor(row)] - x).max())
        return self._choice[row][self.position], rise


def _device(device: Device, outcomes: int) -> torch.device:
    available = torch.cuda.is_available()
    if device == "cuda" and not available:
        raise DeviceUnavailableError("there is no CUDA device on this machine")
    wanted = device == "cuda" or (device == "auto" and available and outcomes >= DEVICE_FROM)
    return torch.device("cuda" if wanted else "cpu")


@contextmanager
def threads(outcomes: int) -> Iterator[None]:
    """Sweep small models on one thread and large ones on every core this process may use."""
    before = torch.get_num_threads()
    cores = len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else os.cpu_count() or 1
    wanted = cores if outcomes >= THREADS_FROM else 1
    if wanted == before:
        yield
        return
    torch.set_num_threads(wanted)
    try:
        yield
    finally:
        torch.set_num_threads(before)
