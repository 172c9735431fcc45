"""Maximal probabilities of random MDPs against Storm (a development dependency with Linux wheels only)."""

from __future__ import annotations

import random
from pathlib import Path

import pytest

from models.logic import parse
from models.planning import plan
from tests.planning import brute
from tests.planning.doubles import ArrayWorld, random_world
from tests.planning.test_random_models import random_formula

stormpy = pytest.importorskip("stormpy")


def as_drn(world: ArrayWorld) -> str:
    """The world in Storm's DRN format; one more state, which nothing leads to, declares every label."""
    lines = ["@type: MDP", "@value_type: double", "@parameters", "", "@reward_models", "", "@nr_states"]
    moves = {s: dict(world.transitions[s]) or {"stay": {s: 1.0}} for s in range(world.size)}
    moves[world.size] = {"stay": {world.size: 1.0}}
    lines += [str(len(moves)), "@nr_choices", str(sum(map(len, moves.values()))), "@model"]
    for state, actions in moves.items():
        labels = ["init"] if state == world.initial else []
        labels += [name for name, states in world.holds.items() if state in states or state == world.size]
        lines.append(" ".join(["state", str(state), *labels]))
        for action, move in actions.items():
            lines.append(f"\taction {action}")
            lines += [f"\t\t{target} : {move[target]!r}" for target in sorted(move)]
    return "\n".join(lines) + "\n"


def storm_maximum(world: ArrayWorld, formula: str, file: Path) -> float:
    """Storm's LTL model checking on the explicit model, with sound numerics."""
    file.write_text(as_drn(world))
    model = stormpy.build_model_from_drn(file)
    quoted = "".join(f'"{c}"' if c in world.holds else c for c in formula)
    query = stormpy.parse_properties(f"Pmax=? [{quoted}]")[0]
    result = stormpy.model_checking(model, query, environment=stormpy.environments.sound())
    return float(result.get_value_vector()[world.initial])


@pytest.mark.parametrize("block", range(4))
def test_the_bounds_contain_storms_value(block: int, tmp_path: Path) -> None:
    for seed in range(5000 + block * 25, 5000 + block * 25 + 25):
        world = random_world(seed)
        pick = random.Random(seed)
        formula = brute.text(("U", random_formula(pick, 1), random_formula(pick, 2)))
        result = plan(world, parse(formula))
        value = storm_maximum(world, formula, tmp_path / "model.drn")
        assert result.lower - 1e-6 <= value <= result.upper + 1e-6, (seed, formula)
