"""From the tables of a world to its rows: which effects are possible where, and where labels change."""

from __future__ import annotations

import numpy as np

from models.planning.kernels import jit


@jit
def compress(tables, effects, n, rows, start):
    """The entries of `rows` rows of `n` states, the first of which is row `start`, and the parts in which states are
    valid.

    Returns `first_entry` [rows + 1], `effect`, `begin`, `end` (by entry), and `valid` [rows * n].
    """
    variables = len(tables.radix)
    actions = len(tables.scope_inner)
    digits = np.zeros(variables, dtype=np.int64)
    rest = start
    for v in range(variables - 1, -1, -1):
        digits[v] = rest % tables.radix[v]
        rest //= tables.radix[v]
    first = np.zeros(rows + 1, dtype=np.int64)
    capacity = max(16, rows * 4)
    effect = np.empty(capacity, dtype=np.int32)
    begin = np.empty(capacity, dtype=np.int32)
    end = np.empty(capacity, dtype=np.int32)
    valid = np.zeros(rows * n, dtype=np.bool_)
    allowed = np.empty(n, dtype=np.bool_)
    mask = np.empty(n, dtype=np.bool_)
    acting = np.empty(n, dtype=np.bool_)
    sums = np.empty(n, dtype=np.int32)
    stay = len(effects.action) - 1
    count = 0
    for row in range(rows):
        if row > 0:
            v = variables - 1
            while v >= 0:
                digits[v] += 1
                if digits[v] < tables.radix[v]:
                    break
                digits[v] = 0
                v -= 1
        allowed[:] = True
        if holds(tables, 0, digits, n, allowed, sums):
            valid[row * n : (row + 1) * n] = allowed
            acting[:] = False
            if count + (actions + 2) * n > capacity:
                capacity = 2 * capacity + (actions + 2) * n
                effect, begin, end = _grown(effect, capacity), _grown(begin, capacity), _grown(end, capacity)
            for action in range(actions):
                mask[:] = allowed
                if not holds(tables, action + 1, digits, n, mask, sums):
                    continue
                base = tables.first_effect[action]
                for place in range(tables.scope[action], tables.scope[action + 1]):
                    base += tables.scope_multiplier[place] * digits[tables.scope_variable[place]]
                each = tables.scope_inner[action]
                last = -1
                for j in range(n):
                    if mask[j]:
                        acting[j] = True
                        one = base + tables.place_effect[action, j] if each else base
                        if last == j and effect[count - 1] == one:
                            end[count - 1] = j + 1
                        else:
                            effect[count], begin[count], end[count] = one, j, j + 1
                            count += 1
                        last = j + 1
            last = -1
            for j in range(n):
                if allowed[j] and not acting[j]:
                    if last == j:
                        end[count - 1] = j + 1
                    else:
                        effect[count], begin[count], end[count] = stay, j, j + 1
                        count += 1
                    last = j + 1
        first[row + 1] = count
    return first, effect[:count].copy(), begin[:count].copy(), end[:count].copy(), valid


@jit
def _grown(array, capacity):
    larger = np.empty(capacity, dtype=array.dtype)
    larger[: len(array)] = array
    return larger


@jit
def holds(tables, group, digits, n, mask, sums):
    """Take out of `mask` the states of a row in which some range of the group does not hold; whether any is left."""
    for one in range(tables.group[group], tables.group[group + 1]):
        total = 0
        table = tables.table[one]
        stop = tables.table[one + 1]
        while table < stop and not tables.inner[table]:
            total += tables.data[_place(tables, table, digits)]
            table += 1
        low, high = np.int32(tables.low[one] - total), np.int32(tables.high[one] - total)
        if table == stop:
            if low > 0 or high < 0:
                return False
            continue
        if stop - table == 1:
            place = np.uintp(_place(tables, table, digits))
            for j in range(np.uintp(n)):
                found = np.int32(tables.data[place + j])
                mask[j] = mask[j] & (low <= found) & (found <= high)
        else:
            sums[:] = 0
            for inner in range(table, stop):
                place = np.uintp(_place(tables, inner, digits))
                for j in range(np.uintp(n)):
                    sums[j] += np.int32(tables.data[place + j])
            for j in range(np.uintp(n)):
                mask[j] = mask[j] & (low <= sums[j]) & (sums[j] <= high)
        if not mask.any():
            return False
    return True


@jit
def _place(tables, table, digits):
    """Where a table's value for the digits of a row is, or its values begin."""
    place = tables.offset[table]
    for read in range(tables.reads[table], tables.reads[table + 1]):
        place += tables.multiplier[read] * digits[tables.variable[read]]
    return place


@jit
def split(letter, valid, n, rows):
    """Cut the valid states of each row where the letter changes.

    Returns `first_part` [rows + 1] and by part `begin`, `end` and `letter` (int32).
    """
    first = np.zeros(rows + 1, dtype=np.int64)
    count = 0
    for row in range(rows):
        last = -1
        for j in range(n):
            at = row * n + j
            if valid[at]:
                if last != j or letter[at] != letter[at - 1]:
                    count += 1
                last = j + 1
        first[row + 1] = count
    begin = np.empty(count, dtype=np.int32)
    end = np.empty(count, dtype=np.int32)
    read = np.empty(count, dtype=np.int32)
    for row in range(rows):
        part = first[row] - 1
        last = -1
        for j in range(n):
            at = row * n + j
            if valid[at]:
                if last == j and letter[at] == letter[at - 1]:
                    end[part] = j + 1
                else:
                    part += 1
                    begin[part], end[part], read[part] = j, j + 1, letter[at]
                last = j + 1
    return first, begin, end, read
