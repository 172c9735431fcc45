"""What is compiled beforehand is all that plans need."""

from __future__ import annotations

import subprocess
import sys

COUNT = """
import sys
from numba.core.dispatcher import Dispatcher
from models.logic import parse
from models.planning import Options, plan
from models.world import builtin_environments, compile_world, load_environment

tasks = {
    "toys-4x1-sphere": ["F at(robot, bathroom)", "G F at(robot, kitchen) & G F at(robot, bathroom)"],
    "house": ["F at(robot, kitchen)", "G !at(robot, kitchen)"],
    "city": ["F at(robot, bakery) & G !at(robot, zoo)", "F G at(robot, harbour)"],
}
for name, spec in builtin_environments():
    for task in tasks.get(name, ()):
        for objective in ("max", "min"):
            plan(compile_world(load_environment(spec)), parse(task), options=Options(objective=objective))
compiled = {
    f"{found.__module__}.{found.__name__}": sum(found.stats.cache_misses.values())
    for name, module in sys.modules.items() if name.startswith("models.planning")
    for found in vars(module).values() if isinstance(found, Dispatcher)
}
assert len(compiled) > 50, len(compiled)
print(*sorted(name for name, misses in compiled.items() if misses))
"""
"""Plans in a process of its own and prints which functions it had to compile."""


def run(*arguments: str) -> str:
    result = subprocess.run([sys.executable, *arguments], capture_output=True, text=True, check=False)
    assert result.returncode == 0, result.stderr
    return result.stdout


def test_plans_compile_nothing_after_it() -> None:
    run("-m", "models.planning")
    assert run("-c", COUNT) == "\n"
