"""The two parts of whatever is written for training: what training reads, and what is kept to measure on."""

from __future__ import annotations

from collections.abc import Sequence
from enum import StrEnum
from typing import TypeVar

HELD_BACK = 5
"""Every fifth entry of a list is held out of training."""

_Entry = TypeVar("_Entry")


class Half(StrEnum):
    """What training may read, or what it never sees."""

    TRAINING = "training"
    HELD_OUT = "held_out"


def half(entries: Sequence[_Entry], part: Half) -> tuple[_Entry, ...]:
    """The entries of one part, in order."""
    held_out = part is Half.HELD_OUT
    return tuple(entry for index, entry in enumerate(entries) if (index % HELD_BACK == HELD_BACK - 1) is held_out)
