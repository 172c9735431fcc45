"""The deterministic automaton of a formula, as arrays."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from models.logic.formula import Atom, Formula


class Pair(NamedTuple):
    """One way to accept: no mark of `finite` is seen for ever, and that of `infinite` is; both are sets of bits.

    `infinite` has one bit at most. 0 stands for nothing to avoid, or nothing to meet.
    """

    finite: int
    infinite: int


@dataclass(frozen=True, slots=True, eq=False)
class Automaton:
    """A complete deterministic Rabin automaton of `formula` over the letters of `atoms`, marks on its transitions.

    A letter is an integer whose bit `i` says whether `atoms[i]` holds. The automaton reads the label of the initial
    state first, then the label of each state entered. States are numbered in the order in which a breadth-first
    search with ascending letters finds them, so equal formulas over equal atoms give equal arrays. At most one state
    accepts and at most one rejects; each has itself as its only successor. A run that stays in the others for ever is
    accepted when it satisfies one of the pairs. The arrays cannot be written to.
    """

    formula: Formula
    atoms: tuple[Atom, ...]
    initial: int
    successors: NDArray[np.int32]  # [states, 2 ** len(atoms)]
    marks: NDArray[np.uint32]  # [states, 2 ** len(atoms)]  bit i: the transition carries mark i
    acceptance: tuple[Pair, ...]  # none for a co-safe formula
    accepting: NDArray[np.bool_]  # [states]  the formula holds whatever follows; closed under successors
    rejecting: NDArray[np.bool_]  # [states]  the formula fails whatever follows; closed under successors
    hoa: str  # the same automaton in the Hanoi Omega-Automata format; its propositions are the atoms as text

    def __post_init__(self) -> None:
        for array in (self.successors, self.marks, self.accepting, self.rejecting):
            array.setflags(write=False)

    @property
    def states(self) -> int:
        """Number of states."""
        return int(self.successors.shape[0])

    def letters(self, truth: NDArray[np.bool_]) -> NDArray[np.int32]:
        """The letter of each world state: truth [atoms, n] -> letters [n]."""
        if truth.ndim != 2 or truth.shape[0] != len(self.atoms):
            raise ValueError(f"truth must be [{len(self.atoms)}, n], not {list(truth.shape)}")
        letters = np.zeros(truth.shape[1], dtype=np.int32)
        for bit, row in enumerate(truth):
            letters |= row.astype(np.int32) << bit
        return letters

    def read(self, states: NDArray[np.integer], letters: NDArray[np.integer]) -> NDArray[np.int32]:
        """The states after each of `states` has read its letter; shapes broadcast."""
        after: NDArray[np.int32] = self.successors[states, letters]
        return after

    def run(self, letters: Iterable[int]) -> list[int]:
        """The states visited while reading a word, the initial one first: one more than there are letters."""
        visited = [self.initial]
        for letter in letters:
            visited.append(int(self.successors[visited[-1], letter]))
        return visited
