"""Compiling all that planning compiles, so that the first plan need not wait for it.

The compiled code is kept beside the sources (numba's cache), and made again when they change.
"""

from __future__ import annotations

from multiprocessing import get_context

from models.logic import parse
from models.planning import Options, plan
from models.world import World, compile_world, load_environment, toys_spec

LISTED = {
    "name": "warm",
    "kind": "explicit",
    "states": 6,
    "labels": {"goal": [5], "trap": [4]},
    "transitions": [
        {"from": 0, "action": "go", "to": [[1, 0.5], [2, 0.5]]},
        {"from": 0, "action": "try", "to": [[4, 0.5], [5, 0.5]]},
        {"from": 1, "action": "go", "to": [[0, 0.5], [3, 0.5]]},
        {"from": 2, "action": "go", "to": [[3, 1.0]]},
        {"from": 3, "action": "try", "to": [[4, 0.1], [0, 0.4], [5, 0.5]]},
        {"from": 5, "action": "go", "to": [[0, 1.0]]},
    ],
}
"""A world listed state by state in which nothing is sure."""


def warm() -> None:
    """Plan one task of each kind: sure, uncertain, and to be done for ever."""
    _plan_in_rooms()
    _plan_in_listed()


def compile_all() -> None:
    """As `warm`, by two processes: each has what the other one has compiled, and both are half as long at it."""
    other = get_context("spawn").Process(target=_plan_in_listed)
    other.start()
    _plan_in_rooms()
    other.join()
    _plan_in_listed()  # whatever became of the other one


def _plan_in_rooms() -> None:
    world = compile_world(load_environment(toys_spec(columns=2, rows=1, toys=[("sphere", "red")], slip=0.1)))
    kitchen = world.variables[0].values[0]
    _plan_all(
        world,
        "F holding(sphere)",
        f"!at(robot, {kitchen}) U holding(sphere)",
        f"X !at(robot, {kitchen}) & F holding(sphere)",
        "G F holding(sphere) & G F !holding(sphere)",
    )


def _plan_in_listed() -> None:
    listed = compile_world(load_environment(LISTED))
    _plan_all(listed, "F goal", "!trap U goal", "G F goal", "F G !trap & G F goal")
    plan(listed, parse("F goal"), options=Options(epsilon=1e-12))  # too near for upper bounds to be guessed


def _plan_all(world: World, *tasks: str) -> None:
    for task in tasks:
        for objective in ("max", "min"):
            plan(world, parse(task), options=Options(objective=objective))
