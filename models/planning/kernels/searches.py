"""Searches in a product by queues: backwards from targets, and the removal of nodes with all that depends on them.

`first` [n + 3] and `choice` [E] are the choices with an outcome in each node or column, `owner` [C] the node of each
choice. `ends` holds where a queue is read and where it ends.
"""

from __future__ import annotations

import numpy as np

from models.planning.kernels import jit

CROWDED = 4
"""A level with so many times fewer nodes than are left, or more, is searched from these."""


@jit
def turned_round(first_outcome, successor, size):
    """[size + 1] and [E]: for each of `size` successors the choices with an outcome there, ascending."""
    first = np.zeros(size + 2, dtype=np.int32)
    for outcome in range(len(successor)):
        first[successor[outcome] + 2] += 1
    for place in range(2, size + 2):
        first[place] += first[place - 1]
    choice = np.empty(len(successor), dtype=np.int32)
    for one in range(len(first_outcome) - 1):
        for outcome in range(first_outcome[one], first_outcome[one + 1]):
            place = successor[outcome] + 1
            choice[first[place]] = one
            first[place] += 1
    return first[: size + 1], choice


@jit
def search(first, choice, owner, allowed, queue, ends, distance, via, towards, budget):
    """Go on with a breadth-first search, at most to a crowded level; returns how many outcomes it looked at. No
    `allowed` means that all are.
    """
    head, tail, looked = ends[0], ends[1], 0
    level = distance[queue[head]]
    while head < tail and looked < budget:
        node = queue[head]
        if distance[node] > level:
            level += 1
            if (tail - head) * CROWDED > len(queue) - tail:
                break
        head += 1
        looked += 1 + first[node + 1] - first[node]
        for place in range(first[node], first[node + 1]):
            one = choice[place]
            before = owner[one]
            if distance[before] < 0 and (len(allowed) == 0 or allowed[one]):
                distance[before] = distance[node] + 1
                via[before] = one
                towards[before] = node
                queue[tail] = before
                tail += 1
    ends[0], ends[1] = head, tail
    return looked


@jit
def look_for(first_choice, first_outcome, successor, allowed, queue, ends, distance, via, towards):
    """The next level of a search, forwards from the nodes that are not reached yet; the whole level before it waits in
    the queue. Returns how many outcomes it looked at.
    """
    head, tail, looked = ends[0], ends[1], 0
    level = distance[queue[head]]
    nearest = distance == level
    for node in range(len(first_choice) - 1):
        if distance[node] >= 0:
            continue
        for one in range(first_choice[node], first_choice[node + 1]):
            if len(allowed) > 0 and not allowed[one]:
                continue
            for outcome in range(first_outcome[one], first_outcome[one + 1]):
                looked += 1
                if nearest[successor[outcome]]:
                    distance[node] = level + 1
                    via[node] = one
                    towards[node] = successor[outcome]
                    queue[tail] = node
                    tail += 1
                    break
            if distance[node] >= 0:
                break
    ends[0], ends[1] = ends[1], tail
    return looked


@jit
def by_distance(distance, queue):
    """The nodes of a `queue` that comes to them by distance: the nearest first, those of one distance ascending."""
    if len(queue) == 0:
        return queue
    first = np.zeros(distance[queue[-1]] + 2, dtype=np.int32)
    for place in range(len(queue)):
        first[distance[queue[place]] + 1] += 1
    for depth in range(1, len(first)):
        first[depth] += first[depth - 1]
    order = np.empty(len(queue), dtype=np.int32)
    for node in range(len(distance)):
        depth = distance[node]
        if depth >= 0:
            order[first[depth]] = node
            first[depth] += 1
    return order


@jit
def confine(first_choice, first_outcome, successor, inside, allowed, remaining):
    """Forbid the choices that may lead out, and those of nodes that are not `inside`; count the `remaining` of each."""
    for node in range(len(first_choice) - 1):
        for one in range(first_choice[node], first_choice[node + 1]):
            stays = allowed[one] and inside[node]
            if stays:
                for outcome in range(first_outcome[one], first_outcome[one + 1]):
                    stays &= inside[successor[outcome]]
            allowed[one] = stays
            remaining[node] += stays


