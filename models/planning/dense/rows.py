"""Compiled sweeps over the rows of a dense world. `models.planning.dense` says what rows, entries and effects are."""

from __future__ import annotations

import numpy as np

from models.planning.dense.search import due
from models.planning.kernels import jit

SHORT = 8
"""States of a run up to which the call of a function costs more than what it does."""


@jit
def sweep(world, effects, after, value, residual, order, group, repeats, looked, rose, tick, first, last):
    """Raise the values of the groups first .. last - 1, one after the other and each up to `repeats` times: what lower
    bounds of least costs are worth one step later are lower bounds too. Returns how many times one rose by more than
    `residual`.

    `value` is [live · states] by memory before reading; order[group[g]] .. order[group[g + 1] - 1] are the rows of
    group g. A row is left out unless one that it leads to rose by more since it was looked at: `looked` and `rose`
    [rows] tell when that was, in ticks, of which this begins with `tick`.
    """
    found = np.empty((after.shape[0], world.length), dtype=value.dtype)
    total = 0
    for one in range(first, last):
        now = tick + repeats * group[one]
        for _ in range(repeats):
            rising = 0
            for step in range(group[one], group[one + 1]):
                row = order[step]
                if due(world, looked, rose, row):
                    look_ahead(world, effects, after, value, row, found)
                    rises = lift(world, after, value, residual, row, found)
                    looked[row] = now
                    if rises > 0:
                        rose[row] = now
                    rising += rises
                now += 1
            total += rising
            if rising == 0:
                break
    return total


@jit
def look_ahead(world, effects, after, value, row, out):
    """What the states of a row are worth after one step, into `out` [live, length] by memory before reading; only what
    is undecided is written.
    """
    base = row * world.length
    states = (len(world.first_entry) - 1) * world.length
    effect, entry_begin, entry_end, width, stride = world.effect, world.begin, world.end, world.width, world.stride
    cost, first_outcome, probability, shift = effects.cost, effects.first, effects.probability, effects.shift
    for part in range(world.first_part[row], world.first_part[row + 1]):
        a, b = world.part_begin[part], world.part_end[part]
        for memory in range(after.shape[0]):
            then = after[memory, world.letter[part]]
            if then < 0:
                continue
            best = out[memory]
            for j in range(np.uintp(a), np.uintp(b)):
                best[j] = np.inf
            entered = then * states + base
            for entry in range(world.first_entry[row], world.first_entry[row + 1]):
                doing, begin = effect[entry], entry_begin[entry]
                while begin < entry_end[entry]:
                    lo, hi = max(a, begin), min(b, begin + width[entry])
                    begin += stride[entry]
                    if hi - lo > SHORT:
                        lower(doing, first_outcome, probability, shift, cost, value, entered, lo, hi, best)
                        continue
                    for j in range(np.uintp(lo), np.uintp(max(lo, hi))):
                        worth = cost[doing]
                        for k in range(first_outcome[doing], first_outcome[doing + 1]):
                            worth += probability[k] * value[np.uintp(entered + shift[k]) + j]
                        best[j] = worth if worth < best[j] else best[j]


@jit
def lift(world, after, value, residual, row, found):
    """Raise the values of a row to what `look_ahead` found; infinite where none is.

    Returns how many rise by more than `residual`: to count them, unlike to find the greatest rise, takes vector
    instructions.
    """
    states = (len(world.first_entry) - 1) * world.length
    count = 0
    for part in range(world.first_part[row], world.first_part[row + 1]):
        for memory in range(after.shape[0]):
            if after[memory, world.letter[part]] < 0:
                continue
            best = found[memory]
            at = np.uintp(memory * states + row * world.length)
            for j in range(np.uintp(world.part_begin[part]), np.uintp(world.part_end[part])):
                old, new = value[at + j], best[j]
                rises = (new > old) & (new < np.inf)
                value[at + j] = new if rises else old
                count += rises & (new - old > residual)
    return count


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
def choose(world, effects, valid, after, value, tie, action, steps, first, last):
    """The first action of each undecided product state of the rows first .. last - 1 whose value is the least, but for
    a relative difference `tie` to the one that replaces it.

    `action` and `steps` ([live · states]) are by memory after reading; an action is -1 where the value is infinite and
    -2 where none is possible. Returns the greatest excess over `value` of what a choice is worth.
    """
    n = world.length
    states = (len(world.first_entry) - 1) * n
    excess = 0.0
    cost, first_outcome, probability, shift = effects.cost, effects.first, effects.probability, effects.shift
    least = cost.min()
    worth = np.empty(n, dtype=value.dtype)
    for row in range(first, last):
        base = row * n
        for then in range(after.shape[0]):
            at = then * states + base
            doing, paid = action[at : at + n], steps[at : at + n]
            doing[:] = -1
            paid[:] = np.inf
            for entry in range(world.first_entry[row], world.first_entry[row + 1]):
                effect, begin = world.effect[entry], world.begin[entry]
                while begin < world.end[entry]:
                    end = begin + world.width[entry]
                    for j in range(np.uintp(begin), np.uintp(end)):
                        worth[j] = np.inf
                    lower(effect, first_outcome, probability, shift, cost, value, at, begin, end, worth)
                    prefer(effects.action[effect], worth, tie, least, begin, end, doing, paid)
                    begin += world.stride[entry]
            for j in range(n):
                if not valid[base + j]:
                    doing[j], paid[j] = -1, np.inf
        excess = max(excess, exceeding(world, after, value, steps, row))
        for then in range(after.shape[0]):
            at = np.uintp(then * states + base)
            for j in range(np.uintp(n)):
                steps[at + j] = steps[at + j] if steps[at + j] < np.inf else 0.0
    return excess


@jit
def prefer(number, worth, tie, least, begin, end, doing, paid):
    """Do action `number` where it is worth less than what is done, by more than a relative difference `tie`."""
    number = number if number >= 0 else -2
    for j in range(np.uintp(begin), np.uintp(end)):
        slack = tie * worth[j] if worth[j] > least else tie * least
        better = worth[j] + slack < paid[j]
        doing[j] = number if better else doing[j]
        paid[j] = worth[j] if better else paid[j]


@jit
def exceeding(world, after, value, steps, row):
    """The greatest excess of `steps`, by memory after reading, over `value`, by memory before, in a row."""
    n = world.length
    states = (len(world.first_entry) - 1) * n
    excess = 0.0
    for part in range(world.first_part[row], world.first_part[row + 1]):
        for memory in range(after.shape[0]):
            then = after[memory, world.letter[part]]
            if then < 0:
                continue
            at, before = np.uintp(then * states + row * n), np.uintp(memory * states + row * n)
            for j in range(np.uintp(world.part_begin[part]), np.uintp(world.part_end[part])):
                if steps[at + j] < np.inf:
                    more = steps[at + j] - value[before + j]
                    excess = more if more > excess else excess
    return excess
