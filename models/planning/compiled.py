"""A world gathered into arrays, once, for all automaton states."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from models.planning.errors import ModelTooLargeError
from models.planning.options import Options, Progress, no_progress
from models.planning.ragged import offsets, spans
from models.world import STAY, Transitions, World

BLOCK = 2**18
"""States compiled at a time, so that the world's dense answer for one action stays small."""

SAMPLE = 2**12
"""States looked at to estimate the memory of a larger world; drawn evenly spaced."""

OUTCOME_BYTES, CHOICE_BYTES = 12, 20
"""One listed outcome: successor (4), probability (8); one choice: action (4), cost (8), first outcome and place (8)."""

PRODUCT_OUTCOME_BYTES, PRODUCT_CHOICE_BYTES = 28, 48
"""The same for each memory that is iterated, at the peak: in the product (12 and 16), its predecessors (4 and 4) and
the problem that is solved (12 and 20); marks of choices (8)."""

STATE_BYTES, MEMORY_BYTES = 160, 16
"""Per state and memory that is iterated: policy (24), values and bounds (64), searches (72); and per state and memory:
what the memory becomes, the node, and whether there is one."""


@dataclass(frozen=True, slots=True, eq=False)
class CompiledWorld(Transitions):
    """The transitions of all states: every valid state has at least one choice, to STAY where there is no other."""

    states: int
    valid: NDArray[np.bool_]  # [S]


@dataclass(frozen=True, slots=True, eq=False)
class _Block:
    """The choices of consecutive states, in the order of CompiledWorld."""

    choices: NDArray[np.int32]  # [states]  how many
    action: NDArray[np.int32]  # [c]
    cost: NDArray[np.float64]  # [c]
    outcomes: NDArray[np.int32]  # [c]  how many
    successor: NDArray[np.int32]  # [e]
    probability: NDArray[np.float64]  # [e]


def check_size(states: int, memories: int, options: Options) -> None:
    """Refuse a product of more than `options.max_states` states; raises ModelTooLargeError."""
    product = states * memories
    if product > options.max_states:
        raise ModelTooLargeError(
            f"the product has {product} states ({states} of the world, {memories} of the automaton); "
            f"the limit is {options.max_states}",
            estimate=product,
            limit=options.max_states,
            unit="states",
        )


def check_memory(world: World, memories: int, live: int, options: Options) -> None:
    """Refuse a product that needs more than `options.max_bytes`; raises ModelTooLargeError before allocating
    it.

    `live` is the number of automaton states that are iterated. The choices and outcomes of a large world are estimated
    from evenly spaced states; worlds of up to SAMPLE states are small enough to be compiled first.
    """
    if world.listed is not None:
        counts = len(world.listed.action), len(world.listed.successor)
        _check_bytes(world.size, memories, live, *counts, copies=1, options=options)
        return
    if world.size <= SAMPLE:
        return
    states = np.linspace(0, world.size - 1, SAMPLE).astype(np.int64)
    states = states[world.valid(states)]
    choices = outcomes = 0
    for action in range(len(world.actions)):
        answer = world.outcomes(action, states)
        choices += int(np.count_nonzero(answer.enabled))
        outcomes += int(np.count_nonzero(answer.probability))
    share = world.size / max(1, len(states))
    counts = int(max(choices, len(states)) * share), int(max(outcomes, len(states)) * share)
    _check_bytes(world.size, memories, live, *counts, copies=2, options=options)


def check_outcomes(world: CompiledWorld, memories: int, live: int, options: Options) -> None:
    """As `check_memory`, with the outcomes counted; raises ModelTooLargeError before allocating the product."""
    _check_bytes(world.states, memories, live, len(world.action), len(world.successor), copies=1, options=options)


def _check_bytes(
    states: int, memories: int, live: int, choices: int, outcomes: int, *, copies: int, options: Options
) -> None:
    """`copies` is how often choices and outcomes are held beside the product: twice while blocks are joined."""
    rounds = max(1, live)
    estimate = (
        states * (MEMORY_BYTES * memories + STATE_BYTES * rounds)
        + choices * (CHOICE_BYTES * copies + PRODUCT_CHOICE_BYTES * rounds)
        + outcomes * (OUTCOME_BYTES * copies + PRODUCT_OUTCOME_BYTES * rounds)
    )
    if estimate > options.max_bytes:
        raise ModelTooLargeError(
            f"planning needs about {estimate} bytes ({states * memories} product states, about "
            f"{outcomes / states:.0f} outcomes a state); the limit is {options.max_bytes}",
            estimate=estimate,
            limit=options.max_bytes,
            unit="bytes",
        )


