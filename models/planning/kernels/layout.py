"""Choices and outcomes copied from one numbering into another, in one pass each."""

from __future__ import annotations

import numpy as np

from models.planning.kernels import jit


@jit
def number_nodes(next_memory, valid, live, column, node):
    """Number the pairs [Q, S] of a memory to be iterated and a state that may be entered with it, by memory and then
    by state, to `node`; the numbers after these are for pairs that are decided: `column` [Q] of them. Returns how many
    are numbered.
    """
    memories, states = next_memory.shape
    entered = np.zeros((memories, states), dtype=np.bool_)
    for memory in range(memories):
        for state in range(states):
            if valid[state]:
                entered[next_memory[memory, state], state] = True
    count = 0
    for memory in range(memories):
        for state in range(states):
            node[memory, state] = -1
            if live[memory] and entered[memory, state]:
                node[memory, state] = count
                count += 1
    for memory in range(memories):
        for state in range(states):
            if node[memory, state] < 0:
                node[memory, state] = count + column[memory]
    return count


@jit
def room(rows, first_choice, first_outcome, first, at):
    """Write where the choices of each of `rows` will begin to `first`, from `at` on; returns how many outcomes they
    have.
    """
    place, outcomes = first[at], 0
    for k in range(len(rows)):
        row = rows[k]
        first[at + k] = place
        place += first_choice[row + 1] - first_choice[row]
        outcomes += first_outcome[first_choice[row + 1]] - first_outcome[first_choice[row]]
    first[at + len(rows)] = place
    return outcomes


@jit
def copy(rows, entered, first_choice, action, cost, first_outcome, successor, probability, at, out):
    """Copy the choices of `rows` with their successors renamed by `entered`; `at` are the choice and the outcome from
    which on they are written to `out`, the same arrays but for the first.
    """
    place, end = at[0], at[1]
    new_action, new_cost, new_first, new_successor, new_probability = out
    for row in rows:
        for one in range(first_choice[row], first_choice[row + 1]):
            new_action[place], new_cost[place] = action[one], cost[one]
            for outcome in range(first_outcome[one], first_outcome[one + 1]):
                new_successor[end] = entered[successor[outcome]]
                new_probability[end] = probability[outcome]
                end += 1
            place += 1
            new_first[place] = end
    at[0], at[1] = place, end


@jit
def carry(rows, carried, wanted, first_choice, first_outcome, successor, probability, at, marks, meets):
    """The marks that outcomes of the choices of `rows` carry, from choice `at` on, and the probability to meet each of
    `wanted` [k], to `meets` [k, C]; `carried` are the marks of entering a state.
    Returns the choice after the last.
    """
    for row in rows:
        for one in range(first_choice[row], first_choice[row + 1]):
            for outcome in range(first_outcome[one], first_outcome[one + 1]):
                bits = carried[successor[outcome]]
                marks[at] |= bits
                for k in range(len(wanted)):
                    if bits & wanted[k]:
                        meets[k, at] += probability[outcome]
            at += 1
    return at


@jit
def sort_choices(first_choice, kept, unknown, count):
    """The choices `kept` of nodes that are an unknown, by unknown and then ascending, and where each of the `count`
    unknowns has its own.
    """
    first = np.zeros(count + 2, dtype=np.int32)
    for node in range(len(first_choice) - 1):
        if unknown[node] >= 0:
            for one in range(first_choice[node], first_choice[node + 1]):
                first[unknown[node] + 2] += kept[one]
    for place in range(2, count + 2):
        first[place] += first[place - 1]
    rows = np.empty(first[count + 1], dtype=np.int32)
    for node in range(len(first_choice) - 1):
        place = unknown[node] + 1
        if place > 0:
            for one in range(first_choice[node], first_choice[node + 1]):
                if kept[one]:
                    rows[first[place]] = one
                    first[place] += 1
    return rows, first[: count + 1]


@jit
def gather(rows, first_outcome, successor, probability, unknown, known, constant, first, targets, chances):
    """The outcomes of `rows` whose value is not known, to `targets` and `chances`, where row k has those from first[k]
    on; what the others are worth is added to `constant`. Returns the most outcomes of a row that are known.
    """
    end, most = 0, 0
    for k in range(len(rows)):
        first[k] = end
        share, count = 0.0, 0
        for outcome in range(first_outcome[rows[k]], first_outcome[rows[k] + 1]):
            node, chance = successor[outcome], probability[outcome]
            target = unknown[node]
            targets[end], chances[end] = target, chance  # the next one is written over what is known
            end += target >= 0
            if target < 0:
                share += chance * known[node]
                count += 1
        constant[k] += share
        most = max(most, count)
    first[len(rows)] = end
    return most


@jit
def keep(first_choice, first_outcome, successor, probability, nodes, value, slack, kept):
    """Keep the choices of the mask `nodes` that are worth at least the `value` of their node, up to `slack`."""
    for node in range(len(first_choice) - 1):
        if not nodes[node]:
            continue
        for one in range(first_choice[node], first_choice[node + 1]):
            worth = 0.0
            for outcome in range(first_outcome[one], first_outcome[one + 1]):
                worth += probability[outcome] * value[successor[outcome]]
            kept[one] = worth >= value[node] - slack


@jit
def number_unknowns(order, maybe, component, unknown):
    """Number the nodes of `order` that are in the mask `maybe`, in that order, one number for a `component`; returns
    how many numbers there are.
    """
    number = np.full(len(component), -1, dtype=np.int32)
    count = 0
    for node in order:
        if not maybe[node]:
            continue
        if component[node] >= 0:
            if number[component[node]] < 0:
                number[component[node]] = count
                count += 1
            unknown[node] = number[component[node]]
        else:
            unknown[node] = count
            count += 1
    return count
