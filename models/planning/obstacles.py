"""Why nothing can be done: what is so in every run from here, and leaves none that satisfies the goal.

Facts are looked for in the states that can be reached: that a proposition never holds or always does, that it holds at
first or does not, that two never hold at once, that once one has held another never does. A fact explains a goal where
both together are unsatisfiable, which Spot decides.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from itertools import combinations, permutations

import numpy as np
from numpy.typing import NDArray
from scipy.sparse import coo_array
from scipy.sparse.csgraph import breadth_first_order

from models.logic import Atom, Automaton, Binary, Formula, FormulaTooLargeError, Op, Unary, conjunction, is_satisfiable
from models.planning.compiled import OUTCOME_BYTES
from models.planning.options import Options
from models.planning.ragged import owners
from models.world import ProjectedWorld, ReachableWorld, World, reachable_part

MOST_STATES = 100_000
"""Reachable states up to which they are looked at."""
MOST_ATOMS = 8
"""Propositions of a goal up to which two are looked at together."""

Holds = NDArray[np.bool_]
"""[R] where a proposition holds, of the reachable states."""


def obstacles(part: World, automaton: Automaton, start: int, options: Options) -> tuple[Formula, ...]:
    """Facts of all runs from `start` that make the goal impossible, the simplest first.

    Each makes it so by itself; where none does, all are needed together. None where no such facts are known, as with
    too many states to look at, or no time.
    """
    reached = None if options.hurry("evaluate") else _reached(part, start, options)
    facts = [] if reached is None else list(_facts(reached, automaton.atoms))
    try:
        alone = tuple(fact for fact in facts if not is_satisfiable(conjunction(automaton.formula, fact)))
        return alone or _needed(automaton.formula, facts)
    except FormulaTooLargeError:
        return ()


def _reached(part: World, start: int, options: Options) -> ReachableWorld | None:
    if isinstance(part, ReachableWorld):
        return part if part.size <= MOST_STATES else None
    begin = part.initial if isinstance(part, ProjectedWorld) else start
    return reachable_part(part, begin, most_states=MOST_STATES, most_outcomes=options.max_bytes // OUTCOME_BYTES)


def _facts(world: ReachableWorld, atoms: Sequence[Atom]) -> Iterator[Formula]:
    labels = dict(zip(atoms, world.labels(atoms), strict=True))
    sometimes = {atom: holds for atom, holds in labels.items() if holds.any() and not holds.all()}
    for atom, holds in labels.items():
        if atom not in sometimes:
            yield _always(atom if holds.any() else _not(atom))
    for atom, holds in sometimes.items():
        yield atom if holds[world.initial] else _not(atom)
    if len(sometimes) > MOST_ATOMS:
        return
    before = {atom: _may_lead_to(world, holds) for atom, holds in sometimes.items()}
    for one, other in permutations(sometimes, 2):
        if not (sometimes[one] & before[other]).any():
            yield _always(Binary(Op.IMPLIES, one, _always(_not(other))))
    for one, other in combinations(sometimes, 2):
        if not (sometimes[one] & sometimes[other]).any():
            yield _always(_not(conjunction(one, other)))


def _may_lead_to(world: ReachableWorld, target: Holds) -> Holds:
    """From where a state of the target can be reached, those of the target among them."""
    assert world.listed is not None
    moves, size = world.listed, world.size
    source = owners(moves.first_choice)[owners(moves.first_outcome)]
    goals = np.flatnonzero(target)
    rows = np.concatenate([moves.successor, np.full(len(goals), size)])
    columns = np.concatenate([source, goals])
    backwards = coo_array((np.ones(len(rows), np.bool_), (rows, columns)), shape=(size + 1, size + 1)).tocsr()
    found = np.zeros(size + 1, dtype=np.bool_)
    found[breadth_first_order(backwards, size, return_predecessors=False)] = True
    return found[:size]


def _needed(formula: Formula, facts: Sequence[Formula]) -> tuple[Formula, ...]:
    """Those of the facts that cannot be left out; none where all together leave the formula satisfiable."""
    left = list(facts)
    if is_satisfiable(conjunction(formula, *left)):
        return ()
    for fact in facts:
        rest = [other for other in left if other is not fact]
        if not is_satisfiable(conjunction(formula, *rest)):
            left = rest
    return tuple(left)


def _always(formula: Formula) -> Formula:
    return Unary(Op.GLOBALLY, formula)


def _not(formula: Formula) -> Formula:
    return Unary(Op.NOT, formula)
