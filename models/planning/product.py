"""The product of a compiled world with a deterministic automaton.

A node is a pair (memory, state) whose memory has read the state's label: entering s' from (q, s) leads to
(δ(q, L(s')), s'), so the label read on a step is that of the state entered, and the label of the initial
state is read before the first step. Nodes with an accepting or rejecting memory are decided: they are two
columns, not nodes.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from models.logic import Automaton
from models.planning.compiled import CompiledWorld
from models.planning.kernels import layout
from models.planning.ragged import unsigned

_Arrays = tuple[
    NDArray[np.int32], NDArray[np.int32], NDArray[np.float64], NDArray[np.int32], NDArray[np.int32], NDArray[np.float64]
]
"""First choices, actions, costs, first outcomes, successors and probabilities."""


@dataclass(frozen=True, slots=True, eq=False)
class Product:
    """The undecided nodes that some memory and label lead to, with choices and outcomes laid out as in
    CompiledWorld.

    Successors are node numbers, or `accepted` or `lost`.
    """

    next_memory: NDArray[np.int32]  # [Q, S]  δ(q, L(s)), the memory after reading s; -1 for an invalid state
    node: NDArray[np.int32]  # [Q, S]  by memory after reading: node number, `accepted` or `lost`
    first_choice: NDArray[np.int32]  # [n + 1]
    action: NDArray[np.int32]  # [C]
    cost: NDArray[np.float64]  # [C]
    first_outcome: NDArray[np.int32]  # [C + 1]
    successor: NDArray[np.int32]  # [E]
    probability: NDArray[np.float64]  # [E]
    marks: NDArray[np.uint32]  # [C]  that some outcome of the choice carries; empty where acceptance has no pairs
    meets: Mapping[int, NDArray[np.float64]]  # by mark that a pair asks for (a bit): [C] the probability to meet it

    @property
    def nodes(self) -> int:
        """Number of nodes, n."""
        return len(self.first_choice) - 1

    @property
    def accepted(self) -> int:
        """The column of every node in which the formula holds whatever follows."""
        return self.nodes

    @property
    def lost(self) -> int:
        """The column of every node in which the formula fails whatever follows, and of invalid states."""
        return self.nodes + 1

    @property
    def moves(self) -> tuple[NDArray[np.uint32], NDArray[np.uint32], NDArray[np.uint32]]:
        """First choices, first outcomes and successors, as compiled loops read them."""
        return unsigned(self.first_choice), unsigned(self.first_outcome), unsigned(self.successor)

    def node_of(self, memory: int, state: int) -> int:
        """The node reached by reading the label of `state` in `memory`; memory is the one before reading."""
        return int(self.node[self.next_memory[memory, state], state])

    def contracted(self, won: NDArray[np.bool_]) -> Product:
        """Without the nodes of `won` ([n + 2]), which become part of the column of acceptance."""
        kept = np.flatnonzero(~won[: self.nodes]).astype(np.int32)
        column = np.full(self.nodes + 2, len(kept), dtype=np.int32)
        column[kept] = np.arange(len(kept), dtype=np.int32)
        column[self.lost] = len(kept) + 1
        arrays = _copied(self, [(kept, column)])
        return Product(self.next_memory, column[self.node], *arrays, np.zeros(0, dtype=np.uint32), {})


def build_product(world: CompiledWorld, automaton: Automaton, letter: NDArray[np.int32]) -> Product:
    """The product over every memory and valid state, not only the reachable ones: a robot may re-enter
    anywhere. `letter` is [S], the label of each state.
    """
    next_memory = np.take(automaton.successors, letter, axis=1)
    next_memory[:, ~world.valid] = -1
    live = ~automaton.accepting & ~automaton.rejecting
    node = np.empty((automaton.states, world.states), dtype=np.int32)
    nodes = layout.number_nodes(next_memory, world.valid, live, (~automaton.accepting).astype(np.int32), node)
    members = [(memory, np.flatnonzero(node[memory] < nodes).astype(np.int32)) for memory in np.flatnonzero(live)]
    # What is entered from a memory, by state; an invalid state has no predecessor, so its entry is never used.
    parts = [(states, node[next_memory[memory], np.arange(world.states)]) for memory, states in members]
    arrays = _copied(world, parts)
    return Product(next_memory, node, *arrays, *_marks(world, automaton, letter, members, len(arrays[1])))


def _copied(source: CompiledWorld | Product, parts: Sequence[tuple[NDArray[np.int32], NDArray[np.int32]]]) -> _Arrays:
    """The choices and outcomes of the rows of each part, one part after the other, their successors renamed by what
    stands beside the rows.
    """
    first_choice = np.zeros(sum(len(rows) for rows, _ in parts) + 1, dtype=np.int32)
    at = outcomes = 0
    for rows, _ in parts:
        outcomes += layout.room(rows, source.first_choice, source.first_outcome, first_choice, at)
        at += len(rows)
    choices = int(first_choice[-1])
    out = (
        np.empty(choices, dtype=np.int32),
        np.empty(choices),
        np.zeros(choices + 1, dtype=np.int32),
        np.empty(outcomes, dtype=np.int32),
        np.empty(outcomes),
    )
    ends = np.zeros(2, dtype=np.int64)
    first, start, successor = map(unsigned, (source.first_choice, source.first_outcome, source.successor))
    for rows, entered in parts:
        layout.copy(rows, entered, first, source.action, source.cost, start, successor, source.probability, ends, out)
    return first_choice, *out


def _marks(
    world: CompiledWorld,
    automaton: Automaton,
    letter: NDArray[np.int32],
    members: Sequence[tuple[np.intp, NDArray[np.int32]]],
    choices: int,
) -> tuple[NDArray[np.uint32], Mapping[int, NDArray[np.float64]]]:
    """`marks` and `meets` of Product."""
    if not automaton.acceptance:
        return np.zeros(0, dtype=np.uint32), {}
    wanted = sorted({pair.infinite for pair in automaton.acceptance if pair.infinite})
    marks, meets = np.zeros(choices, dtype=np.uint32), np.zeros((len(wanted), choices))
    bits, arrays, at = np.array(wanted, dtype=np.uint32), (world.first_choice, world.first_outcome), 0
    for memory, states in members:
        carried = automaton.marks[memory, letter]
        at = layout.carry(states, carried, bits, *arrays, world.successor, world.probability, at, marks, meets)
    return marks, dict(zip(wanted, meets, strict=True))
