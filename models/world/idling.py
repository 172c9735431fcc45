"""What a world can do, seen from a part of it: all that the part does, or anything that the part does not see.

A step of the whole world either does in the part what an action of the part does there, or leaves it as it is. A part
in which every state can also be kept for a step therefore simulates the whole world step by step. With that step at
the least cost of any that it stands for, no policy of the whole world is more probable to satisfy a formula of LTL, `X`
or not, or needs fewer steps for it at the same probability, than the best one here (simulation of MDPs by a larger
one: Segala and Lynch, "Probabilistic simulations for probabilistic processes", 1995).
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from models.logic.formula import Atom
from models.world.factors import Factored, FactoredAction
from models.world.projection import ProjectedWorld
from models.world.transitions import Transitions
from models.world.world import Outcomes, State, Variable

IDLE = "idle"
"""The name of the step that keeps a state; the last of the actions."""


class IdlingWorld:
    """See `World`: a part of a world in which it is always possible to stay for a step too."""

    listed: Transitions | None = None

    def __init__(self, part: ProjectedWorld) -> None:
        self.part = part
        self.name, self.size, self.initial = part.name, part.size, part.initial
        self.variables: tuple[Variable, ...] = part.variables
        self.actions: tuple[str, ...] = (*part.actions, IDLE)
        self._idle = len(part.actions)
        self._cost = part.least_beside

    @property
    def factored(self) -> Factored:
        """The dynamics as small tables."""
        nothing = np.zeros((1, 1), dtype=np.int64)
        idle = FactoredAction(self._idle, (), (), np.ones((1, 1)), nothing, frozenset(), self._cost)
        return replace(self.part.factored, actions=(*self.part.factored.actions, idle))

    def valid(self, states: NDArray[np.int64] | None = None) -> NDArray[np.bool_]:
        """See `World.valid`."""
        return self.part.valid(states)

    def encode(self, state: State, *, base: int | None = None) -> int:
        """See `World.encode`."""
        return self.part.encode(state, base=base)

    def decode(self, index: int) -> dict[str, dict[str, str]]:
        """See `World.decode`."""
        return self.part.decode(index)

    def labels(self, atoms: Sequence[Atom], states: NDArray[np.int64] | None = None) -> NDArray[np.bool_]:
        """See `World.labels`."""
        return self.part.labels(atoms, states)

    def outcomes(self, action: int, states: NDArray[np.int64] | None = None) -> Outcomes:
        """See `World.outcomes`."""
        if action != self._idle:
            return self.part.outcomes(action, states)
        here = np.arange(self.size, dtype=np.int64) if states is None else states
        return Outcomes(np.ones(len(here), dtype=np.bool_), np.ones((1, len(here))), here[np.newaxis])

    def cost(self, action: int, states: NDArray[np.int64] | None = None) -> NDArray[np.float64]:
        """See `World.cost`."""
        if action != self._idle:
            return self.part.cost(action, states)
        return np.full(self.size if states is None else len(states), self._cost)
