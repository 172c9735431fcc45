"""What is planned, and by which routes."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any, Self

from models.world import toys_spec

SLIP = 0.1


@dataclass(frozen=True, slots=True)
class Task:
    """A formula, and the propositions of its goal where it says no more than that they hold together at some time."""

    formula: str
    goal: tuple[str, ...]


TASKS = {
    "ship": Task(
        "F (in(cylinder, box) & F (in(cylinder, box) & at(box, bedroom)))",
        ("in(cylinder, box)", "at(box, bedroom)"),
    ),
    "then": Task("F (in(cylinder, box) & F at(box, bedroom))", ()),
    "rounds": Task("G F in(cylinder, box) & G F holding(cylinder)", ()),
}


@dataclass(frozen=True, slots=True)
class Toys:
    """A toys world: a grid, so many toys, and what to do; written `ship-4x1-2`."""

    task: str
    columns: int
    rows: int
    toys: int

    def __str__(self) -> str:
        return f"{self.task}-{self.columns}x{self.rows}-{self.toys}"

    @property
    def small(self) -> Self:
        """A world of the kind to warm up with."""
        return type(self)(self.task, 4, 1, 1)

    def spec(self) -> dict[str, Any]:
        """The data of the environment."""
        return toys_spec(columns=self.columns, rows=self.rows, toys=self.toys, slip=SLIP)


@dataclass(frozen=True, slots=True)
class Random:
    """A random MDP with so many states; written `random-100000`."""

    states: int

    def __str__(self) -> str:
        return f"random-{self.states}"

    @property
    def small(self) -> Self:
        """A world of the kind to warm up with."""
        return type(self)(1000)


Case = Toys | Random


def case_of(text: str) -> Case:
    """The case that is written so. Raises ValueError."""
    kind, *numbers = text.split("-")
    if kind == "random":
        return Random(int(numbers[0]))
    if kind not in TASKS:
        raise ValueError(
            f"{text} is neither random-STATES nor TASK-COLUMNSxROWS-TOYS with a task of {', '.join(TASKS)}"
        )
    columns, rows = map(int, numbers[0].split("x"))
    return Toys(kind, columns, rows, int(numbers[1]))


CASES = (
    Toys("ship", 4, 1, 1),
    Toys("ship", 3, 3, 2),
    Toys("ship", 3, 3, 3),
    Toys("ship", 4, 4, 2),
    Toys("ship", 4, 4, 3),
    Toys("ship", 6, 6, 2),
    Toys("ship", 5, 5, 3),
    Random(100_000),
    Random(1_000_000),
)
LARGE = Toys("then", 6, 6, 3)

TITLES = {
    "ours": "ours",
    "ours-relevant": "ours, relevant part",
    "ours-gpu": "ours, GPU",
    "storm-ltl": "Storm, LTL",
    "storm-steps": "Storm, least steps",
    "storm-reach": "Storm, reachability",
    "mdpsolver": "mdpsolver",
    "pymdptoolbox": "pymdptoolbox",
}
"""The routes. Not all take every case: see `routes`."""


def routes(case: Case, *, gpu: bool) -> Iterator[str]:
    """The routes that take a case, ours first."""
    yield "ours"
    if gpu:
        yield "ours-gpu"
    if isinstance(case, Random):
        yield "storm-reach"
        return
    yield "ours-relevant"
    if case == LARGE:
        return
    yield "storm-ltl"
    if TASKS[case.task].goal:
        yield from ("storm-steps", "mdpsolver", "pymdptoolbox")
