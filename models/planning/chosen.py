"""The whole policy on the whole product: the way to where the outcome is decided, and what is done for ever there."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Self

import numpy as np
from numpy.typing import NDArray

from models.planning.policy import NOTHING, WAIT
from models.planning.product import Product
from models.planning.ragged import distinct, spans
from models.planning.recurrence import Recurrence


@dataclass(frozen=True, slots=True, eq=False)
class Chosen:
    """A choice of every node of `whole`; `product` is `whole` with the nodes of `inside` contracted."""

    whole: Product
    product: Product
    choice: NDArray[np.int32]  # [n]  of `whole`; -1 where the formula cannot be satisfied
    inside: NDArray[np.bool_]  # [n + 2]  the formula holds if the policy goes on for ever

    @classmethod
    def of(cls, whole: Product, product: Product, way: NDArray[np.int32], recurrence: Recurrence) -> Self:
        """`way` is the choice of each node of `product`, -1 for none."""
        choice = recurrence.chosen.copy()
        outside = np.flatnonzero(~recurrence.inside[:-2])
        # A node keeps its choices and their order when others are contracted.
        choice[outside] = np.where(way < 0, -1, whole.first_choice[outside] + way - product.first_choice[:-1])
        return cls(whole, product, choice, recurrence.inside)

    def actions(self) -> NDArray[np.int32]:
        """[n + 2] index into the world's actions, NOTHING or WAIT."""
        action = np.full(self.whole.nodes + 2, NOTHING, dtype=np.int32)
        acting = np.flatnonzero(self.choice >= 0)
        taken = self.whole.action[self.choice[acting]]
        action[acting] = np.where(taken < 0, WAIT, taken)
        return action

    def rounds(self, start: int, recurrence: Recurrence) -> tuple[float, float] | None:
        """Bounds of the expected steps of a round, over the components that the policy may come to from `start`."""
        if not len(recurrence.least):
            return None
        component = recurrence.component[self.reachable(start)]
        met = np.unique(component[component >= 0])
        if not len(met):
            return None
        return float(recurrence.least[met].min()), float(recurrence.most[met].max())

    def reachable(self, start: int) -> NDArray[np.int32]:
        """The nodes that the policy may be in, from the node or column `start` on."""
        product = self.whole
        unseen = np.append(self.choice >= 0, [False, False])
        scratch = np.empty(product.nodes + 2, dtype=np.int32)
        frontier = np.array([start], dtype=np.int32)[unseen[[start]]]
        unseen[frontier] = False
        found = [frontier]
        while len(frontier):
            entered = product.successor[spans(product.first_outcome, self.choice[frontier])]
            frontier = distinct(entered[unseen[entered]], scratch)
            unseen[frontier] = False
            found.append(frontier)
        return np.concatenate(found)
