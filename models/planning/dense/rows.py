"""Compiled passes over the rows of a dense world. `models.planning.dense` says what rows, entries and effects are."""

from __future__ import annotations

import numpy as np

from models.planning.kernels import jit

SHORT = 8
"""States of an entry up to which the call of a function costs more than what it does."""

INFINITE = 2**30
"""Distance of what leads nowhere."""


@jit
def accept(world, after, distance):
    """Write distance 0 where reading a state's label makes the formula hold ([live, states], by memory before)."""
    n = world.length
    for row in range(len(world.first_part) - 1):
        for part in range(world.first_part[row], world.first_part[row + 1]):
            for memory in range(after.shape[0]):
                if after[memory, world.letter[part]] == -1:
                    distance[memory, row * n + world.part_begin[part] : row * n + world.part_end[part]] = 0


@jit
def all_reached(world, after, distance):
    """Whether every valid state has a distance in every memory that its label does not decide."""
    n = world.length
    for row in range(len(world.first_part) - 1):
        for part in range(world.first_part[row], world.first_part[row + 1]):
            for memory in range(after.shape[0]):
                if after[memory, world.letter[part]] >= 0:
                    for j in range(world.part_begin[part], world.part_end[part]):
                        if distance[memory, row * n + j] >= INFINITE:
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
def approach(world, effects, after, distance, inside, backwards, begin_row, end_row):
    """Shorten the distances of a search in some rows: 1 + the least over choices of their nearest outcome.

    `distance` [live, states] is by memory before reading; only choices all of whose outcomes are `inside` ([live,
    states], or of length 0 for all) count. Returns how many distances changed.
    """
    n = world.length
    rows = len(world.first_entry) - 1
    live = after.shape[0]
    restricted = inside.shape[0] > 0
    states = rows * n
    flat = distance.reshape(-1)
    best = np.empty(n, dtype=np.int32)
    changed = 0
    for step in range(end_row - begin_row):
        row = end_row - 1 - step if backwards else begin_row + step
        base = row * n
        for part in range(world.first_part[row], world.first_part[row + 1]):
            for memory in range(live):
                then = after[memory, world.letter[part]]
                if then < 0:
                    continue
                a, b = world.part_begin[part], world.part_end[part]
                best[a:b] = INFINITE
                for entry in range(world.first_entry[row], world.first_entry[row + 1]):
                    lo, hi = max(a, world.begin[entry]), min(b, world.end[entry])
                    if lo >= hi:
                        continue
                    effect = world.effect[entry]
                    first, stop = effects.first[effect], effects.first[effect + 1]
                    if restricted:
                        for j in range(lo, hi):
                            good = True
                            for k in range(first, stop):
                                good &= inside[then, base + j + effects.shift[k]]
                            if good:
                                for k in range(first, stop):
                                    best[j] = min(best[j], distance[then, base + j + effects.shift[k]])
                    else:
                        for k in range(first, stop):
                            at = np.uintp(then * states + base + effects.shift[k])
                            for j in range(np.uintp(lo), np.uintp(hi)):
                                found = flat[at + j]
                                best[j] = found if found < best[j] else best[j]
                at = np.uintp(memory * states + base)
                for j in range(np.uintp(a), np.uintp(b)):
                    found = best[j] + np.int32(1)
                    less = found < flat[at + j]
                    flat[at + j] = found if less else flat[at + j]
                    changed += less
    return changed


@jit
def begin_at(distance, least, value):
    """Write the distances at the least cost of a step into `value` ([live, states]), infinite where there is none."""
    for memory in range(distance.shape[0]):
        for state in range(distance.shape[1]):
            found = distance[memory, state]
            value[memory, state] = found * least if found < INFINITE else np.inf


@jit
def look_ahead(world, effects, after, value, cost, order, first, last, out):
    """What the rows order[first] .. order[last - 1] are worth after one step, into `out` [row, live, length].

    `value` is [live · states] by memory before reading, as is `out`; only what is undecided is written.
    """
    n = world.length
    live = after.shape[0]
    states = (len(world.first_entry) - 1) * n
    effect, begin, end = world.effect, world.begin, world.end
    first_outcome, probability, shift = effects.first, effects.probability, effects.shift
    for step in range(first, last):
        row = order[step]
        base = row * n
        for part in range(world.first_part[row], world.first_part[row + 1]):
            a, b = world.part_begin[part], world.part_end[part]
            for memory in range(live):
                then = after[memory, world.letter[part]]
                if then < 0:
                    continue
                best = out[step - first, memory]
                for j in range(np.uintp(a), np.uintp(b)):
                    best[j] = np.inf
                entered = then * states + base
                for entry in range(world.first_entry[row], world.first_entry[row + 1]):
                    lo, hi = max(a, begin[entry]), min(b, end[entry])
                    if hi - lo > SHORT:
                        lower(effect[entry], first_outcome, probability, shift, cost, value, entered, lo, hi, best)
                        continue
                    for j in range(np.uintp(lo), np.uintp(max(lo, hi))):
                        worth = cost[effect[entry]]
                        for k in range(first_outcome[effect[entry]], first_outcome[effect[entry] + 1]):
                            worth += probability[k] * value[np.uintp(entered + shift[k]) + j]
                        best[j] = worth if worth < best[j] else best[j]


