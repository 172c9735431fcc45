"""Strongly connected components of what choices are allowed, without making a graph of them."""

from __future__ import annotations

import numpy as np

from models.planning.kernels import jit


@jit
def strong(nodes, first_choice, first_outcome, successor, allowed, label, index, low, stack, path, at, ends, budget):
    """Go on with the components of `nodes`, from which allowed choices lead only to each other; returns how many
    outcomes it looked at.

    Tarjan, "Depth-first search and linear graph algorithms" (1972), with a stack of its own: `path` [n] are the nodes
    that are open, `stack` [n] those without a component yet, `at` [n] the next outcome of an open node, and `index` [n]
    numbers the nodes in the order in which they are found, 0 for not yet. A node's `label` [n] becomes the first of its
    component that was found, -1 while it is on the stack. `ends`: the next of `nodes`, and how many are open, on the
    stack and found.
    """
    start, depth, height, found, looked = ends[0], ends[1], ends[2], ends[3], 0
    while looked < budget:
        if depth == 0:
            while start < len(nodes) and index[nodes[start]] > 0:
                start += 1
            if start == len(nodes):
                break
            entered = nodes[start]
        else:
            node = path[depth - 1]
            entered, seen = _next(node, first_choice, first_outcome, successor, allowed, label, index, low, at)
            looked += seen
        if entered >= 0:
            found += 1
            index[entered] = found
            low[entered] = found
            label[entered] = -1
            at[entered] = first_outcome[first_choice[entered]]
            stack[height] = entered
            path[depth] = entered
            height += 1
            depth += 1
            looked += 1
            continue
        depth -= 1
        if low[node] == index[node]:
            member = -1
            while member != node:
                height -= 1
                member = stack[height]
                label[member] = node
        if depth > 0:
            below = path[depth - 1]
            low[below] = min(low[below], low[node])
    ends[0], ends[1], ends[2], ends[3] = start, depth, height, found
    return looked


@jit
def _next(node, first_choice, first_outcome, successor, allowed, label, index, low, at):
    """The next node to enter from `node`, -1 for none, and how many outcomes were looked at."""
    lowest, outcome, begin = low[node], at[node], at[node]
    one = np.searchsorted(first_outcome[first_choice[node] : first_choice[node + 1]], outcome, "right") - 1
    one += first_choice[node]
    while one < first_choice[node + 1]:
        if not allowed[one]:
            one += 1
            outcome = first_outcome[one]
            continue
        while outcome < first_outcome[one + 1]:
            entered = successor[outcome]
            outcome += 1
            if index[entered] == 0:
                low[node], at[node] = lowest, outcome
                return entered, outcome - begin
            if label[entered] < 0:
                lowest = min(lowest, index[entered])
        one += 1
    low[node], at[node] = lowest, outcome
    return -1, outcome - begin


@jit
def leaving(nodes, first_choice, first_outcome, successor, allowed, label, broken):
    """The allowed choices of `nodes` that may leave their component; `broken` [n] is set for the labels of these."""
    found = np.empty(len(allowed), dtype=np.int32)
    count = 0
    for node in nodes:
        for one in range(first_choice[node], first_choice[node + 1]):
            if not allowed[one]:
                continue
            for outcome in range(first_outcome[one], first_outcome[one + 1]):
                if label[successor[outcome]] != label[node]:
                    found[count] = one
                    count += 1
                    broken[label[node]] = True
                    break
    return found[:count].copy()


@jit
def numbered(label, inside):
    """[n] the component of each node inside, numbered as they come up; -1 outside."""
    number = np.full(len(label), -1, dtype=np.int32)
    component = np.full(len(label), -1, dtype=np.int32)
    count = 0
    for node in range(len(label)):
        if inside[node]:
            if number[label[node]] < 0:
                number[label[node]] = count
                count += 1
            component[node] = number[label[node]]
    return component
