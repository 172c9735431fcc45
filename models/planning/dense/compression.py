"""From the tables of a world to its rows: which effects are possible where, and where labels change."""

from __future__ import annotations

import numpy as np

from models.planning.dense.guards import note, restrict
from models.planning.kernels import jit

EFFECT, BEGIN, END, WIDTH, STRIDE = range(5)
"""What an entry consists of: see `models.planning.dense.compressed.Rows`."""


@jit
def compress(tables, effects, n, rows, start):
    """The entries of `rows` rows of `n` states, the first of which is row `start`, and which of their states are valid.

    Returns `first_entry` [rows + 1], the entries [5, ..], and `valid` [rows * n].
    """
    actions = len(tables.scope_inner)
    digits = _digits(tables.radix, start)
    total = np.zeros(len(tables.low), dtype=np.int64)
    place = np.zeros(len(tables.inner), dtype=np.int64)
    stale = np.ones(actions + 1, dtype=np.bool_)
    mask = np.zeros((actions + 1, n), dtype=np.bool_)  # of group 0 the valid states, of the others where they can act
    known = np.zeros((actions + 1, 3), dtype=np.int64)  # first entry, last, and base of the effects when last made
    sums = np.empty(n, dtype=np.int32)
    latest = np.full(len(effects.action), -1, dtype=np.int64)
    first = np.zeros(rows + 1, dtype=np.int64)
    valid = np.zeros(rows * n, dtype=np.bool_)
    entries = np.empty((5, max(16, rows * 4)), dtype=np.int32)
    stay = len(effects.action) - 1
    same = np.zeros(n, dtype=np.int32)
    count = 0
    for row in range(rows):
        if row > 0:
            _advance(digits, tables.radix)
        first[row + 1] = count
        if not note(tables, 0, digits, total, place, stale):
            continue
        if stale[0]:
            mask[0] = True
            restrict(tables, 0, total, place, mask[0], sums)
            stale[:] = True
            stale[0] = False
        if not mask[0].any():
            continue
        valid[row * n : (row + 1) * n] = mask[0]
        if count + (actions + 1) * n > entries.shape[1]:
            entries = _grown(entries, 2 * entries.shape[1] + (actions + 1) * n)
        idle = mask[0].copy()
        for action in range(actions):
            group = action + 1
            if not note(tables, group, digits, total, place, stale):
                continue
            base = tables.first_effect[action]
            for one in range(tables.scope[action], tables.scope[action + 1]):
                base += tables.scope_multiplier[one] * digits[tables.scope_variable[one]]
            begin = count
            if stale[group]:
                mask[group] = mask[0]
                restrict(tables, group, total, place, mask[group], sums)
                count = _cover(mask[group], mask[0], tables.place_effect[action], base, entries, count, latest)
                stale[group] = False
            else:
                count = _repeat(entries, known[group], base, count)
            known[group, 0], known[group, 1], known[group, 2] = begin, count, base
            for j in range(np.uintp(n)):
                idle[j] = idle[j] & ~mask[group, j]
        if idle.any():
            count = _cover(idle, mask[0], same, stay, entries, count, latest)
        first[row + 1] = count
    return first, entries[:, :count].copy(), valid


@jit
def _digits(radix, number):
    digits = np.zeros(len(radix), dtype=np.int64)
    for v in range(len(radix) - 1, -1, -1):
        digits[v] = number % radix[v]
        number //= radix[v]
    return digits


@jit
def _advance(digits, radix):
    """The digits of the number that comes next."""
    v = len(radix) - 1
    while v >= 0:
        digits[v] += 1
        if digits[v] < radix[v]:
            return
        digits[v] = 0
        v -= 1


@jit
def _grown(entries, capacity):
    larger = np.empty((5, capacity), dtype=entries.dtype)
    larger[:, : entries.shape[1]] = entries
    return larger


