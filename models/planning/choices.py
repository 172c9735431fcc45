"""The numeric problem of one stage: choices of some unknowns, everything else being known."""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

from models.planning.kernels import layout
from models.planning.product import Product
from models.planning.ragged import offsets, spans, unsigned

Vector = NDArray[np.float64]


@dataclass(frozen=True, slots=True, eq=False)
class Choices:
    """Choices of n unknowns, sorted by unknown: value of choice c = constant[c] + Σ probability · x[successor].

    An unknown's choices are ranked by their position here. Outcomes whose value is known are in `constant`
    already.
    """

    first_choice: NDArray[np.int32]  # [n + 1]  every unknown has at least one choice
    constant: Vector  # [c]
    first_outcome: NDArray[np.int32]  # [c + 1]
    successor: NDArray[np.int32]  # [e]
    probability: Vector  # [e]
    settled: int = 0  # most outcomes of a choice that went into its constant
    roundoff: float = field(init=False)
    """The relative error that one evaluation of a choice may make in floating point."""

    def __post_init__(self) -> None:
        longest = int(np.diff(self.first_outcome).max(initial=0))
        object.__setattr__(self, "roundoff", (longest + self.settled + 8) * 2.0**-53)

    @property
    def unknowns(self) -> int:
        """Number of unknowns, n."""
        return len(self.first_choice) - 1

    @property
    def arrays(self) -> tuple[NDArray[np.uint32], Vector, NDArray[np.uint32], NDArray[np.uint32], Vector]:
        """What the kernels read, in their order."""
        first, start = unsigned(self.first_choice), unsigned(self.first_outcome)
        return first, self.constant, start, unsigned(self.successor), self.probability

    def only(self, chosen: NDArray[np.int32]) -> Choices:
        """The chain of a policy: `chosen` [n] is one choice of each unknown."""
        outcome = spans(self.first_outcome, chosen)
        return Choices(
            first_choice=np.arange(self.unknowns + 1, dtype=np.int32),
            constant=self.constant[chosen],
            first_outcome=offsets(np.diff(self.first_outcome)[chosen]),
            successor=self.successor[outcome],
            probability=self.probability[outcome],
            settled=self.settled,
        )


def gather(
    product: Product,
    kept: NDArray[np.bool_],
    *,
    unknown: NDArray[np.int32],
    known: Vector,
    cost: Vector | None = None,
) -> tuple[Choices, NDArray[np.int32]]:
    """The choices `kept` ([C]) of the nodes that are an unknown as a numeric problem, and the product's choice that
    each of its choices is.

    `unknown` ([n + 2]) numbers the unknown of each node, -1 where `known` ([n + 2]) gives the value of the node or
    column instead; several nodes may share one unknown. `cost` ([C]) is added.
    """
    first, start, entered = product.moves
    rows, first_choice = layout.sort_choices(first, kept, unknown, int(unknown.max(initial=-1)) + 1)
    constant = np.zeros(len(rows)) if cost is None else cost[rows]
    most = int((product.first_outcome[rows + 1] - product.first_outcome[rows]).sum()) + 1
    first_outcome = np.empty(len(rows) + 1, dtype=np.int32)
    successor, probability = np.empty(most, dtype=np.int32), np.empty(most)  # what is not written takes no memory
    settled = layout.gather(
        unsigned(rows), start, entered, product.probability, unknown, known,
        constant, first_outcome, successor, probability,
    )  # fmt: skip
    count = int(first_outcome[-1])
    return Choices(first_choice, constant, first_outcome, successor[:count], probability[:count], int(settled)), rows
