"""In which order a sweep takes the rows, and which of them threads may take at a time.

Rows that differ in one variable only, the one that changes most often, are a *group*: most of what a row leads to is in
its group, so that a group which is swept a few times in succession is read from memory once. Wingate and Seppi,
"Prioritization methods for accelerating MDP solvers" (JMLR 6, 2005), order partitions of a world in this manner.
"""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from models.planning.kernels import jit

Ints = NDArray[np.int64]

FEW = 8
"""Groups of a level, on average, up to which threads do not pay."""


class Schedule(NamedTuple):
    """Groups, nearest first, and the nearest of their rows first, as far as levels leave it at that.

    The groups of a level do not lead to each other. Of two groups one of which leads to the other, the nearer one is in
    the lower level. So to sweep the groups of each level at the same time is to sweep all of them one after the other.
    """

    order: Ints  # [rows]
    group: Ints  # [groups + 1]  where each group begins in `order`
    level: Ints  # [levels + 1]  first group of each level
    parallel: bool  # there are enough groups in a level


def schedule(world: Any, radix: Ints, nearness: Ints) -> Schedule:
    """The schedule of the rows of a world, which are numbered by variables of these sizes, by how near they are."""
    count = len(nearness)
    stride = np.array([radix[v + 1 :].prod() for v in range(len(radix))], dtype=np.int64)
    moved = int(np.argmax(changes(world, radix, stride)))
    row = np.arange(count)
    group = row // (stride[moved] * radix[moved]) * stride[moved] + row % stride[moved]
    groups = count // int(radix[moved])
    nearest = np.full(groups, np.iinfo(np.int64).max)
    np.minimum.at(nearest, group, nearness)
    rank = np.empty(groups, dtype=np.int64)
    rank[np.argsort(nearest, kind="stable")] = np.arange(groups)
    members = np.lexsort((nearness, rank[group]))
    level = levels(world, members, rank[group], groups)
    order = members.reshape(groups, -1)[np.argsort(level, kind="stable")].reshape(-1)
    first = np.concatenate([[0], np.cumsum(np.bincount(level))])
    return Schedule(order, np.arange(groups + 1) * int(radix[moved]), first, len(first) * FEW <= groups)


@jit
def changes(world, radix, stride):
    """[variables] how many times a row leads to one that differs in no other variable."""
    count = np.zeros(len(radix), dtype=np.int64)
    for row in range(len(world.first_input) - 1):
        for one in range(world.first_input[row], world.first_input[row + 1]):
            other = world.input[one]
            for v in range(len(radix)):
                around = stride[v] * radix[v]
                count[v] += row // around == other // around and row % stride[v] == other % stride[v]
    return count


@jit
def levels(world, members, rank, groups):
    """[groups] by rank: one more than the levels of the groups of lower rank that lead to it or to which it leads.

    `members` are the rows, sorted by the rank of their group, `rank` [rows].
    """
    level = np.zeros(groups, dtype=np.int64)
    size = len(members) // groups
    for group in range(groups):
        rows = members[group * size : group * size + size]
        for row in rows:
            for one in range(world.first_input[row], world.first_input[row + 1]):
                other = rank[world.input[one]]
                if other < group:
                    level[group] = max(level[group], level[other] + 1)
        for row in rows:
            for one in range(world.first_input[row], world.first_input[row + 1]):
                other = rank[world.input[one]]
                if other > group:
                    level[other] = max(level[other], level[group] + 1)
    return level
