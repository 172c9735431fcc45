"""Plans of toys and navigation equal the exact solution of an independent model, and hold up in simulation."""

from __future__ import annotations

import random
from typing import Any

import numpy as np
import pytest

from models.logic import parse
from models.planning import Plan, plan, simulate
from models.world import World, compile_world, load_environment, navigation_spec, resolve, toys_spec
from tests.planning import brute
from tests.planning.reference_worlds import BOXED, Grid, Navigation, Toys

SHAPES = ("cylinder", "sphere")
GRIDS = ((2, 1), (3, 1), (2, 2), (4, 1))
SLIPS = (0.0, 0.1, 0.3)


def ap(index: int) -> brute.LTL:
    return ("ap", f"p{index}")


def neg(index: int) -> brute.LTL:
    return ("not", f"p{index}")


def task_shape(shape: int) -> brute.LTL:
    """The shapes of the paper's tasks, and co-safe ones with order, avoidance and next, over p0, p1, p2."""
    return (
        ("F", ap(0)),
        ("F", ("and", ap(0), ("F", ap(1)))),
        ("F", ("and", ap(0), ("F", ("and", ap(0), ap(1))))),
        ("F", ("and", ap(0), ("F", ("and", ap(1), ("F", ap(2)))))),
        ("U", neg(2), ap(0)),
        ("and", ("F", ap(0)), ("U", neg(0), ap(1))),
        ("and", ("U", neg(2), ap(0)), ("F", ("X", ap(1)))),
        ("or", ("F", ("and", ap(0), ap(2))), ("X", ("X", ("U", neg(1), ap(0))))),
    )[shape]


def check(world: World, formula: str, answer: brute.Answer, seed: int) -> Plan:
    """The plan has the exact values, its bounds enclose them, and runs of its policy agree with them."""
    result = plan(world, parse(formula))
    if answer.probability == 0:
        assert result.outcome in ("unreachable", "unsatisfiable")
        assert result.policy is None
        return result
    assert result.outcome == "solved"
    assert result.policy is not None
    assert result.lower - 1e-12 <= answer.probability <= result.upper + 1e-12
    assert result.upper - result.lower <= 1e-6
    assert result.expected_steps == pytest.approx(answer.steps, rel=1e-6, abs=1e-6)
    runs = simulate(world, result.policy, runs=10_000, seed=seed)
    assert runs.decided.all()
    error = np.sqrt(answer.probability * (1 - answer.probability) / 10_000)
    assert abs(runs.success_rate - answer.probability) <= 5 * error + 1e-9
    spread = max(float(runs.steps.std()), 1e-3) / np.sqrt(10_000)
    assert abs(runs.mean_steps - answer.steps) <= 5 * spread + 1e-6
    return result


@pytest.mark.parametrize("seed", range(36))
def test_toys(seed: int) -> None:
    pick = random.Random(seed)
    columns, rows = GRIDS[seed % len(GRIDS)]
    slip = SLIPS[seed // 4 % 3]
    toys = SHAPES[: 2 if columns * rows <= 3 and seed % 3 == 0 else 1]
    cells = [(x, y) for y in range(rows) for x in range(columns)]
    spec = toys_spec(columns=columns, rows=rows, toys=[(s, "red") for s in toys], slip=slip, seed=seed)
    names = dict(zip(cells, _cell_names(spec), strict=True))
    things = [*toys, "box"]
    candidates: list[tuple[str, tuple[Any, ...]]] = [
        *(("at", (thing, cell)) for thing in ["robot", *things] for cell in cells),
        *(("in", (toy, "box")) for toy in toys),
        *(("holding", (thing,)) for thing in things),
    ]
    meaning = dict(zip(("p0", "p1", "p2"), pick.sample(candidates, 3), strict=True))
    formula = task_shape(seed % 8)
    text = brute.text(formula)
    for name, (function, arguments) in meaning.items():
        text = text.replace(name, f"{function}({', '.join(names.get(a, a) for a in arguments)})")

    model = Toys(Grid(columns, rows, slip), toys)
    world, text = _load(spec, text)
    places = {name: cell for cell, name in names.items()} | {"robot": "held", "box": BOXED}
    start = world.decode(world.initial)
    initial = (
        places[start["robot"]["at"]],
        places[start["box"]["in"]],
        tuple(places[start[toy]["in"]] for toy in toys),
    )
    answer = brute.solve(
        model.dynamics,
        lambda state: frozenset(n for n, (function, a) in meaning.items() if model.holds(state, function, *a)),
        initial,
        formula,
    )
    check(world, text, answer, seed)


@pytest.mark.parametrize("seed", range(24))
def test_navigation(seed: int) -> None:
    pick = random.Random(1000 + seed)
    columns, rows, slip = pick.randint(2, 5), pick.randint(2, 4), SLIPS[seed % 3]
    cells = [(x, y) for y in range(rows) for x in range(columns)]
    start, *marked = pick.sample(cells, 4)
    blocked = frozenset(c for c in cells if c not in (start, *marked) and pick.random() < 0.15)
    landmarks = {"start": start, "one": marked[0], "two": marked[1], "three": marked[2]}
    spec = navigation_spec(
        columns=columns,
        rows=rows,
        landmarks={name: (x + 1, y + 1) for name, (x, y) in landmarks.items()},
        blocked=[(x + 1, y + 1) for x, y in blocked],
        slip=slip,
    )
    formula = task_shape(seed % 8)
    text = brute.text(formula)
    for index, name in enumerate(("one", "two", "three")):
        text = text.replace(f"p{index}", f"at(robot, {name})")
    world, text = _load(spec, text)
    model = Navigation(Grid(columns, rows, slip, blocked))
    answer = brute.solve(
        model.dynamics, lambda cell: frozenset(f"p{i}" for i in range(3) if marked[i] == cell), start, formula
    )
    check(world, text, answer, seed)


def _cell_names(spec: dict[str, Any]) -> list[str]:
    grid = spec["grid"]
    return [grid["names"][character] for line in grid["map"] for character in line]


def _load(spec: dict[str, Any], text: str) -> tuple[World, str]:
    environment = load_environment(spec)
    resolve(parse(text), environment)  # every atom is one of the world's
    return compile_world(environment), text
