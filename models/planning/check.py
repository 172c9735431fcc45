"""A policy's claims, worked out again from nothing but the world, the policy's arrays and the formula.

The policy makes the world a Markov chain. Its runs end up in a bottom strongly connected component with probability
one and then see all of it for ever (Baier and Katoen, "Principles of Model Checking", 10.1.2), so a component is
accepted when the marks in it satisfy one of the automaton's pairs. Nothing of the product, the end components or the
iteration of `plan` is used.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy import sparse
from scipy.sparse import csgraph
from scipy.sparse.linalg import splu

from models.logic import Automaton, parse, translate
from models.planning.policy import NOTHING, Policy
from models.world import World

SMALL = 1e-9
"""How far below one the probability may be found, by rounding, where the policy says it only has to go on."""


@dataclass(frozen=True, slots=True)
class Check:
    """What the policy's Markov chain attains from its initial state.

    `sound`: wherever the policy says that the formula holds if it goes on for ever, its runs satisfy the formula with
    probability one. `expected_steps` is infinite when a run may stay undecided for ever. `error` bounds how far
    rounding may have moved the probability.
    """

    probability: float
    expected_steps: float
    sound: bool
    states: int  # product states that the policy may come to
    error: float


@dataclass(frozen=True, slots=True, eq=False)
class _Chain:
    state: NDArray[np.int64]  # [n]
    after: NDArray[np.int32]  # [n]  memory after reading the state
    source: NDArray[np.int64]  # [e]
    target: NDArray[np.int64]  # [e]
    probability: NDArray[np.float64]  # [e]
    ends: NDArray[np.bool_]  # [n]  nothing is done here any more


def check(world: World, policy: Policy) -> Check:
    """Evaluate `policy` in `world` from the policy's initial state and memory.

    Raises FormulaTooLargeError and SpotMissingError (the formula's automaton is made again).
    """
    automaton = translate(parse(policy.formula))
    chain = _explore(world, policy)
    accepted = _accepting(chain, policy, automaton)
    sustaining = policy.sustaining(chain.state, chain.after)
    likely, error = _reach(chain, accepted, np.zeros(len(accepted)))
    decided = chain.ends | sustaining
    if (_reach(chain, decided, np.zeros(len(decided)))[0] < 1 - SMALL).any():
        steps = np.inf
    else:
        steps = float(_reach(chain, decided, np.ones(len(decided)), value=0.0)[0][0])
    sound = bool((likely[sustaining] >= 1 - SMALL).all())
    return Check(float(likely[0]), steps, sound, len(chain.state), error)


def _explore(world: World, policy: Policy) -> _Chain:
    """The product states that the policy may come to, the initial one first."""
    state = np.array([policy.initial_state], dtype=np.int64)
    after = policy.after(state, np.array([policy.initial_memory]))
    key = state * policy.memories + after
    known = {int(key[0]): 0}
    states, afters, edges = [state], [after], []
    ends: list[NDArray[np.bool_]] = []
    first = 0
    while len(state):
        action = policy.acting(state, after)
        ends.append(action == NOTHING)
        source, target, probability = _move(world, state, action)
        memory = policy.after(target, after[source])
        keys = target * policy.memories + memory
        fresh = np.unique(keys)
        fresh = fresh[[int(k) not in known for k in fresh]]
        known.update(zip(fresh.tolist(), range(len(known), len(known) + len(fresh)), strict=True))
        number = np.array([known[int(k)] for k in keys], dtype=np.int64)
        edges.append((source + first, number, probability))
        first += len(state)
        state, after = fresh // policy.memories, (fresh % policy.memories).astype(np.int32)
        states.append(state)
        afters.append(after)
    source, target, probability = (np.concatenate(parts) for parts in zip(*edges, strict=True))
    return _Chain(np.concatenate(states), np.concatenate(afters), source, target, probability, np.concatenate(ends))


def _move(
    world: World, state: NDArray[np.int64], action: NDArray[np.int64]
) -> tuple[NDArray[np.int64], NDArray[np.int64], NDArray[np.float64]]:
    """Place of the source, state entered and probability of every outcome; WAIT stays."""
    waiting = np.flatnonzero((action < 0) & (action != NOTHING))
    found = [(waiting, state[waiting], np.ones(len(waiting)))]
    for number in np.unique(action[action >= 0]).tolist():
        places = np.flatnonzero(action == number)
        outcomes = world.outcomes(number, state[places])
        if not outcomes.enabled.all():
            raise AssertionError(f"the policy takes {world.actions[number]} where it is not possible")
        kind, place = np.nonzero(outcomes.probability)
        found.append((places[place], outcomes.successor[kind, place], outcomes.probability[kind, place]))
    source, target, probability = (np.concatenate(parts) for parts in zip(*found, strict=True))
    return source, target, probability


def _accepting(chain: _Chain, policy: Policy, automaton: Automaton) -> NDArray[np.bool_]:
    """Which product states are accepted, or in a bottom component that is."""
    accepted: NDArray[np.bool_] = automaton.accepting[chain.after]
    count = len(chain.state)
    graph = sparse.csr_array((np.ones(len(chain.source)), (chain.source, chain.target)), shape=(count, count))
    number, label = csgraph.connected_components(graph, directed=True, connection="strong")
    bottom = np.ones(number, dtype=np.bool_)
    bottom[label[chain.source[label[chain.source] != label[chain.target]]]] = False
    bottom[label[chain.ends]] = False
    marks = np.zeros(number, dtype=np.uint32)
    carried = automaton.marks[chain.after[chain.source], policy.letter[chain.state[chain.target]]]
    np.bitwise_or.at(marks, label[chain.source], carried)
    good = np.zeros(number, dtype=np.bool_)
    for pair in automaton.acceptance:
        good |= (marks & np.uint32(pair.finite) == 0) & (marks & np.uint32(pair.infinite) == pair.infinite)
    return accepted | (bottom & good)[label]


def _reach(
    chain: _Chain, targets: NDArray[np.bool_], cost: NDArray[np.float64], *, value: float = 1.0
) -> tuple[NDArray[np.float64], float]:
    """The expected cost until a target, where `value` is got, from every product state; with a bound of its error."""
    count = len(targets)
    graph = sparse.csr_array((chain.probability, (chain.source, chain.target)), shape=(count, count))
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
    inner = graph[open_][:, open_].tocsc()
    system = (sparse.eye_array(len(open_), format="csc") - inner).tocsc()
    right = cost[open_] + graph[open_] @ result
    solver = splu(system)
    found = solver.solve(right)
    residual = float(np.abs(system @ found - right).max())
    longest = float(solver.solve(np.ones(len(open_))).max())
    result[open_] = found
    return result, residual * longest
