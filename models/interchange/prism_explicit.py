"""Worlds listed state by state in the PRISM language: one variable, a command for each state and action."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

import numpy as np
from numpy.typing import NDArray

from models.interchange.listing import Listing, list_valid
from models.interchange.names import action_names, label_names, number_text
from models.interchange.rendering import Renderer
from models.interchange.rewards import reward_lines
from models.logic import Atom, atom_text
from models.world import World

_VARIABLE, _MODULE = "s", "world"


def explicit_body(world: World, atoms: Sequence[Atom]) -> Iterator[str]:
    """The lines of the module and its labels; the variable `s` is the number of the state.

    Raises ExportTooLargeError.
    """
    listing = list_valid(world)
    write = Renderer([_VARIABLE], [[str(state) for state in range(world.size)]])
    yield ""
    yield f"module {_MODULE}"
    yield f"  {_VARIABLE} : [0..{max(1, world.size - 1)}] init {world.initial};"  # PRISM wants two values or more
    yield ""
    yield from _commands(world, listing, write)
    yield "endmodule"
    if atoms:
        yield ""
    for (atom, label), holds in zip(label_names(atoms).items(), world.labels(list(dict.fromkeys(atoms))), strict=True):
        yield f'label "{label}" = {_where(write, holds)}; // {atom_text(atom)}'
    yield from reward_lines(_costs(world, listing, write) if (listing.cost != 1).any() else [])


def _identifiers(world: World) -> list[str]:
    return action_names(world.actions, reserved=(_VARIABLE, _MODULE))


def _commands(world: World, listing: Listing, write: Renderer) -> Iterator[str]:
    names = _identifiers(world)
    owner = np.repeat(listing.states, np.diff(listing.first_choice))
    for action, (name, identifier) in enumerate(zip(world.actions, names, strict=False)):
        if name != identifier:
            yield f"  // {identifier} is {name}"
        for choice in np.flatnonzero(listing.action == action).tolist():
            first, last = listing.first_outcome[choice : choice + 2]
            outcomes = zip(
                listing.probability[first:last].tolist(), listing.successor[first:last].tolist(), strict=True
            )
            yield f"  [{identifier}] {_VARIABLE} = {owner[choice]} -> {_outcomes(list(outcomes), listing)};"
    stuck = np.zeros(world.size, dtype=np.bool_)
    stuck[owner[listing.action == len(world.actions)]] = True
    if stuck.any():
        yield f"  [{names[-1]}] {_where(write, stuck)} -> true; // where nothing is possible"


def _costs(world: World, listing: Listing, write: Renderer) -> list[str]:
    """What each action costs in the states in which it is possible."""
    names = _identifiers(world)
    owner = np.repeat(listing.states, np.diff(listing.first_choice))
    items = []
    for action in np.unique(listing.action).tolist():
        taken = listing.action == action
        for cost in np.unique(listing.cost[taken]).tolist():
            here = np.zeros(world.size, dtype=np.bool_)
            here[owner[taken & (listing.cost == cost)]] = True
            items.append(f"[{names[action]}] {_where(write, here)} : {number_text(cost)}")
    return items


def _outcomes(outcomes: list[tuple[float, int]], listing: Listing) -> str:
    if len(outcomes) == 1:
        return f"({_VARIABLE}' = {listing.states[outcomes[0][1]]})"
    return " + ".join(f"{number_text(p)} : ({_VARIABLE}' = {listing.states[row]})" for p, row in outcomes)


def _where(write: Renderer, holds: NDArray[np.bool_]) -> str:
    if holds.all() or not holds.any():
        return "true" if holds.all() else "false"
    return write.member(0, int.from_bytes(np.packbits(holds, bitorder="little").tobytes(), "little"))
