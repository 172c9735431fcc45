"""How much of a world to plan in.

A co-safe formula that does not count steps needs only what it can depend on (`models.world.relevance`). For other
formulas it may matter that the robot can stay where it is by doing something of no consequence. A part of the world is
then as good as the whole when its policy is as good as the best one in the same part with leave to stay anywhere,
which bounds the whole world from above (`models.world.idling`). Where it is not, a larger part is tried, and in the end
the whole. Each is some times larger than the one before, so that all together cost little beside the last.
"""

from __future__ import annotations

from dataclasses import replace
from itertools import islice

import numpy as np

from models.logic import Automaton
from models.planning.finding import Found, Hopeless, find
from models.planning.options import Options, Progress
from models.planning.policy import WAIT
from models.world import IdlingWorld, OomdpWorld, ProjectedWorld, World, relevant_part, relevant_parts

MOST_PARTS = 3
"""Parts that are tried before the whole world."""

CLOSE = 1e-6
"""Relative difference within which expected steps, known to 1e-7 at best, are the same."""


def narrowed(
    world: World, automaton: Automaton, start: int, *, options: Options, progress: Progress
) -> Found | Hopeless:
    """The best policy from the state `start`, in the smallest part of the world that is known to do; raises as `find`.

    The upper bound of the probability and the lower one of the steps hold for all policies of the whole world.
    """
    if not options.relevance or not isinstance(world, OomdpWorld) or _finishes(automaton):
        part = first_part(world, automaton, start, options)
        return find(world, part, automaton, start, options=options, progress=progress)
    for part in islice(relevant_parts(world, automaton.atoms, start), MOST_PARTS):
        found = _as_good_as_all(world, part, automaton, start, options, progress)
        if found is not None:
            return found
    return find(world, world, automaton, start, options=options, progress=progress)


def first_part(world: World, automaton: Automaton, start: int, options: Options) -> World:
    """The least that is planned in."""
    if not options.relevance or not isinstance(world, OomdpWorld):
        return world
    if _finishes(automaton):
        return relevant_part(world, automaton.atoms, start) or world
    return next(relevant_parts(world, automaton.atoms, start), world)


def _finishes(automaton: Automaton) -> bool:
    """Whether the formula is co-safe, and to read a letter twice is always the same as to read it once."""
    after = automaton.successors
    return not automaton.acceptance and bool((after[after, np.arange(after.shape[1])] == after).all())


def _as_good_as_all(
    world: OomdpWorld,
    part: ProjectedWorld,
    automaton: Automaton,
    start: int,
    options: Options,
    progress: Progress,
) -> Found | Hopeless | None:
    """What is best in the part, if the whole world has nothing better; else None."""
    found = find(world, part, automaton, start, options=options, progress=progress)
    if isinstance(found, Found) and _waits_in_vain(world, found):
        return None
    more = IdlingWorld(part)
    most = find(more, more, automaton, part.initial, options=options, progress=progress)
    if isinstance(most, Hopeless):  # and so is the part
        return found
    if isinstance(found, Hopeless):
        return None
    mine, best = found.solution, most.solution
    if not (
        (best.upper - mine.lower <= options.epsilon and _close(mine.steps[1], best.steps[0]) and _as_short(found, most))
        or options.hurry("steps")  # there is no time for more of the world
    ):
        return None
    bounded = replace(
        mine,
        upper=max(mine.lower, min(1.0, best.upper)),
        steps=(min(mine.steps[0], best.steps[0]), mine.steps[1]),
    )
    return replace(found, solution=bounded)


def _waits_in_vain(world: OomdpWorld, found: Found) -> bool:
    """Whether the policy lets a step pass where the whole world has something to do, and so goes on otherwise."""
    waiting = found.chain.state[found.chain.action == WAIT]
    return any(bool(world.outcomes(one, waiting).enabled.any()) for one in range(len(world.actions)) if len(waiting))


def _as_short(found: Found, most: Found) -> bool:
    """Whether the rounds are as short as with leave to stay."""
    if found.rounds is None or most.rounds is None:
        return True
    return all(_close(mine, best) for mine, best in zip(found.rounds, most.rounds, strict=True))


def _close(mine: float, best: float) -> bool:
    return mine <= best * (1 + CLOSE)
