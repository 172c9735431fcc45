"""The product of a compiled world with a deterministic automaton.

A node is a pair (memory, state) whose memory has read the state's label: entering s' from (q, s) leads to
(δ(q, L(s')), s'), so the label read on a step is that of the state entered, and the label of the initial
state is read before the first step. Nodes with an accepting or rejecting memory are decided: they are two
columns, not nodes.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from models.logic import Automaton
from models.planning.compiled import CompiledWorld
from models.planning.ragged import offsets, spans


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

    def node_of(self, memory: int, state: int) -> int:
        """The node reached by reading the label of `state` in `memory`; memory is the one before reading."""
        return int(self.node[self.next_memory[memory, state], state])

    def contracted(self, won: NDArray[np.bool_]) -> Product:
        """Without the nodes of `won` ([n + 2]), which become part of the column of acceptance."""
        kept = np.flatnonzero(~won[: self.nodes]).astype(np.int32)
        column = np.full(self.nodes + 2, len(kept), dtype=np.int32)
        column[kept] = np.arange(len(kept), dtype=np.int32)
        column[self.lost] = len(kept) + 1
        choice = spans(self.first_choice, kept)
        outcome = spans(self.first_outcome, choice)
        return Product(
            next_memory=self.next_memory,
            node=column[self.node],
            first_choice=offsets(np.diff(self.first_choice)[kept]),
            action=self.action[choice],
            cost=self.cost[choice],
            first_outcome=offsets(np.diff(self.first_outcome)[choice]),
            successor=column[self.successor[outcome]],
            probability=self.probability[outcome],
            marks=np.zeros(0, dtype=np.uint32),
            meets={},
        )


def build_product(world: CompiledWorld, automaton: Automaton, letter: NDArray[np.int32]) -> Product:
    """The product over every memory and valid state, not only the reachable ones: a robot may re-enter
    anywhere. `letter` is [S], the label of each state.
    """
    next_memory = automaton.successors[:, letter]
    next_memory[:, ~world.valid] = -1
    live = np.flatnonzero(~automaton.accepting & ~automaton.rejecting)
    node, members = _number_nodes(world, automaton, next_memory, live)
    everything = np.arange(world.states, dtype=np.int32)
    wanted = sorted({pair.infinite for pair in automaton.acceptance if pair.infinite})
    choices, actions, costs, outcomes, successors, probabilities = [], [], [], [], [], []
    marks, meets = [], {bit: [np.zeros(0)] for bit in wanted}
    for memory, states in zip(live, members, strict=True):
        # What is entered from this memory, by state; an invalid state has no predecessor, so its entry is never used.
        entered = node[next_memory[memory], everything]
        choice = spans(world.first_choice, states)
        whole = len(choice) == len(world.action)
        outcome = slice(None) if whole else spans(world.first_outcome, choice)
        choices.append(np.diff(world.first_choice)[states])
        actions.append(world.action[choice])
        costs.append(world.cost[choice])
        outcomes.append(np.diff(world.first_outcome)[choice])
        successors.append(entered[world.successor[outcome]])
        probabilities.append(world.probability[outcome])
        if automaton.acceptance and len(choice):
            carried = automaton.marks[memory, letter][world.successor[outcome]]
            start = offsets(outcomes[-1])[:-1]
            marks.append(np.bitwise_or.reduceat(carried, start))
            for bit in wanted:
                meets[bit].append(np.add.reduceat(np.where(carried & bit, probabilities[-1], 0.0), start))
    none = [np.zeros(0, dtype=np.int32)]
    return Product(
        next_memory=next_memory,
        node=node,
        first_choice=offsets(np.concatenate(choices or none)),
        action=np.concatenate(actions or none),
        cost=np.concatenate(costs or [np.zeros(0)]),
        first_outcome=offsets(np.concatenate(outcomes or none)),
        successor=np.concatenate(successors or none),
        probability=probabilities[0] if len(probabilities) == 1 else np.concatenate(probabilities or [np.zeros(0)]),
        marks=np.concatenate(marks or [np.zeros(0, dtype=np.uint32)]),
        meets={bit: np.concatenate(parts) for bit, parts in meets.items()},
    )


def _number_nodes(
    world: CompiledWorld, automaton: Automaton, next_memory: NDArray[np.int32], live: NDArray[np.intp]
) -> tuple[NDArray[np.int32], list[NDArray[np.int32]]]:
    """`node` of Product, and the states of each live memory's nodes, ascending."""
    everything = np.flatnonzero(world.valid)
    entered = np.zeros((automaton.states, world.states), dtype=np.bool_)
    for memory in range(automaton.states):
        entered[next_memory[memory, everything], everything] = True
    members = [np.flatnonzero(entered[memory]).astype(np.int32) for memory in live]
    total = sum(len(states) for states in members)
    node = np.full((automaton.states, world.states), total + 1, dtype=np.int32)
    node[automaton.accepting] = total
    start = 0
    for memory, states in zip(live, members, strict=True):
        node[memory, states] = np.arange(start, start + len(states), dtype=np.int32)
        start += len(states)
    return node, members
