"""What the runs of a policy come to: its Markov chain on listed transitions, and the cheapest path in a chain."""

from __future__ import annotations

import numpy as np

from models.planning.kernels import jit

BATCH = 256
"""Product states whose choices are looked up together: their reads from memory then overlap."""


@jit
def follow(policy, world, known, state, memory, choice, first, target, chance, ends, most, budget):
    """Go on with a breadth-first search through the product states that a policy may come to; returns how many outcomes
    it wrote.

    `policy`: the memory after reading a letter [Q, L], the letter of each state [S], the row of each memory [Q], -1 if
    it is decided, and what to do by row and state [R, S], -1 for nothing, -2 to wait. `world`: as listed, without
    costs. `known` [Q, S] becomes the number of each product state, by the memory after reading; it begins with -1. By
    number: `state`, `memory`, the `choice` that is taken, -1 for nothing, -2 to wait, -3 where the action is not
    possible, and where its outcomes begin (`first`) in all that was written. `target` and `chance` are these, from
    place 0 on in this call. `ends`: the next product state to look at, how many are known, and how many outcomes were
    written before.
    """
    after, letter, row, taken = policy
    first_choice, action, first_outcome, successor, probability = world
    head, tail, end = ends[0], ends[1], 0
    while head < tail and tail <= most and end < budget:
        batch = min(tail, head + BATCH)
        for number in range(head, batch):
            one = np.int64(taken[row[memory[number]], state[number]]) if row[memory[number]] >= 0 else np.int64(-1)
            if one >= 0:
                one = _choice_of(one, first_choice[state[number]], first_choice[state[number] + 1], action)
            choice[number] = one
        while head < batch and tail <= most and end < budget:
            here, read, one = state[head], memory[head], choice[head]
            first[head] = ends[2] + end
            head += 1
            begin = first_outcome[one] if one >= 0 else 0
            count = first_outcome[one + 1] - begin if one >= 0 else np.int64(one == -2)
            for place in range(begin, begin + count):
                entered = successor[place] if one >= 0 else here
                then = after[read, letter[entered]]
                if known[then, entered] < 0:
                    known[then, entered] = tail
                    state[tail], memory[tail] = entered, then
                    tail += 1
                target[end] = known[then, entered]
                chance[end] = probability[place] if one >= 0 else 1.0
                end += 1
    ends[0], ends[1], ends[2] = head, tail, ends[2] + end
    return end


@jit
def _choice_of(act, begin, end, action):
    if begin + act < end and action[begin + act] == act:
        return np.int64(begin + act)
    for one in range(begin, end):
        if action[one] == act:
            return np.int64(one)
    return np.int64(-3)


@jit
def cheapest_path(first, target, cost, start, ends):
    """The outcomes of a cheapest path from node `start` to one of the mask `ends`, the last one first, and the node it
    comes to, -1 if there is none; of equally cheap ends the one of the lowest number.

    Dijkstra, "A note on two problems in connexion with graphs" (1959), with a binary heap, until the first end.
    """
    distance = np.full(len(ends), np.inf)
    via = np.full(len(ends), -1, dtype=np.int64)
    before = np.full(len(ends), -1, dtype=np.int64)
    keys, nodes = np.empty(16), np.empty(16, dtype=np.int64)
    distance[start], keys[0], nodes[0], size = 0.0, 0.0, start, 1
    goal = -1
    while size > 0:
        key, node = keys[0], nodes[0]
        size -= 1
        _sink(keys, nodes, size, keys[size], nodes[size])
        if key > distance[node]:
            continue
        if ends[node]:
            goal = node
            break
        for outcome in range(first[node], first[node + 1]):
            entered, reached = target[outcome], key + cost[outcome]
            if reached >= distance[entered]:
                continue
            distance[entered], via[entered], before[entered] = reached, outcome, node
            if size == len(keys):
                keys, nodes = np.append(keys, np.empty(size)), np.append(nodes, np.empty(size, dtype=np.int64))
            _rise(keys, nodes, size, reached, entered)
            size += 1
    path = np.empty(len(ends), dtype=np.int64)
    length, node = 0, goal
    while node >= 0 and via[node] >= 0:
        path[length] = via[node]
        node = before[node]
        length += 1
    return path[:length].copy(), goal


@jit
def _sink(keys, nodes, size, key, node):
    """Put an entry in the place of the least of a heap of which `size` entries are left."""
    place = 0
    while 2 * place + 1 < size:
        child = 2 * place + 1
        if child + 1 < size and _less(keys, nodes, child + 1, keys[child], nodes[child]):
            child += 1
        if not _less(keys, nodes, child, key, node):
            break
        keys[place], nodes[place] = keys[child], nodes[child]
        place = child
    keys[place], nodes[place] = key, node


@jit
def _rise(keys, nodes, size, key, node):
    """Add an entry to a heap of `size`."""
    place = size
    while place > 0:
        above = (place - 1) // 2
        if _less(keys, nodes, above, key, node):
            break
        keys[place], nodes[place] = keys[above], nodes[above]
        place = above
    keys[place], nodes[place] = key, node


@jit
def _less(keys, nodes, place, key, node):
    return keys[place] < key or (keys[place] == key and nodes[place] < node)
