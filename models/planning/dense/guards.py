"""Where in a row ranges hold. What they depend on is noted, since for most rows it is as in the row before."""

from __future__ import annotations

import numpy as np

from models.planning.kernels import jit


@jit
def note(tables, group, digits, total, place, stale):
    """Note what the ranges of a group depend on in the row of these digits: in `total` [R] the sum of a range's tables
    that do not read the variables of the row, in `place` [T] where the values of the others begin.

    `stale` [groups] becomes true where that is not as before. Returns False if some range holds nowhere in the row,
    whatever the others do; what comes after it is then not noted.
    """
    for one in range(tables.group[group], tables.group[group + 1]):
        found = 0
        table = tables.table[one]
        stop = tables.table[one + 1]
        while table < stop and not tables.inner[table]:
            found += tables.data[_place(tables, table, digits)]
            table += 1
        if table == stop:
            if found < tables.low[one] or found > tables.high[one]:
                return False
            continue
        if total[one] != found:
            total[one] = found
            stale[group] = True
        for inner in range(table, stop):
            found = _place(tables, inner, digits)
            if place[inner] != found:
                place[inner] = found
                stale[group] = True
    return True


@jit
def _place(tables, table, digits):
    """Where a table's value for the digits of a row is, or its values begin."""
    place = tables.offset[table]
    for read in range(tables.reads[table], tables.reads[table + 1]):
        place += tables.multiplier[read] * digits[tables.variable[read]]
    return place


@jit
def restrict(tables, group, total, place, mask, sums):
    """Take out of `mask` the states of a row in which some range of the group does not hold, by what was noted."""
    n = np.uintp(len(mask))
    for one in range(tables.group[group], tables.group[group + 1]):
        stop = tables.table[one + 1]
        table = tables.table[one]
        while table < stop and not tables.inner[table]:
            table += 1
        if table == stop:
            continue
        low, high = np.int32(tables.low[one] - total[one]), np.int32(tables.high[one] - total[one])
        if stop - table == 1:
            at = np.uintp(place[table])
            for j in range(n):
                found = np.int32(tables.data[at + j])
                mask[j] = mask[j] & (low <= found) & (found <= high)
        else:
            sums[:] = 0
            for inner in range(table, stop):
                at = np.uintp(place[inner])
                for j in range(n):
                    sums[j] += np.int32(tables.data[at + j])
            for j in range(n):
                mask[j] = mask[j] & (low <= sums[j]) & (sums[j] <= high)
