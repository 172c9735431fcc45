"""Policy iteration with sparse direct solves, for small systems in which iteration creeps.

A chain that leaves a state once in a million steps needs millions of sweeps but one linear solve. What comes
out is only a proposal: `probability_bounds` turns it into bounds that hold whatever the solver did, by
checking inequalities.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray
from scipy import sparse
from scipy.sparse.linalg import splu

from models.planning.choices import Choices, Vector
from models.planning.ragged import owners

DIRECT_LIMIT = 2_000
"""Unknowns up to which a system may be factorised: dense in the worst case, 32 MB and about a second."""

ROUNDS = 500
"""Most improvements of a policy before the proposal is given up."""

STRICT = 1e-12
"""A choice replaces another only if it is better by this much, relatively: swapping ties would never end."""


@dataclass(frozen=True, slots=True, eq=False)
class Proposal:
    """A policy and the (approximate) solution of its linear system."""

    value: Vector  # [n]
    chosen: NDArray[np.int32]  # [n]  choice of each unknown


class Improver:
    """Howard's policy iteration over one set of choices; every policy it meets must leave the unknowns for
    sure.
    """

    def __init__(self, choices: Choices, *, maximise: bool) -> None:
        shape = (len(choices.constant), choices.unknowns)
        entries = (choices.probability, choices.successor, choices.first_outcome)
        self.choices = choices
        self._matrix = sparse.csr_array(entries, shape=shape)
        self._first = choices.first_choice
        self._sign = 1.0 if maximise else -1.0

    def evaluate(self, chosen: NDArray[np.int32]) -> Vector | None:
        """The values of one policy, or None if its system is singular to working precision."""
        system = sparse.eye_array(self.choices.unknowns, format="csc") - self._matrix[chosen].tocsc()
        try:
            value: Vector = splu(system).solve(self.choices.constant[chosen])
        except RuntimeError:
            return None
        return value if np.isfinite(value).all() else None

    def values(self, value: Vector) -> Vector:
        """[c] what each choice is worth."""
        result: Vector = self.choices.constant + self._matrix @ value
        return result

    def best(self, worth: Vector) -> tuple[Vector, NDArray[np.int32]]:
        """For each unknown the best of `worth` and the first choice that has it."""
        ordered = self._sign * worth
        top = np.maximum.reduceat(ordered, self._first[:-1])
        hits = np.flatnonzero(ordered == np.repeat(top, np.diff(self._first)))
        first = np.unique(owners(self._first)[hits], return_index=True)[1]
        return self._sign * top, hits[first].astype(np.int32)

    def improve(self, chosen: NDArray[np.int32], alive: Callable[[], None]) -> Proposal | None:
        """Improve a policy until no choice is strictly better; `alive` is called in every round."""
        for _ in range(ROUNDS):
            alive()
            value = self.evaluate(chosen)
            if value is None:
                return None
            top, candidate = self.best(self.values(value))
            better = self._sign * (top - value) > STRICT * np.maximum(1.0, np.abs(value))
            if not better.any():
                return Proposal(value, chosen)
            chosen = np.where(better, candidate, chosen)
        return None


def probability_bounds(
    choices: Choices, chosen: NDArray[np.int32], alive: Callable[[], None] = lambda: None
) -> tuple[Vector, Vector] | None:
    """Lower and upper bounds of the maximal values, starting from any policy; None if there is no proposal.

    Every policy must leave the unknowns for sure. With W(x) >= the expected number of steps in the unknowns
    under every policy, a vector that no choice improves by more than d lies less than d·W below the optimum,
    and one that its policy's choices keep up to d lies less than d·W above it. W comes the same way: if no
    choice improves 1 + P w by r < 1, then W <= w / (1 - r), because each step costs 1.
    """
    improver = Improver(choices, maximise=True)
    proposal = improver.improve(chosen, alive)
    timer = Improver(replace(choices, constant=np.ones(len(choices.constant))), maximise=True)
    time = None if proposal is None else timer.improve(proposal.chosen, alive)
    if proposal is None or time is None:
        return None
    excess = float((timer.best(timer.values(time.value))[0] - time.value).max())
    excess = max(excess, 0.0) + choices.roundoff * float(time.value.max())
    if excess >= 0.5:
        return None
    longest = time.value / (1.0 - excess)
    worth = improver.values(proposal.value)
    short = float((proposal.value - worth[proposal.chosen]).max())
    over = float((improver.best(worth)[0] - proposal.value).max())
    below = (max(short, 0.0) + choices.roundoff) * longest
    above = (max(over, 0.0) + choices.roundoff) * longest
    return np.clip(proposal.value - below, 0.0, 1.0), np.clip(proposal.value + above, 0.0, 1.0)
