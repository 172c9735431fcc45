"""Sweeps over sparse choices: every kernel is one pass over the nodes, in place.

A node's new value is used by the nodes after it in the same sweep (Gauss-Seidel), and sweeps alternate in direction,
so that values travel along a chain in one sweep whichever way it is numbered. On one thread: a sweep waits for memory,
and its order decides the last bits, which must be the same for the same request.

Arrays as in `Choices`: `first` [n + 1] choices of a node, `constant` [c], `start` [c + 1] outcomes of a choice,
`successor` [e], `probability` [e]. Indices are unsigned, and what is best is selected, not branched to: a sweep is
three times as fast as one that looks for negative indices and guesses which choice is better.
"""

from __future__ import annotations

import numpy as np

from models.planning.kernels import jit


@jit
def narrow(first, constant, start, successor, probability, lower, upper, margin, backwards):
    """Improve lower and upper bounds of maximal values, rounded outwards; returns the greatest gap."""
    n = len(first) - 1
    gap = 0.0
    for step in range(n):
        node = n - 1 - step if backwards else step
        if upper[node] - lower[node] == 0.0:
            continue
        low, high = 0.0, 0.0
        for choice in range(first[node], first[node + 1]):
            a = b = constant[choice]
            for outcome in range(start[choice], start[choice + 1]):
                p, t = probability[outcome], successor[outcome]
                a += p * lower[t]
                b += p * upper[t]
            low, high = max(low, a), max(high, b)
        lower[node] = max(lower[node], low * (1.0 - margin))
        upper[node] = min(upper[node], high * (1.0 + margin))
        gap = max(gap, upper[node] - lower[node])
    return gap


@jit
def ascend(first, constant, start, successor, probability, lower, margin, policy):
    """Raise lower bounds of maximal values, rounded down, and take the choices that do; returns the greatest rise."""
    rise = 0.0
    for node in range(len(first) - 1):
        best, taken = lower[node], policy[node]
        for choice in range(first[node], first[node + 1]):
            worth = constant[choice]
            for outcome in range(start[choice], start[choice + 1]):
                worth += probability[outcome] * lower[successor[outcome]]
            worth *= 1.0 - margin
            taken = choice if worth > best else taken
            best = worth if worth > best else best
        policy[node] = taken
        rise = max(rise, best - lower[node])
        lower[node] = best
    return rise


@jit
def follow(policy, constant, start, successor, probability, lower, margin):
    """The same by the choices of a policy alone: what they are worth is a lower bound too."""
    rise = 0.0
    for node in range(len(policy)):
        choice = policy[node]
        worth = constant[choice]
        for outcome in range(start[choice], start[choice + 1]):
            worth += probability[outcome] * lower[successor[outcome]]
        best = max(worth * (1.0 - margin), lower[node])
        rise = max(rise, best - lower[node])
        lower[node] = best
    return rise


@jit
def cover(first, constant, start, successor, probability, upper, margin):
    """Replace candidates for upper bounds of maximal values, rounded up; returns how much one grew at most.

    Where none grew all are upper bounds: the pass is a monotone operator whose least fixed point are the values.
    """
    growth = 0.0
    for node in range(len(first) - 1):
        best = 0.0
        for choice in range(first[node], first[node + 1]):
            worth = constant[choice]
            for outcome in range(start[choice], start[choice + 1]):
                worth += probability[outcome] * upper[successor[outcome]]
            best = max(best, worth)
        best *= 1.0 + margin
        growth = max(growth, best - upper[node])
        upper[node] = best
    return growth


@jit
def improve(first, constant, start, successor, probability, x, policy):
    """Minimal values and the choices that have them, in the order of the nodes; returns the greatest change."""
    change = 0.0
    for node in range(len(first) - 1):
        best, taken = np.inf, policy[node]
        for choice in range(first[node], first[node + 1]):
            worth = constant[choice]
            for outcome in range(start[choice], start[choice + 1]):
                worth += probability[outcome] * x[successor[outcome]]
            taken = choice if worth < best else taken
            best = worth if worth < best else best
        policy[node] = taken
        change = max(change, abs(best - x[node]))
        x[node] = best
    return change


@jit
def greedy(first, constant, start, successor, probability, x, maximise, tie, least, policy):
    """Write the first choice of each node whose value is best up to `tie` · max(least, |best|) into `policy`.

    Returns the greatest excess of the value of a choice taken over `x`, and the greatest shortfall of the best one.
    """
    n = len(first) - 1
    worth = np.empty(0)
    above, below = -np.inf, -np.inf
    for node in range(n):
        count = first[node + 1] - first[node]
        if count > len(worth):
            worth = np.empty(2 * count)
        best = -np.inf if maximise else np.inf
        for place in range(count):
            choice = first[node] + place
            value = constant[choice]
            for outcome in range(start[choice], start[choice + 1]):
                value += probability[outcome] * x[successor[outcome]]
            worth[place] = value
            best = max(best, value) if maximise else min(best, value)
        below = max(below, x[node] - best)
        slack = tie * max(least, abs(best))
        for place in range(count):
            if (worth[place] >= best - slack) if maximise else (worth[place] <= best + slack):
                policy[node] = first[node] + place
                above = max(above, worth[place] - x[node])
                break
    return above, below


@jit
def settle(policy, constant, start, successor, probability, x, backwards):
    """One step of a policy's Markov chain; returns the greatest change."""
    n = len(policy)
    change = 0.0
    for step in range(n):
        node = n - 1 - step if backwards else step
        choice = policy[node]
        worth = constant[choice]
        for outcome in range(start[choice], start[choice + 1]):
            worth += probability[outcome] * x[successor[outcome]]
        change = max(change, abs(worth - x[node]))
        x[node] = worth
    return change


@jit
def advance(policy, constant, start, successor, probability, x, difference):
    """As `settle`; writes the `difference` of each value, and returns the greatest change and the sum of all."""
    change, total = 0.0, 0.0
    for node in range(len(policy)):
        choice = policy[node]
        worth = constant[choice]
        for outcome in range(start[choice], start[choice + 1]):
            worth += probability[outcome] * x[successor[outcome]]
        more = worth - x[node]
        difference[node] = more
        change = max(change, abs(more))
        total += abs(more)
        x[node] = worth
    return change, total


@jit
def average(first, constant, start, successor, probability, h, out, group, damping, low, high):
    """A damped sweep of relative values from `h` to `out`; `low` and `high` become the extremes of T h - h by group."""
    low[:] = np.inf
    high[:] = -np.inf
    for node in range(len(first) - 1):
        best = -np.inf
        for choice in range(first[node], first[node + 1]):
            worth = constant[choice]
            for outcome in range(start[choice], start[choice + 1]):
                worth += probability[outcome] * h[successor[outcome]]
            best = max(best, worth)
        g = group[node]
        low[g] = min(low[g], best - h[node])
        high[g] = max(high[g], best - h[node])
        out[node] = best
    for node in range(len(first) - 1):
        out[node] = h[node] + damping * (out[node] - h[node] - low[group[node]])
