"""Compile what planning compiles, so that the first plan need not wait for it.

    python -m models.planning

The compiled code is kept beside the sources (numba's cache), and made again when they change.
"""

from __future__ import annotations

from models.logic import parse
from models.planning import Options, plan
from models.world import compile_world, load_environment, toys_spec


def warm() -> None:
    """Plan one task of each kind: sure, uncertain, and to be done for ever."""
    world = compile_world(load_environment(toys_spec(columns=2, rows=1, toys=[("sphere", "red")], slip=0.1)))
    kitchen = world.variables[0].values[0]
    for task in (
        "F holding(sphere)",
        f"!at(robot, {kitchen}) U holding(sphere)",
        f"X !at(robot, {kitchen}) & F holding(sphere)",
        "G F holding(sphere) & G F !holding(sphere)",
    ):
        for objective in ("max", "min"):
            plan(world, parse(task), options=Options(objective=objective))


if __name__ == "__main__":
    warm()
