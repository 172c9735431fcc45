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

    @property
    def unknowns(self) -> int:
        """Number of unknowns, n."""
        return len(self.first_choice) - 1

    @property
    def arrays(self) -> tuple[NDArray[np.int32], Vector, NDArray[np.int32], NDArray[np.int32], Vector]:
        """What the kernels read, in their order."""
        return self.first_choice, self.constant, self.first_outcome, self.successor, self.probability

    @property
    def roundoff(self) -> float:
        """The relative error that one evaluation of a choice may make in floating point."""
        longest = int(np.diff(self.first_outcome).max(initial=0))
        return (longest + self.settled + 8) * 2.0**-53

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
    chosen: NDArray[np.integer],
    *,
    unknown: NDArray[np.int32],
    known: Vector,
    owner: NDArray[np.int32],
    cost: float | Vector,
) -> tuple[Choices, NDArray[np.int32]]:
    """The product's choices `chosen` as a numeric problem, and the product's choice that each of its choices is.

    `unknown` ([n + 2]) numbers the unknown of each node and column, -1 where `known` ([n + 2]) gives its
    value instead; several nodes may share one unknown. `owner` is the unknown that each of `chosen` belongs
    to; `cost`, one or one for each of `chosen`, is added.
    """
    rows = chosen.astype(np.int32)
    if len(owner) and (np.diff(owner) < 0).any():
        order = np.argsort(owner, kind="stable")
        rows, owner = rows[order], owner[order]
        cost = cost if isinstance(cost, float) else cost[order]
    outcome = spans(product.first_outcome, rows)
    row = np.repeat(np.arange(len(rows), dtype=np.int32), np.diff(product.first_outcome)[rows])
    node = product.successor[outcome]
    probability = product.probability[outcome]
    successor = unknown[node]
    open_ = successor >= 0
    settled = ~open_
    share = probability[settled] * known[node[settled]]
    constant: Vector = cost + np.bincount(row[settled], weights=share, minlength=len(rows)).astype(np.float64)
    problem = Choices(
        first_choice=offsets(np.bincount(owner)),
        constant=constant,
        first_outcome=offsets(np.bincount(row[open_], minlength=len(rows))),
        successor=successor[open_],
        probability=probability[open_],
        settled=int(np.bincount(row[settled]).max(initial=0)),
    )
    return problem, rows
