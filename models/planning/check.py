"""A policy's claims, worked out again from nothing but the world, the policy's arrays and the formula.

The policy makes the world a Markov chain. Its runs end up in a bottom strongly connected component with probability
one, which is accepted when the marks in it satisfy one of the automaton's pairs. Nothing of the product, the end
components or the iteration of `plan` is used.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray
from scipy import sparse
from scipy.sparse.linalg import splu

from models.logic import parse, translate
from models.planning.chain import Chain, explore
from models.planning.errors import UncheckableError
from models.planning.lasso import bottoms
from models.planning.policy import NOTHING, Policy
from models.world import World

MOST_STATES = 200_000
"""Largest chain that is checked: its linear systems are factorised."""

SMALL = 1e-9
"""How far below one the probability may be found, by rounding, where the policy says it only has to go on."""


@dataclass(frozen=True, slots=True)
class Check:
    """What the policy's Markov chain attains from its initial state.

    `sound`: wherever the policy says that the formula holds if it goes on for ever, its runs satisfy the formula with
    probability one. `expected_steps` is infinite when a run may stay undecided for ever. `error` bounds how far
    rounding may have moved the probability. Steps are counted at their costs, as in the policy.
    """

    probability: float
    expected_steps: float
    sound: bool
    states: int  # product states that the policy may come to
    error: float


def check(world: World, policy: Policy) -> Check:
    """Evaluate `policy` in `world` from the policy's initial state and memory.

    Raises FormulaTooLargeError and SpotMissingError (the formula's automaton is made again), and UncheckableError for
    a chain of more than MOST_STATES states, or a singular one.
    """
    automaton = translate(parse(policy.formula))
    chain = explore(world, policy, most=MOST_STATES)
    if not chain.whole:
        raise UncheckableError(f"the policy's Markov chain has more than {MOST_STATES} states, too many to check")
    ends = bottoms(chain, policy, automaton)
    accepted = automaton.accepting[chain.after] | ((ends.label >= 0) & ends.accepted[ends.label])
    sustaining = policy.sustaining(chain.state, chain.after)
    likely, error = _reach(chain, accepted, np.zeros(len(accepted)))
    decided = (chain.action == NOTHING) | sustaining
    if (_reach(chain, decided, np.zeros(len(decided)))[0] < 1 - SMALL).any():
        steps = np.inf
    else:
        steps = float(_reach(chain, decided, chain.cost, value=0.0)[0][0])
    sound = bool((likely[sustaining] >= 1 - SMALL).all())
    return Check(min(1.0, max(0.0, float(likely[0]))), steps, sound, len(chain.state), error)


def _reach(
    chain: Chain, targets: NDArray[np.bool_], cost: NDArray[np.float64], *, value: float = 1.0
) -> tuple[NDArray[np.float64], float]:
    """The expected cost until a target, where `value` is got, from every product state; with a bound of its error."""
    count = len(targets)
    graph: Any = sparse.csr_array((chain.probability, chain.target, chain.first), shape=(count, count))
    possible = targets
    while True:
        more = possible | (graph @ possible > 0)
        if (more == possible).all():
            break
        possible = more
    result = np.where(targets, value, 0.0)
    open_ = np.flatnonzero(possible & ~targets)
    if not len(open_):
        return result, 0.0
    rows = graph[open_]
    system = sparse.eye_array(len(open_), format="csc") - sparse.csc_array(rows[:, open_])
    right = cost[open_] + rows @ result
    try:
        solver = splu(system)
    except RuntimeError as error:
        raise UncheckableError(
            "the policy's Markov chain is too close to one that never ends to be evaluated"
        ) from error
    found = solver.solve(right)
    residual = float(np.abs(system @ found - right).max())
    longest = float(solver.solve(np.ones(len(open_))).max())
    result[open_] = found
    return result, residual * longest
