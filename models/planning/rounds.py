"""The shortest rounds in an end component: the most meetings of a mark per step, a long-run average.

Relative value iteration bounds it: with T the optimality operator and h any vector, the optimum of a component, which
is the same everywhere in it, lies between the least and the greatest of T h - h, and a policy that is greedy in h
attains at least the least of its own differences (Puterman, "Markov Decision Processes", 1994, 8.5 and 9.5.3; for model
checking Ashok, Chatterjee, Daca, Křetínský and Meggendorfer, "Value iteration for long-run average reward in Markov
decision processes", CAV 2017). Long rounds make it creep, so small components go on with policy iteration (Howard,
"Dynamic Programming and Markov Processes", 1960), whose values are put through the same inequality.
"""

from __future__ import annotations

from contextlib import suppress

import numpy as np
from numpy.typing import NDArray
from scipy import sparse
from scipy.sparse import csgraph
from scipy.sparse.linalg import splu

from models.planning.choices import Choices, Vector
from models.planning.kernels import sweeps
from models.planning.options import Options, Progress
from models.planning.ragged import spans
from models.planning.trend import Trend

DAMPING = 0.8
"""The share of a step in a sweep; less than one, so that iteration cannot oscillate on periodic components."""

PRECISION = 1e-9
"""Relative difference of the bounds of the rounds per step at which iteration stops."""

MAX_SWEEPS = 20_000
"""Most sweeps for one problem. A policy is right before they end; it may then not have the shortest rounds."""

DIRECT_AFTER = 1_000
"""Sweeps after which small components are solved directly. Iteration from 0 is the better where it gets there: of the
policies with the shortest rounds it finds one that loses nothing on the way to them either."""

DIRECT_LIMIT = 5_000
"""Nodes of a component up to which its linear systems are factorised."""

POLICIES = 100
"""Most improvements of a policy of one component."""

TIE = 1e-9
"""Difference of values within which the first choice is taken."""


def shortest_rounds(
    problem: Choices, group: NDArray[np.int32], *, options: Options, progress: Progress
) -> tuple[NDArray[np.float64], NDArray[np.int32]]:
    """Bounds of the expected steps of a round by group, [groups, 2], and the policy that attains the greater; infinite
    where iteration was cut short too early to tell.

    The constant of a choice of `problem` is its probability to meet the mark; `group` ([n]) is the component of each
    unknown, which no choice leaves.
    """
    count = int(group.max()) + 1
    h, low, high = _iterate(problem, group, count, options, progress)
    policy = np.empty(problem.unknowns, dtype=np.int32)
    sweeps.greedy(*problem.arrays, h, True, TIE, 1.0, policy)
    size = np.bincount(group, minlength=count)
    for one in np.flatnonzero((high - low > PRECISION * high) & (size <= DIRECT_LIMIT)).tolist():
        progress("rounds", DIRECT_AFTER, 1.0 / float(high[one]), np.inf, int(size[one]))
        places = np.flatnonzero(group == one).astype(np.int32)
        with suppress(RuntimeError):  # a singular system: what iteration found stays
            h[places], policy[places] = _improve(problem, places, policy[places])
    out, unused = np.empty(problem.unknowns), np.empty(count)
    sweeps.average(*problem.arrays, h, out, group, DAMPING, unused, high)
    chain = problem.only(policy)
    sweeps.average(*chain.arrays, h, out, group, DAMPING, low, unused)
    margin = problem.roundoff * (1.0 + float(np.abs(h).max()))
    rounds = np.stack([1.0 / np.minimum(high + margin, 1.0), _inverse(low - margin)], axis=1)
    return rounds, policy


def _inverse(rate: Vector) -> Vector:
    """Steps of a round; a round has one step at least."""
    with np.errstate(divide="ignore", invalid="ignore"):
        steps: Vector = np.where(rate > 0, np.maximum(1.0, 1.0 / rate), np.inf)
    return steps


