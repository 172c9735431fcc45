"""Random toys and navigation worlds with random co-safe formulas, and their exact solutions by `brute`.

A proposition is the atom's text, so that one formula is read by the planner and by the reference.
"""

from __future__ import annotations

import random
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any

from models.world import OomdpWorld, compile_world, load_environment, navigation_spec, toys_spec
from tests.planning import brute
from tests.planning.reference_worlds import BOXED, HELD, Cell, Grid, Navigation, Toys
from tests.planning.test_random_models import random_formula

GRIDS = ((1, 1), (2, 1), (3, 1), (2, 2), (4, 1))
SLIPS = (0.0, 0.1, 0.3, 1.0)


@dataclass(frozen=True)
class Task:
    """A world, a formula, and the same for the reference."""

    world: OomdpWorld
    formula: brute.LTL
    solve: Callable[[brute.LTL], brute.Answer]

    @property
    def text(self) -> str:
        return brute.text(self.formula)

    @property
    def answer(self) -> brute.Answer:
        return self.solve(self.formula)


def rename(formula: brute.LTL, names: dict[str, str]) -> brute.LTL:
    """The formula with other propositions."""
    if formula[0] in ("ap", "not"):
        return (formula[0], names[formula[1]])
    return (formula[0], *(rename(part, names) for part in formula[1:]))


def shape(pick: random.Random, *, following: bool) -> brute.LTL:
    """A co-safe formula over a, b, c; without X unless `following`."""
    a, b, c = ("ap", "a"), ("ap", "b"), ("ap", "c")
    tasks: list[brute.LTL] = [
        ("F", a),
        ("F", ("and", a, ("F", b))),
        ("F", ("and", a, ("F", ("and", b, ("F", c))))),
        ("U", ("not", "c"), a),
        ("and", ("F", a), ("U", ("not", "a"), b)),
        ("and", ("F", a), ("F", b)),
        ("or", ("U", ("not", "b"), a), ("F", ("and", b, ("F", c)))),
        ("and", ("U", ("not", "c"), a), ("U", ("not", "c"), b)),
    ]
    if following:
        tasks = [
            ("F", ("and", a, ("X", b))),
            ("X", ("X", ("F", a))),
            ("and", ("F", ("X", a)), ("U", ("not", "c"), b)),
            ("or", ("F", ("and", a, b)), ("X", ("X", ("U", ("not", "b"), c)))),
            ("X", ("or", a, ("X", ("or", b, ("X", ("and", ("not", "c"), a)))))),
            ("X", ("X", ("or", a, ("X", ("X", c))))),
            ("U", random_formula(pick, 1), random_formula(pick, 2)),
        ]
    return pick.choice(tasks)


def toys_task(seed: int, *, following: bool = False, spare: int = 0) -> Task:
    """A task in a small toys world; the formula speaks of all toys but `spare` ones."""
    pick = random.Random(seed)
    columns, rows = GRIDS[seed % len(GRIDS)]
    slip = SLIPS[pick.randrange(len(SLIPS))] if spare == 0 else pick.choice(SLIPS[:3])
    toys = ("cylinder", "sphere", "cube")[: (1 if columns * rows > 2 else pick.choice([1, 2])) + spare]
    spec = toys_spec(columns=columns, rows=rows, toys=[(s, "red") for s in toys], slip=slip, seed=seed)
    grid = spec["grid"]
    names = [grid["names"][mark] for line in grid["map"] for mark in line]
    cells = {name: (place % columns, place // columns) for place, name in enumerate(names)}
    spoken = toys[: len(toys) - spare]
    atoms = [
        *(("at", (thing, cell)) for thing in ["robot", "box", *spoken] for cell in cells),
        *(("in", (toy, "box")) for toy in spoken),
        *(("holding", (thing,)) for thing in ["box", *spoken]),
    ]
    world, formula, chosen = _task(spec, atoms, pick, following)
    model = Toys(Grid(columns, rows, slip), toys)
    where: dict[str, Any] = {**cells, "robot": HELD, "box": BOXED}
    start = world.decode(world.initial)
    initial = (
        cells[start["robot"]["at"]],
        where[start["box"]["in"]],
        tuple(where[start[toy]["in"]] for toy in toys),
    )

    def label(state: Any) -> frozenset[str]:
        return frozenset(
            text
            for text, (function, names) in chosen.items()
            if model.holds(state, function, *(cells.get(name, name) for name in names))
        )

    return Task(world, formula, lambda f: brute.solve(model.dynamics, label, initial, f))


def navigation_task(seed: int, *, following: bool = False) -> Task:
    """A task on a small map with walls of blocked cells."""
    pick = random.Random(1000 + seed)
    columns, rows, slip = pick.randint(2, 5), pick.randint(2, 4), SLIPS[seed % len(SLIPS)]
    cells = [(x, y) for y in range(rows) for x in range(columns)]
    marks = dict(zip(("start", "one", "two", "three"), pick.sample(cells, 4), strict=True))
    blocked = frozenset(c for c in cells if c not in marks.values() and pick.random() < 0.2)
    spec = navigation_spec(
        columns=columns,
        rows=rows,
        landmarks={name: (x + 1, y + 1) for name, (x, y) in marks.items()},
        blocked=[(x + 1, y + 1) for x, y in blocked],
        slip=slip,
    )
    atoms = [("at", ("robot", name)) for name in ("one", "two", "three")]
    world, formula, chosen = _task(spec, atoms, pick, following)
    model = Navigation(Grid(columns, rows, slip, blocked))

    def label(cell: Cell) -> frozenset[str]:
        return frozenset(text for text, (_, names) in chosen.items() if marks[names[1]] == cell)

    return Task(world, formula, lambda f: brute.solve(model.dynamics, label, marks["start"], f))


def _task(
    spec: dict[str, Any], atoms: Sequence[tuple[str, tuple[str, ...]]], pick: random.Random, following: bool
) -> tuple[OomdpWorld, brute.LTL, dict[str, tuple[str, tuple[str, ...]]]]:
    world = compile_world(load_environment(spec))
    assert isinstance(world, OomdpWorld)
    chosen = {f"{function}({', '.join(names)})": (function, names) for function, names in pick.sample(atoms, 3)}
    formula = rename(shape(pick, following=following), dict(zip("abc", chosen, strict=True)))
    return world, formula, chosen