@jit
def lift(world, after, value, order, first, last, found):
    """Raise the values of the rows order[first] .. order[last - 1] to what `look_ahead` found; infinite where none is.

    Returns the greatest rise.
    """
    n = world.length
    states = (len(world.first_entry) - 1) * n
    rise = 0.0
    for step in range(first, last):
        row = order[step]
        for part in range(world.first_part[row], world.first_part[row + 1]):
            a, b = np.uintp(world.part_begin[part]), np.uintp(world.part_end[part])
            for memory in range(after.shape[0]):
                if after[memory, world.letter[part]] < 0:
                    continue
                best = found[step - first, memory]
                at = np.uintp(memory * states + row * n)
                for j in range(a, b):
                    more = best[j] - value[at + j]
                    if more > 0.0 and best[j] < np.inf:
                        value[at + j] = best[j]
                        rise = more if more > rise else rise
    return rise


@jit
def lift_all(world, effects, after, value, cost, order):
    """Raise the values of all rows, one after the other; returns the greatest rise."""
    found = np.empty((1, after.shape[0], world.length), dtype=value.dtype)
    rise = 0.0
    for step in range(len(order)):
        look_ahead(world, effects, after, value, cost, order, step, step + 1, found)
        rise = max(rise, lift(world, after, value, order, step, step + 1, found))
    return rise


@jit
def lower(effect, first_outcome, probability, shift, cost, value, entered, lo, hi, best):
    """Take the lesser of `best` and what an effect is worth, for the states lo .. hi - 1 of the row whose values of
    what is entered begin at `entered`.

    Indices are unsigned: one that might be negative keeps the compiler from using vector instructions.
    """
    first, stop = first_outcome[effect], first_outcome[effect + 1]
    paid = cost[effect]
    begin, end = np.uintp(lo), np.uintp(hi)
    p = probability[first]
    x = np.uintp(entered + shift[first])
    if stop - first == 1:
        for j in range(begin, end):
            worth = paid + value[x + j]
            best[j] = worth if worth < best[j] else best[j]
        return
    q = probability[first + 1]
    y = np.uintp(entered + shift[first + 1])
    if stop - first == 2:
        for j in range(begin, end):
            worth = paid + p * value[x + j] + q * value[y + j]
            best[j] = worth if worth < best[j] else best[j]
        return
    r = probability[first + 2]
    z = np.uintp(entered + shift[first + 2])
    if stop - first == 3:
        for j in range(begin, end):
            worth = paid + p * value[x + j] + q * value[y + j] + r * value[z + j]
            best[j] = worth if worth < best[j] else best[j]
        return
    for j in range(begin, end):
        worth = paid + p * value[x + j] + q * value[y + j] + r * value[z + j]
        for k in range(first + 3, stop):
            worth += probability[k] * value[np.uintp(entered + shift[k]) + j]
        best[j] = worth if worth < best[j] else best[j]


@jit
def choose(world, effects, after, value, cost, tie, action, steps, first, last):
    """The first action of each undecided product state of the rows first .. last - 1 whose value is the least, but for
    a relative difference `tie` to the one that replaces it.

    `action` and `steps` ([live · states]) are by memory after reading; an action is -1 where the value is infinite and
    -2 where none is possible. Returns the greatest excess over `value` of what a choice is worth.
    """
    n = world.length
    rows = len(world.first_entry) - 1
    live = after.shape[0]
    states = rows * n
    excess = 0.0
    least = cost.min()
    worth = np.empty(n, dtype=value.dtype)
    for row in range(first, last):
        base = row * n
        for then in range(live):
            entered = then * states + base
            at = np.uintp(entered)
            for j in range(np.uintp(n)):
                action[at + j] = -1
                steps[at + j] = np.inf
            for entry in range(world.first_entry[row], world.first_entry[row + 1]):
                lo, hi = world.begin[entry], world.end[entry]
                effect = world.effect[entry]
                number = effects.action[effect] if effects.action[effect] >= 0 else -2
                for j in range(np.uintp(lo), np.uintp(hi)):
                    worth[j] = np.inf
                lower(effect, effects.first, effects.probability, effects.shift, cost, value, entered, lo, hi, worth)
                for j in range(np.uintp(lo), np.uintp(hi)):
                    slack = tie * worth[j] if worth[j] > least else tie * least
                    better = worth[j] + slack < steps[at + j]
                    action[at + j] = number if better else action[at + j]
                    steps[at + j] = worth[j] if better else steps[at + j]
        for part in range(world.first_part[row], world.first_part[row + 1]):
            for memory in range(live):
                then = after[memory, world.letter[part]]
                if then < 0:
                    continue
                at, before = np.uintp(then * states + base), np.uintp(memory * states + base)
                for j in range(np.uintp(world.part_begin[part]), np.uintp(world.part_end[part])):
                    if steps[at + j] < np.inf:
                        more = steps[at + j] - value[before + j]
                        excess = more if more > excess else excess
        for then in range(live):
            at = np.uintp(then * states + base)
            for j in range(np.uintp(n)):
                steps[at + j] = steps[at + j] if steps[at + j] < np.inf else 0.0
    return excess