def compile_world(world: World, *, progress: Progress = no_progress) -> CompiledWorld:
    """Gather the dynamics of every valid state."""
    valid = world.valid()
    if world.listed is not None:
        return _from_listed(world.listed, valid)
    blocks = []
    for number, start in enumerate(range(0, world.size, BLOCK)):
        stop = min(start + BLOCK, world.size)
        blocks.append(_compile_block(world, valid, start, stop))
        progress("compile", number + 1, 0.0, np.inf, stop, -(-(world.size - stop) // BLOCK))
    return CompiledWorld(
        states=world.size,
        valid=valid,
        first_choice=offsets(_joined([block.choices for block in blocks])),
        action=_joined([block.action for block in blocks]),
        cost=np.concatenate([block.cost for block in blocks]),
        first_outcome=offsets(_joined([block.outcomes for block in blocks])),
        successor=_joined([block.successor for block in blocks]),
        probability=np.concatenate([block.probability for block in blocks]),
    )


def _from_listed(listed: Transitions, valid: NDArray[np.bool_]) -> CompiledWorld:
    """With a choice to stay in the states that have none."""
    counts = np.diff(listed.first_choice)
    stuck = np.flatnonzero(counts == 0).astype(np.int32)
    place = listed.first_choice[stuck]  # where the new choices go
    outcomes = np.diff(listed.first_outcome)
    at = listed.first_outcome[place]
    probability = np.insert(listed.probability, at, 1.0) if len(stuck) else listed.probability
    counted = np.insert(outcomes, place, 1) if len(stuck) else outcomes
    return CompiledWorld(
        states=len(counts),
        valid=valid,
        first_choice=offsets(np.maximum(counts, 1)),
        action=np.insert(listed.action, place, STAY) if len(stuck) else listed.action,
        cost=np.insert(listed.cost, place, 1.0) if len(stuck) else listed.cost,
        first_outcome=offsets(counted),
        successor=np.insert(listed.successor, at, stuck) if len(stuck) else listed.successor,
        probability=probability,
    )


def _joined(parts: list[NDArray[np.int32]]) -> NDArray[np.int32]:
    return parts[0] if len(parts) == 1 else np.concatenate(parts)


def _compile_block(world: World, valid: NDArray[np.bool_], start: int, stop: int) -> _Block:
    """The choices of the states start .. stop - 1."""
    whole = start == 0 and stop == world.size
    states = None if whole else np.arange(start, stop, dtype=np.int64)
    usable = valid[start:stop]
    stuck = usable.copy()
    owner, action, cost, outcomes, successor, probability = [], [], [], [], [], []
    for number in range(len(world.actions)):
        answer = world.outcomes(number, states)
        enabled = np.flatnonzero(answer.enabled & usable)
        if not len(enabled):
            continue
        stuck[enabled] = False
        chance = answer.probability.T[enabled]  # [m, k]
        happens = chance > 0
        owner.append(enabled.astype(np.int32))
        action.append(np.full(len(enabled), number, dtype=np.int32))
        cost.append(world.cost(number, enabled + start))
        outcomes.append(happens.sum(axis=1, dtype=np.int32))
        successor.append(answer.successor.T[enabled][happens].astype(np.int32))
        probability.append(chance[happens])
    alone = np.flatnonzero(stuck).astype(np.int32)
    owner.append(alone)
    action.append(np.full(len(alone), STAY, dtype=np.int32))
    cost.append(np.ones(len(alone)))
    outcomes.append(np.ones(len(alone), dtype=np.int32))
    successor.append(alone + np.int32(start))
    probability.append(np.ones(len(alone)))

    owners = np.concatenate(owner)
    order = np.argsort(owners, kind="stable").astype(np.int32)  # by state; by action within a state
    count = np.concatenate(outcomes)
    position = spans(offsets(count), order)
    return _Block(
        choices=np.bincount(owners, minlength=stop - start).astype(np.int32),
        action=np.concatenate(action)[order],
        cost=np.concatenate(cost)[order],
        outcomes=count[order],
        successor=np.concatenate(successor)[position],
        probability=np.concatenate(probability)[position],
    )
