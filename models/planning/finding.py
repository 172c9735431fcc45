"""The best policy in one world, or in a part of it: solved on all states or on those that can be reached."""

from __future__ import annotations

from dataclasses import dataclass
from itertools import count

import numpy as np

from models.logic import Automaton, Dialect, to_text
from models.planning import codec, dense, sparse
from models.planning.chain import Chain, explore
from models.planning.compiled import OUTCOME_BYTES, PRODUCT_OUTCOME_BYTES, check_size
from models.planning.errors import ModelTooLargeError
from models.planning.options import Options, Progress
from models.planning.policy import Policy
from models.planning.solution import Solution
from models.world import ProjectedWorld, ReachableWorld, World, reachable_part

MOST_REACHABLE = 1_000_000
"""States up to which the reachable part of a world that is too large as a whole is explored: some seconds."""

MOST_INDICES = 2**53
"""State indices beyond which nothing is explored: whoever reads a policy as JSON has floating-point numbers."""


@dataclass(frozen=True, slots=True, eq=False)
class Found:
    """A policy for a world, made in a part of it, and what its runs do in the whole."""

    part: World
    solution: Solution
    policy: Policy
    chain: Chain
    rounds: tuple[float, float] | None  # bounds of the expected steps; None without rounds, or with too many runs


@dataclass(frozen=True, slots=True, eq=False)
class Hopeless:
    """No policy satisfies the formula with a positive probability in `part`."""

    part: World


def find(
    world: World, part: World, automaton: Automaton, start: int, *, options: Options, progress: Progress
) -> Found | Hopeless:
    """The best policy of `part`, which is `world` or a projection of it, from the state `start` of the world.

    Raises ModelTooLargeError before allocating, DeviceUnavailableError, and whatever `progress` raises.
    """
    begin = part.initial if isinstance(part, ProjectedWorld) else start
    try:
        solution = _solve(part, automaton, begin, options, progress)
    except ModelTooLargeError:
        smaller = _reachable(part, automaton, begin, options, progress)
        if smaller is None:
            raise
        part = smaller
        solution = _solve(part, automaton, part.initial, options, progress)
    if solution is None:
        return Hopeless(part)
    policy = _policy(world, part, automaton, solution, start)
    chain = explore(world, policy, progress=progress)
    return Found(part, solution, policy, chain, _rounds(chain, policy, solution))


def _solve(part: World, automaton: Automaton, start: int, settings: Options, progress: Progress) -> Solution | None:
    """The best policy on all states of the part; None where its values are 0 in `start`."""
    check_size(part.size, automaton.states, settings)
    solution = dense.solve(part, automaton, start, options=settings, progress=progress)
    if solution is dense.UNSURE:
        solution = sparse.solve(part, automaton, start, options=settings, progress=progress)
    return solution if isinstance(solution, Solution) else None


def _reachable(
    part: World, automaton: Automaton, start: int, settings: Options, progress: Progress
) -> ReachableWorld | None:
    """What can be reached of a part that is too large as a whole; None where that is too large as well."""
    if part.size > MOST_INDICES or part.listed is not None:
        return None
    levels = count(1)
    return reachable_part(
        part,
        start,
        most_states=min(MOST_REACHABLE, settings.max_states // automaton.states),
        most_outcomes=settings.max_bytes // (OUTCOME_BYTES + PRODUCT_OUTCOME_BYTES),
        tell=lambda found: progress("compile", next(levels), 0.0, np.inf, found),
    )


def _rounds(chain: Chain, policy: Policy, solution: Solution) -> tuple[float, float] | None:
    """Bounds of the expected steps of a round, over the end components that the policy may come to."""
    if solution.component is None or not chain.whole:
        return None
    row = policy.row[chain.after]
    component = np.where(row >= 0, solution.component[row, policy.place(chain.state)], -1)
    met = np.unique(component[component >= 0])
    if not len(met):
        return None
    return float(solution.rounds[met, 0].min()), float(solution.rounds[met, 1].max())


def _policy(world: World, part: World, automaton: Automaton, solution: Solution, start: int) -> Policy:
    """Values by row and place, read by memory after the label."""
    live = np.flatnonzero(~automaton.accepting & ~automaton.rejecting)
    row = np.full(automaton.states, -1, dtype=np.int32)
    row[live] = np.arange(len(live), dtype=np.int32)
    strides = codec.strides(world.variables)
    harmless = tuple(tuple(range(len(variable.values))) for variable in world.variables)
    inner = part.whole if isinstance(part, ReachableWorld) else part
    if isinstance(inner, ProjectedWorld):
        strides, harmless = inner.projection.inner, inner.projection.harmless
    return Policy(
        variables=world.variables,
        strides=strides,
        harmless=harmless,
        indices=part.states if isinstance(part, ReachableWorld) else None,
        actions=world.actions,
        formula=to_text(automaton.formula, Dialect.INFIX),
        atoms=tuple(to_text(atom, Dialect.INFIX) for atom in automaton.atoms),
        hoa=automaton.hoa,
        initial_state=start,
        initial_memory=automaton.initial,
        successors=automaton.successors,
        accepted=automaton.accepting,
        row=row,
        letter=solution.letter,
        action=solution.action,
        probability=solution.probability,
        expected_steps=solution.expected_steps,
    )
