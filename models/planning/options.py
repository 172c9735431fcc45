"""What a caller may ask of the planner, and how it reports progress."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator
from dataclasses import dataclass, field
from typing import Literal, Protocol

Device = Literal["auto", "cpu", "cuda"]
Objective = Literal["max", "min"]

Stage = Literal["compile", "graph", "rounds", "probability", "steps", "evaluate"]

MOST_SWEEPS = 2**62
"""More than anything is ever swept."""

MOST_BYTES = 64 * 2**30
"""The largest `max_bytes`: a model that fits has fewer than 2^31 outcomes, which are numbered in 32 bits."""


def _never(_: Stage) -> bool:
    return False


@dataclass(frozen=True, slots=True)
class Options:
    """Accuracy and limits of one plan.

    `epsilon` bounds upper minus lower probability and what the policy may fall short of the lower one; values
    are computed more exactly than that, because ties between actions are decided on them. A plan that has not
    reached `epsilon` after `max_sweeps` sweeps of one stage, or when `hurry`, which is asked after every sweep, says so
    of the stage, answers with what it reached. `device` "auto"
    takes a CUDA device for large models when there is one. `objective` "min" asks for the policy under which the
    formula is least probable. `relevance` leaves out of the world what the formula cannot depend on, where that is
    known.
    """

    epsilon: float = 1e-6
    max_states: int = 50_000_000
    max_bytes: int = 8 * 2**30
    max_sweeps: int = 1_000_000
    device: Device = "auto"
    objective: Objective = "max"
    relevance: bool = True
    hurry: Callable[[Stage], bool] = field(default=_never, compare=False)

    def __post_init__(self) -> None:
        if not 0 < self.epsilon < 1:
            raise ValueError("epsilon lies between 0 and 1")
        if min(self.max_states, self.max_bytes, self.max_sweeps) < 1:
            raise ValueError("limits are at least 1")
        if self.max_bytes > MOST_BYTES:
            raise ValueError(f"max_bytes is at most {MOST_BYTES}")
        if self.device not in ("auto", "cpu", "cuda"):
            raise ValueError("device is auto, cpu or cuda")
        if self.objective not in ("max", "min"):
            raise ValueError("objective is max or min")

    def sweeps(self, stage: Stage, *, after: int = 0, most: int = MOST_SWEEPS) -> Iterator[int]:
        """The numbers of the sweeps of a stage from `after` + 1 on, as many as are allowed, until `hurry` ends them."""
        for sweep in range(after + 1, min(most, self.max_sweeps) + 1):
            yield sweep
            if self.hurry(stage):
                return


class Progress(Protocol):
    """Told about every sweep; an exception that it raises cancels the plan and reaches the caller of `plan`."""

    def __call__(
        self, stage: Stage, sweep: int, lower: float, upper: float, states: int, left: float = math.nan, /
    ) -> None:
        """`sweep` counts from 1, and stays where it is while a small system is solved directly; the bounds are
        those of the initial state's value; `states` is what a sweep updates; `left` is how many sweeps the iteration
        still needs by `models.planning.trend`, or nan where there is no telling.

        In "compile" a sweep is one block of states, `states` is how many are compiled, and the bounds say
        nothing yet (0 and infinity); `left` is exact. In "graph" it is a stretch of a search, `states` is how many
        outcomes it looked at, and the bounds say nothing either; stretches are counted anew in each search.
        """


def no_progress(stage: Stage, sweep: int, lower: float, upper: float, states: int, left: float = math.nan, /) -> None:
    """Tell nobody."""
