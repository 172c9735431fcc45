"""A world as rows of entries."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from math import prod
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from models.planning.dense import compression
from models.planning.dense.tables import Effects, flatten, outer_variables
from models.planning.dense.team import Team
from models.world import Factored


class Rows(NamedTuple):
    """The entries and the parts of every row; the index of a state is row · length + its place in the row.

    An entry is an effect that is possible in runs of `width` states, which begin at `begin` and then every `stride`
    states, the last one ending at `end`; a single run has `stride` = `width`. A part is where reading the states gives
    the same letter. Both may go over states that are not valid: what is found there counts for nothing.
    """

    length: int
    first_entry: NDArray[np.int64]  # [rows + 1]
    effect: NDArray[np.int32]
    begin: NDArray[np.int32]
    end: NDArray[np.int32]
    width: NDArray[np.int32]
    stride: NDArray[np.int32]
    first_input: NDArray[np.int64]  # [rows + 1]
    input: NDArray[np.int32]  # rows that the effects of a row lead to
    first_part: NDArray[np.int64]  # [rows + 1]
    part_begin: NDArray[np.int32]
    part_end: NDArray[np.int32]
    letter: NDArray[np.int32]


@dataclass(frozen=True, slots=True, eq=False)
class Compressed:
    """A world as rows of entries, and which of its states are valid."""

    rows: Rows
    effects: Effects
    valid: NDArray[np.bool_]  # [S]
    radix: NDArray[np.int64]  # sizes of the variables that number the rows


def compress(world: Factored, letter: NDArray[np.signedinteger], team: Team | None = None) -> Compressed:
    """The rows of a world whose states read `letter` ([S])."""
    tables, effects = flatten(world)
    length = prod(world.radix[outer_variables(world) :])
    count = len(letter) // length

    def some(begin: int, end: int) -> tuple[NDArray[Any], ...]:
        first, entries, valid = compression.compress(tables, effects, length, end - begin, begin)
        pieces = compression.split(letter[begin * length : end * length], valid, length, end - begin)
        return (first, entries, valid, *pieces)

    parts = [some(0, count)] if team is None else team.share(some, 0, count)
    firsts, entries, valid, first_parts, *pieces = zip(*parts, strict=True)
    first, joined = _offsets(firsts), _joined(entries)
    entered = compression.inputs(first, joined[0], joined[1], length, effects)
    cut = (_offsets(first_parts), *map(_joined, pieces))
    made = Rows._make((length, first, *joined, *entered, *cut))
    return Compressed(made, effects, _joined(valid), tables.radix)


def _offsets(parts: Sequence[NDArray[np.int64]]) -> NDArray[np.int64]:
    """The offsets of arrays joined, from those of the arrays, each from 0 to its length."""
    before = np.cumsum([0, *(part[-1] for part in parts)])
    return np.concatenate([[0], *(part[1:] + offset for part, offset in zip(parts, before, strict=False))])


def _joined(parts: Sequence[NDArray[Any]]) -> NDArray[Any]:
    return parts[0] if len(parts) == 1 else np.concatenate(parts, axis=-1)