@jit
def _repeat(entries, known, base, count):
    """Append entries that were made before, with effects counted from another base; returns how many there are."""
    for entry in range(known[0], known[1]):
        entries[EFFECT, count] = entries[EFFECT, entry] + base - known[2]
        for part in range(BEGIN, STRIDE + 1):
            entries[part, count] = entries[part, entry]
        count += 1
    return count


@jit
def _cover(mask, valid, effect, base, entries, count, latest):
    """Append entries for the states of `mask`, whose effects are base + `effect`; returns how many there are.

    A run goes on over states that are not valid, as nobody asks what is possible there; there is always a state of the
    mask after them, so that no index leaves the world. `latest` has the last entry of each effect.
    """
    first = count
    begin, end = -1, -1
    for j in range(len(mask)):
        if mask[j] and begin >= 0 and effect[j] == effect[begin]:
            end = j + 1
        elif valid[j]:
            if begin >= 0:
                count = _add(entries, count, first, latest, base + effect[begin], begin, end, valid)
            begin = j if mask[j] else -1
            end = j + 1
    if begin >= 0:
        count = _add(entries, count, first, latest, base + effect[begin], begin, end, valid)
    return count


@jit
def _add(entries, count, first, latest, effect, begin, end, valid):
    """Append a run, to the latest entry of its effect from `first` on where it fits in there."""
    entry = latest[effect]
    if entry >= first and _fits(entries[:, entry], begin, end, valid):
        if entries[STRIDE, entry] == entries[WIDTH, entry]:
            entries[STRIDE, entry] = begin - entries[BEGIN, entry]
        entries[END, entry] = end
        return count
    latest[effect] = count
    entries[EFFECT, count] = effect
    entries[BEGIN, count], entries[END, count] = begin, end
    entries[WIDTH, count], entries[STRIDE, count] = end - begin, end - begin
    return count + 1


@jit
def _fits(entry, begin, end, valid):
    """Whether a run continues an entry at its stride; no state is valid in the runs that are left out in between."""
    width, stride = entry[WIDTH], entry[STRIDE]
    if end - begin != width:
        return False
    if stride == width:  # of a single run
        return True
    last = entry[END] - width
    if (begin - last) % stride != 0:
        return False
    for skipped in range(last + stride, begin, stride):
        for j in range(skipped, skipped + width):
            if valid[j]:
                return False
    return True


@jit
def split(letter, valid, n, rows):
    """Cut each row where the letter of its valid states changes.

    Returns `first_part` [rows + 1] and by part `begin`, `end` and `letter` (int32).
    """
    first = np.zeros(rows + 1, dtype=np.int64)
    count = 0
    for row in range(rows):
        last = -1
        for at in range(row * n, row * n + n):
            if valid[at]:
                count += last < 0 or letter[at] != letter[last]
                last = at
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
                if last < 0 or letter[at] != letter[last]:
                    part += 1
                    begin[part], read[part] = j, letter[at]
                end[part] = j + 1
                last = at
    return first, begin, end, read


@jit
def inputs(first_entry, effect, begin, n, effects):
    """The rows that the effects of each row lead to: `first` [rows + 1] and their numbers (int32)."""
    rows = len(first_entry) - 1
    first = np.zeros(rows + 1, dtype=np.int64)
    seen = np.full(rows, -1, dtype=np.int32)
    found = np.empty(max(16, 4 * rows), dtype=np.int32)
    count = 0
    for row in range(rows):
        for entry in range(first_entry[row], first_entry[row + 1]):
            for k in range(effects.first[effect[entry]], effects.first[effect[entry] + 1]):
                target = (row * n + begin[entry] + effects.shift[k]) // n
                if seen[target] != row:
                    seen[target] = row
                    if count == len(found):
                        larger = np.empty(2 * count, dtype=np.int32)
                        larger[:count] = found
                        found = larger
                    found[count] = target
                    count += 1
        first[row + 1] = count
    return first, found[:count].copy()
