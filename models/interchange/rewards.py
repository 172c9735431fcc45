"""What is exported to be minimised: steps, and costs where some action does not cost 1."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

import numpy as np
from numpy.typing import NDArray

from models.world.oomdp import OomdpWorld

STEPS, COSTS = "steps", "costs"
"""Reward structures: 1 for each action, letting a step pass included, and what it costs."""


def costs_of_actions(world: OomdpWorld) -> NDArray[np.float64]:
    """[actions] what each costs, which is the same in every state."""
    somewhere = np.zeros(1, dtype=np.int64)
    return np.array([float(world.cost(action, somewhere)[0]) for action in range(len(world.actions))])


def reward_lines(costs: Sequence[str]) -> Iterator[str]:
    """Both structures in the PRISM language; the second only with items."""
    for name, items in ((STEPS, ["true : 1"]), (COSTS, costs)):
        if items:
            yield ""
            yield f'rewards "{name}"'
            yield from (f"  {item};" for item in items)
            yield "endrewards"
