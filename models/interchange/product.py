"""The product of a world and a deterministic automaton in DRN."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from models.interchange.drn import Graph, drn_text, label_notes, state_comments
from models.interchange.errors import ExportTooLargeError
from models.interchange.listing import MAX_EXPORT_STATES, Listing, list_reachable, offsets, spans
from models.interchange.names import label_names
from models.logic import Automaton, to_text
from models.world import World

ACCEPTING, REJECTING, MARK = "accepting", "rejecting", "mark_"


@dataclass(frozen=True, slots=True, eq=False)
class _Nodes:
    """The reachable nodes, and Graph's arrays over them."""

    row: NDArray[np.int64]  # [n]  of the listing
    memory: NDArray[np.int64]  # [n]  the automaton's state after reading the label of the row
    marks: NDArray[np.int64]  # [n]  of the automaton's transition that read it, as bits
    first_choice: NDArray[np.int64]
    action: NDArray[np.int64]
    cost: NDArray[np.float64]
    first_outcome: NDArray[np.int64]
    successor: NDArray[np.int64]
    probability: NDArray[np.float64]


def drn_product(world: World, automaton: Automaton, *, comments: bool = True) -> str:
    """The reachable product as an MDP in DRN: the label of the initial state is read first, then that of each entered.

    A node is a state of the world, the automaton's state after reading its label and, where the automaton has marks,
    those of the transition just taken. Labels: `accepting` and `rejecting` for nodes in which the formula is decided,
    `mark_0`, `mark_1`, ... for nodes entered over a transition with that mark, and the formula's atoms. A comment
    gives the property whose maximal probability is the formula's (`product_property`). The rest is as in `drn_model`.

    Raises ExportTooLargeError, and UnknownPropositionError, UnknownObjectError or TypeMismatchError for an atom that
    is not of the world.
    """
    listing = list_reachable(world)
    truth = world.labels(automaton.atoms, listing.states)
    nodes = _explore(listing, automaton, automaton.letters(truth).astype(np.int64))
    labels = {ACCEPTING: automaton.accepting[nodes.memory], REJECTING: automaton.rejecting[nodes.memory]}
    for bit in _bits(_used(automaton)):
        labels[f"{MARK}{bit}"] = (nodes.marks >> bit & 1).astype(np.bool_)
    names = label_names(automaton.atoms, reserved=labels)
    labels |= {name: holds[nodes.row] for name, holds in zip(names.values(), truth, strict=True)}
    graph = Graph(
        0, labels, _comments(world, listing, nodes) if comments else (), nodes.first_choice, nodes.action,
        nodes.cost, nodes.first_outcome, nodes.successor, nodes.probability,
    )  # fmt: skip
    about = f"{world.name} and {to_text(automaton.formula)}, written by cqltl"
    return drn_text(graph, world, [about, product_property(automaton), *label_notes(names)])


def product_property(automaton: Automaton) -> str:
    """What to ask Storm about the product: the maximal probability of the automaton's formula."""
    undecided = f'(G (!"{REJECTING}"))'
    ways = [f'(F "{ACCEPTING}")']
    for finite, infinite in automaton.acceptance:
        rarely = [f'(F (G (!"{MARK}{bit}")))' for bit in _bits(finite)]
        often = [f'(G (F "{MARK}{bit}"))' for bit in _bits(infinite)]
        ways.append(f"({' & '.join([undecided, *rarely, *often])})")
    return f"Pmax=? [ {' | '.join(ways)} ]"


def _used(automaton: Automaton) -> int:
    """The marks that the acceptance condition speaks of."""
    used = 0
    for finite, infinite in automaton.acceptance:
        used |= finite | infinite
    return used


def _bits(mask: int) -> list[int]:
    return [bit for bit in range(int(mask).bit_length()) if mask >> bit & 1]


def _explore(listing: Listing, automaton: Automaton, letter: NDArray[np.int64]) -> _Nodes:
    """Breadth first over nodes, which are numbered `(memory * kinds + kind of marks) * rows + row` on the way."""
    marks = automaton.marks.astype(np.int64) & _used(automaton)
    kinds, kind = np.unique(marks, return_inverse=True)
    kind = kind.reshape(marks.shape)
    rows, successors = len(listing.states), automaton.successors.astype(np.int64)

    def read(memory: NDArray[np.int64], row: NDArray[np.int64]) -> NDArray[np.int64]:
        keys: NDArray[np.int64] = successors[memory, letter[row]] * len(kinds) + kind[memory, letter[row]]
        return keys * rows + row

    frontier = read(np.array([automaton.initial]), np.array([listing.initial]))
    seen, found, entered = frontier, [], []
    while len(frontier):
        found.append(frontier)
        choice = spans(listing.first_choice, frontier % rows)
        memory = np.repeat(frontier // (len(kinds) * rows), _outcomes(listing)[frontier % rows])
        targets = read(memory, listing.successor[spans(listing.first_outcome, choice)])
        entered.append(targets)
        unique = np.unique(targets)
        frontier = unique[~np.isin(unique, seen, assume_unique=True)]
        seen = np.union1d(seen, frontier)
        if len(seen) > MAX_EXPORT_STATES:
            raise ExportTooLargeError(f"the product has more than {MAX_EXPORT_STATES} states")
    return _nodes(listing, kinds, np.concatenate(found), np.concatenate(entered))


def _nodes(listing: Listing, kinds: NDArray[np.int64], keys: NDArray[np.int64], targets: NDArray[np.int64]) -> _Nodes:
    """The nodes of some numbers, whose outcomes in order enter `targets`."""
    rows = len(listing.states)
    row = keys % rows
    choice = spans(listing.first_choice, row)
    order = np.argsort(keys)
    return _Nodes(
        row=row,
        memory=keys // (len(kinds) * rows),
        marks=kinds[keys // rows % len(kinds)],
        first_choice=offsets(np.diff(listing.first_choice)[row]),
        action=listing.action[choice],
        cost=listing.cost[choice],
        first_outcome=offsets(np.diff(listing.first_outcome)[choice]),
        successor=order[np.searchsorted(keys, targets, sorter=order)],
        probability=listing.probability[spans(listing.first_outcome, choice)],
    )


def _outcomes(listing: Listing) -> NDArray[np.int64]:
    """[n] outcomes of all choices of each row together."""
    counts: NDArray[np.int64] = np.diff(listing.first_outcome[listing.first_choice])
    return counts


def _comments(world: World, listing: Listing, nodes: _Nodes) -> list[str]:
    states = state_comments(world, listing)
    return [
        f"{states[row]} & memory={memory}" + "".join(f" & {MARK}{bit}" for bit in _bits(marks))
        for row, memory, marks in zip(nodes.row.tolist(), nodes.memory.tolist(), nodes.marks.tolist(), strict=True)
    ]
