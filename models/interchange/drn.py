"""Worlds state by state in DRN, Storm's direct encoding (https://www.stormchecker.org/documentation/background/languages.html)."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from models.interchange.listing import Listing, list_reachable, list_valid
from models.interchange.names import action_names, label_names, number_text
from models.interchange.rewards import COSTS, STEPS
from models.logic import Atom, atom_text
from models.world import World


@dataclass(frozen=True, slots=True, eq=False)
class Graph:
    """What a DRN file holds: rows, choices and outcomes as in Listing, with labels and a comment for each row."""

    initial: int
    labels: Mapping[str, NDArray[np.bool_]]  # [n]
    comments: Sequence[str]  # of the rows; empty for none
    first_choice: NDArray[np.int64]
    action: NDArray[np.int64]
    cost: NDArray[np.float64]
    first_outcome: NDArray[np.int64]
    successor: NDArray[np.int64]
    probability: NDArray[np.float64]


def drn_model(world: World, *, atoms: Sequence[Atom] = (), reachable: bool = False, comments: bool = True) -> str:
    """The world's valid states, or those that are reachable from the initial one, as an MDP in DRN.

    Each atom is a label, named by `label_names`; choices are labelled with the identifiers of actions, which a
    comment explains; a state without any has the choice `stay`. The rewards `steps` count actions; where some cost
    other than 1, `costs` has what they cost. With `comments` each state is followed by its values. A label that holds
    nowhere is given to one more state, which nothing leads to, since Storm knows only the labels it has seen.

    Raises ExportTooLargeError, and UnknownPropositionError, UnknownObjectError or TypeMismatchError for an atom that
    is not of the world.
    """
    listing = list_reachable(world) if reachable else list_valid(world)
    names = label_names(atoms)
    holds = world.labels(list(names), listing.states)
    graph = Graph(
        initial=listing.initial,
        labels=dict(zip(names.values(), holds, strict=True)),
        comments=state_comments(world, listing) if comments else (),
        first_choice=listing.first_choice,
        action=listing.action,
        cost=listing.cost,
        first_outcome=listing.first_outcome,
        successor=listing.successor,
        probability=listing.probability,
    )
    return drn_text(graph, world, [f"{world.name}, written by cqltl", *label_notes(names)])


def label_notes(names: Mapping[Atom, str]) -> list[str]:
    """Comments that say which atom a label is."""
    return [f"label {label} is {atom_text(atom)}" for atom, label in names.items() if atom_text(atom) != label]


def state_comments(world: World, listing: Listing) -> list[str]:
    """`robot.at=kitchen & box.in=bedroom` for each row."""
    return [
        " & ".join(
            f"{name}.{key}={value}" for name, values in world.decode(state).items() for key, value in values.items()
        )
        for state in listing.states.tolist()
    ]


def drn_text(graph: Graph, world: World, notes: Sequence[str]) -> str:
    """The file, with notes as comments at its head."""
    names = action_names(world.actions)
    changed = zip(world.actions, names, strict=False)
    notes = [*notes, *(f"action {identifier} is {name}" for name, identifier in changed if name != identifier)]
    rows, choices = len(graph.first_choice) - 1, len(graph.action)
    absent = [label for label, holds in graph.labels.items() if not holds.any()]
    lines = [f"// {note}" for note in notes]
    lines += ["@type: MDP", "@value_type: double", "@parameters", "", "@reward_models", " ".join(_rewards(graph))]
    lines += ["@nr_states", str(rows + bool(absent)), "@nr_choices", str(choices + bool(absent)), "@model"]
    lines += _rows(graph, names)
    if absent:
        nothing = ", ".join("0" for _ in _rewards(graph))
        lines += [f"state {rows} [{nothing}] {' '.join(absent)}", "// no state of the world: it declares labels"]
        lines += [f"\taction {names[-1]}", f"\t\t{rows} : 1"]
    return "\n".join(lines) + "\n"


def _rewards(graph: Graph) -> tuple[str, ...]:
    """The reward models: `steps` are rewards of states, `costs` of choices."""
    return (STEPS, COSTS) if (graph.cost != 1).any() else (STEPS,)


def _rows(graph: Graph, names: Sequence[str]) -> Iterator[str]:
    first_choice, first_outcome = graph.first_choice.tolist(), graph.first_outcome.tolist()
    action, successor, probability = graph.action.tolist(), graph.successor.tolist(), graph.probability.tolist()
    labels, costs = _labels(graph), [f" [0, {number_text(cost)}]" for cost in graph.cost.tolist()]
    counted = "1, 0"
    if len(_rewards(graph)) == 1:
        costs, counted = [""] * len(costs), "1"
    for row in range(len(first_choice) - 1):
        yield f"state {row} [{counted}]{labels[row]}"
        if graph.comments:
            yield f"//[{graph.comments[row]}]"
        for choice in range(first_choice[row], first_choice[row + 1]):
            yield f"\taction {names[action[choice]]}{costs[choice]}"
            begin, end = first_outcome[choice], first_outcome[choice + 1]
            outcomes = sorted(zip(successor[begin:end], probability[begin:end], strict=True))
            yield from (f"\t\t{target} : {number_text(chance)}" for target, chance in outcomes)


def _labels(graph: Graph) -> list[str]:
    """What follows the rewards of each row."""
    texts = [""] * (len(graph.first_choice) - 1)
    texts[graph.initial] = " init"
    for label, holds in graph.labels.items():
        for row in np.flatnonzero(holds).tolist():
            texts[row] += f" {label}"
    return texts
