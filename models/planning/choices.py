"""The numeric problem of one stage: choices of some unknowns, everything else being known."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from models.planning.product import Product
from models.planning.ragged import offsets, spans

Vector = NDArray[np.float64]


@dataclass(frozen=True, slots=True, eq=False)
class Choices:
    """Choices of `unknowns` unknowns: value of choice c = constant[c] + Σ probability · x[successor].

    An unknown's choices are ranked by their position here. Outcomes whose value is known are in `constant`
    already.
    """

    unknowns: int
    owner: NDArray[np.int32]  # [c]  every unknown has at least one choice
    constant: Vector  # [c]
    first_outcome: NDArray[np.int32]  # [c + 1]
    successor: NDArray[np.int32]  # [e]
    probability: Vector  # [e]

    @property
    def roundoff(self) -> float:
        """The relative error that one evaluation of a choice may make in floating point."""
        longest = int(np.diff(self.first_outcome).max(initial=0))
        return (longest + 8) * 2.0**-53

    def restricted(self, chosen: NDArray[np.integer]) -> Choices:
        """Only the choices `chosen`, one or more for each unknown."""
        rows = chosen.astype(np.int32)
        outcome = spans(self.first_outcome, rows)
        return Choices(
            unknowns=self.unknowns,
            owner=self.owner[rows],
            constant=self.constant[rows],
            first_outcome=offsets(np.diff(self.first_outcome)[rows]),
            successor=self.successor[outcome],
            probability=self.probability[outcome],
        )


def gather(
    product: Product,
    chosen: NDArray[np.integer],
    *,
    unknown: NDArray[np.int32],
    known: Vector,
    owner: NDArray[np.int32],
    cost: float,
) -> Choices:
    """The product's choices `chosen` as a numeric problem.

    `unknown` ([n + 2]) numbers the unknown of each node and column, -1 where `known` ([n + 2]) gives its
    value instead; several nodes may share one unknown. `owner` is the unknown that each of `chosen` belongs
    to; `cost` is added to every choice.
    """
    rows = chosen.astype(np.int32)
    outcome = spans(product.first_outcome, rows)
    row = np.repeat(np.arange(len(rows), dtype=np.int32), np.diff(product.first_outcome)[rows])
    node = product.successor[outcome]
    probability = product.probability[outcome]
    successor = unknown[node]
    open_ = successor >= 0
    settled = ~open_
    share = probability[settled] * known[node[settled]]
    constant: Vector = cost + np.bincount(row[settled], weights=share, minlength=len(rows)).astype(np.float64)
    return Choices(
        unknowns=int(owner.max(initial=-1)) + 1,
        owner=owner,
        constant=constant,
        first_outcome=offsets(np.bincount(row[open_], minlength=len(rows))),
        successor=successor[open_],
        probability=probability[open_],
    )