@jit
def forbid(choices, owner, inside, allowed, remaining, queue, ends):
    """Forbid allowed `choices`; nodes left without one are taken out and wait in the queue."""
    for one in choices:
        node = owner[one]
        allowed[one] = False
        ends[2] -= 1
        remaining[node] -= 1
        if remaining[node] == 0 and inside[node]:
            inside[node] = False
            queue[ends[1]] = node
            ends[1] += 1


@jit
def prune(first, choice, owner, inside, allowed, remaining, queue, ends, forbidden, budget):
    """Forbid the choices that may lead to nodes in the queue, and take out, in turn, the nodes left without one.

    `ends` also holds how many choices are allowed, and how many were written to `forbidden`; returns how many outcomes
    it looked at.
    """
    head, tail, left, count, looked = ends[0], ends[1], ends[2], ends[3], 0
    while head < tail and looked < budget and left > 0:
        node = queue[head]
        head += 1
        looked += 1 + first[node + 1] - first[node]
        for place in range(first[node], first[node + 1]):
            one = choice[place]
            if not allowed[one]:
                continue
            allowed[one] = False
            left -= 1
            forbidden[count] = one
            count += 1
            before = owner[one]
            remaining[before] -= 1
            if remaining[before] == 0 and inside[before]:
                inside[before] = False
                queue[tail] = before
                tail += 1
    ends[0] = tail if left == 0 else head
    ends[1], ends[2], ends[3] = tail, left, count
    return looked


@jit
def cut(choices, owner, via, inside, detached, queue):
    """Detach the nodes inside whose way begins with one of `choices`; returns how many stand in the queue."""
    tail = 0
    for one in choices:
        node = owner[one]
        if via[node] == one and inside[node] and not detached[node]:
            detached[node] = True
            queue[tail] = node
            tail += 1
    return tail


@jit
def detach(first, choice, owner, via, towards, inside, detached, queue, ends, budget):
    """Detach the nodes whose way leads through those in the queue; returns how many outcomes it looked at."""
    head, tail, looked = ends[0], ends[1], 0
    while head < tail and looked < budget:
        node = queue[head]
        head += 1
        looked += 1 + first[node + 1] - first[node]
        for place in range(first[node], first[node + 1]):
            one = choice[place]
            before = owner[one]
            if via[before] == one and towards[before] == node and inside[before] and not detached[before]:
                detached[before] = True
                queue[tail] = before
                tail += 1
    ends[0], ends[1] = head, tail
    return looked


@jit
def rejoin(nodes, first_choice, first_outcome, successor, allowed, via, towards, detached, queue):
    """Give those of `nodes` a way that have an allowed choice into the others; returns how many stand in the queue."""
    tail = 0
    for node in nodes:
        for one in range(first_choice[node], first_choice[node + 1]):
            if not (allowed[one] and detached[node]):
                continue
            for outcome in range(first_outcome[one], first_outcome[one + 1]):
                if not detached[successor[outcome]]:
                    via[node], towards[node] = one, successor[outcome]
                    detached[node] = False
                    queue[tail] = node
                    tail += 1
                    break
    return tail


@jit
def spread(first, choice, owner, allowed, via, towards, detached, queue, ends, budget):
    """Give detached nodes a way through those in the queue; returns how many outcomes it looked at."""
    head, tail, looked = ends[0], ends[1], 0
    while head < tail and looked < budget:
        node = queue[head]
        head += 1
        looked += 1 + first[node + 1] - first[node]
        for place in range(first[node], first[node + 1]):
            one = choice[place]
            before = owner[one]
            if detached[before] and allowed[one]:
                via[before], towards[before] = one, node
                detached[before] = False
                queue[tail] = before
                tail += 1
    ends[0], ends[1] = head, tail
    return looked
