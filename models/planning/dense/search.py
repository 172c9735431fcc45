"""Compiled passes of the search for the states from which acceptance is possible, over the rows of a dense world.

`models.planning.dense` says what rows, entries and effects are.
"""

from __future__ import annotations

import numpy as np

from models.planning.kernels import jit

INFINITE = 2**30
"""Distance of what leads nowhere."""


@jit
def accept(world, valid, after, distance, altered):
    """Write distance 0 where reading a state's label makes the formula hold ([live, states], by memory before), and
    sweep 0 into `altered` [rows] where there are such.
    """
    n = world.length
    for row in range(len(world.first_part) - 1):
        for part in range(world.first_part[row], world.first_part[row + 1]):
            for memory in range(after.shape[0]):
                if after[memory, world.letter[part]] == -1:
                    for state in range(row * n + world.part_begin[part], row * n + world.part_end[part]):
                        if valid[state]:
                            distance[memory, state] = 0
                    altered[row] = 0


@jit
def all_reached(world, valid, after, distance):
    """Whether every valid state has a distance in every memory that its label does not decide."""
    n = world.length
    for row in range(len(world.first_part) - 1):
        for part in range(world.first_part[row], world.first_part[row + 1]):
            for memory in range(after.shape[0]):
                if after[memory, world.letter[part]] >= 0:
                    for state in range(row * n + world.part_begin[part], row * n + world.part_end[part]):
                        if valid[state] and distance[memory, state] >= INFINITE:
                            return False
    return True


@jit
def nearness(world, distance):
    """[rows] the sum of the distances of each row."""
    n = world.length
    rows = len(world.first_part) - 1
    total = np.zeros(rows, dtype=np.int64)
    for memory in range(distance.shape[0]):
        for row in range(rows):
            for j in range(row * n, row * n + n):
                if distance[memory, j] < INFINITE:
                    total[row] += distance[memory, j]
    return total


@jit
def begin_at(distance, least, value):
    """Write the distances at the least cost of a step into `value` ([live, states]), infinite where there is none."""
    for memory in range(distance.shape[0]):
        for state in range(distance.shape[1]):
            found = distance[memory, state]
            value[memory, state] = found * least if found < INFINITE else np.inf


@jit
def due(world, looked, changed, row):
    """Whether a row that this one leads to changed since this one was looked at, or then.

    Only who looks at a row writes its times. In a search a thread may miss what another one does in the same sweep; the
    row is then due in the next.
    """
    for one in range(world.first_input[row], world.first_input[row + 1]):
        if changed[world.input[one]] >= looked[row]:
            return True
    return False


@jit
def approach(world, effects, valid, after, distance, inside, sweep, looked, altered, begin_row, end_row):
    """Shorten the distances of a search in some rows: 1 + the least over choices of their nearest outcome.

    `distance` [live, states] is by memory before reading; only choices all of whose outcomes are `inside` ([live,
    states], or of length 0 for all) count. Sweeps alternate in direction; `looked` and `altered` [rows] are the sweeps
    in which a row was looked at and changed last, and rows that are not due are left out. Returns how many distances
    changed.
    """
    n = world.length
    states = (len(world.first_entry) - 1) * n
    flat, allowed, restricted = distance.reshape(-1), inside.reshape(-1), inside.shape[0] > 0
    first_outcome, shift = effects.first, effects.shift
    best = np.empty(n, dtype=np.int32)
    total = 0
    for step in range(end_row - begin_row):
        row = begin_row + step if sweep % 2 else end_row - 1 - step
        if not due(world, looked, altered, row):
            continue
        looked[row] = sweep
        base = row * n
        changed = 0
        for part in range(world.first_part[row], world.first_part[row + 1]):
            a, b = world.part_begin[part], world.part_end[part]
            for memory in range(after.shape[0]):
                then = after[memory, world.letter[part]]
                if then < 0:
                    continue
                best[a:b] = INFINITE
                for entry in range(world.first_entry[row], world.first_entry[row + 1]):
                    first, stop = first_outcome[world.effect[entry]], first_outcome[world.effect[entry] + 1]
                    begin = world.begin[entry]
                    while begin < world.end[entry]:
                        lo, hi = max(a, begin), min(b, begin + world.width[entry])
                        begin += world.stride[entry]
                        if lo >= hi:
                            continue
                        if restricted:
                            _nearest_inside(shift, first, stop, flat, allowed, then * states + base, lo, hi, best)
                        else:
                            _nearest(shift, first, stop, flat, then * states + base, lo, hi, best)
                at = np.uintp(memory * states + base)
                for j in range(np.uintp(a), np.uintp(b)):
                    found = best[j] + np.int32(1)
                    less = (found < flat[at + j]) & valid[np.uintp(base) + j]
                    flat[at + j] = found if less else flat[at + j]
                    changed += less
        if changed > 0:
            altered[row] = sweep
        total += changed
    return total


@jit
def _nearest(shift, first, stop, distance, entered, lo, hi, best):
    """Take the lesser of `best` and the distance of the nearest of the outcomes first .. stop - 1, for the states
    lo .. hi - 1 of the row whose distances of what is entered begin at `entered`.
    """
    for k in range(first, stop):
        at = np.uintp(entered + shift[k])
        for j in range(np.uintp(lo), np.uintp(hi)):
            found = distance[at + j]
            best[j] = found if found < best[j] else best[j]


@jit
def _nearest_inside(shift, first, stop, distance, inside, entered, lo, hi, best):
    """The same where no outcome leads out of `inside`."""
    for j in range(lo, hi):
        good = True
        for k in range(first, stop):
            good &= inside[entered + j + shift[k]]
        if good:
            for k in range(first, stop):
                best[j] = min(best[j], distance[entered + j + shift[k]])