def _iterate(
    problem: Choices, group: NDArray[np.int32], count: int, options: Options, progress: Progress
) -> tuple[Vector, Vector, Vector]:
    """Relative values, and the bounds of the rounds per step by group."""
    low, high = np.empty(count), np.empty(count)
    h, out = np.zeros(problem.unknowns), np.empty(problem.unknowns)
    small = bool((np.bincount(group) <= DIRECT_LIMIT).all())
    most = DIRECT_AFTER if small else MAX_SWEEPS
    trend = Trend(PRECISION, most=most)
    for sweep in options.sweeps("rounds", most=most):
        sweeps.average(*problem.arrays, h, out, group, DAMPING, low, high)
        least = float(low.min())
        left = trend.left(float((1.0 - low / high).max()))
        upper = 1.0 / least if least > 0 else np.inf
        progress("rounds", sweep, 1.0 / float(high.max()), upper, problem.unknowns, left)
        if (high - low <= PRECISION * high).all():
            break
        h, out = out, h
    return h, low, high


def _improve(
    problem: Choices, places: NDArray[np.int32], policy: NDArray[np.int32]
) -> tuple[Vector, NDArray[np.int32]]:
    """Policy iteration in one component (`places` [k]): its relative values and its policy."""
    local = np.full(problem.unknowns, -1, dtype=np.int32)
    local[places] = np.arange(len(places), dtype=np.int32)
    choices = spans(problem.first_choice, places)
    outcomes = spans(problem.first_outcome, choices)
    first = np.concatenate([[0], np.cumsum(np.diff(problem.first_outcome)[choices])])
    moves = sparse.csr_array(
        (problem.probability[outcomes], local[problem.successor[outcomes]], first), shape=(len(choices), len(places))
    )
    owner = np.repeat(np.arange(len(places)), np.diff(problem.first_choice)[places])
    reward = problem.constant[choices]
    chosen = np.searchsorted(choices, policy)
    start = np.concatenate([[0], np.cumsum(np.diff(problem.first_choice)[places])])[:-1]
    value = np.zeros(len(places))
    for _ in range(POLICIES):
        chosen = _one_class(moves, owner, reward, chosen)
        value = _evaluate(moves[chosen], reward[chosen])[1]
        worth = reward + moves @ value
        best = np.maximum.reduceat(worth, start)
        better = best > worth[chosen] + TIE * max(1.0, float(np.abs(value).max()))
        if not better.any():
            break
        top = np.flatnonzero(worth == best[owner])
        chosen = np.where(better, top[np.unique(owner[top], return_index=True)[1]], chosen)
    return value, choices[chosen].astype(np.int32)


def _one_class(
    moves: sparse.csr_array, owner: NDArray[np.intp], reward: Vector, chosen: NDArray[np.intp]
) -> NDArray[np.intp]:
    """The policy, led from everywhere into the recurrent class with the most rounds per step."""
    count = len(chosen)
    number, label = csgraph.connected_components(moves[chosen], directed=True, connection="strong")
    source = np.repeat(np.arange(count), np.diff(moves[chosen].indptr))
    target = moves[chosen].indices
    bottom = np.ones(number, dtype=np.bool_)
    bottom[label[source[label[source] != label[target]]]] = False
    classes = np.flatnonzero(bottom)
    if len(classes) == 1:
        return chosen
    gains = [
        _evaluate(moves[chosen[label == one]][:, label == one], reward[chosen[label == one]])[0] for one in classes
    ]
    inside = label == classes[int(np.argmax(gains))]
    way, towards = inside.copy(), chosen.copy()
    while not way.all():
        hits = np.flatnonzero((moves @ way > 0) & ~way[owner])
        nodes, first = np.unique(owner[hits], return_index=True)
        towards[nodes] = hits[first]
        way[nodes] = True
    return towards


def _evaluate(moves: sparse.csr_array, reward: Vector) -> tuple[float, Vector]:
    """Rounds per step and relative values (0 in the first node) of a chain of one recurrent class: h + g = r + P h."""
    count = moves.shape[0]
    system = sparse.lil_array(sparse.eye_array(count) - moves)
    system[:, [0]] = np.ones((count, 1))  # the place of h of the first node, which is 0, is that of g
    found = splu(sparse.csc_array(system)).solve(reward)
    gain = float(found[0])
    found[0] = 0.0
    return gain, found
