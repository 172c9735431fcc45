"""Storm's model of an exported text against the world itself, state by state."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from fractions import Fraction
from pathlib import Path
from typing import Any

import numpy as np

from models.world import World

Dynamics = dict[int, dict[str, dict[int, float]]]
"""state -> action -> successor -> probability."""
STUCK = "(stuck)"


def dynamics(world: World, *, reachable: bool = True) -> Dynamics:
    """The world asked state by state; STUCK where nothing is possible."""
    found: Dynamics = {}
    waiting = [world.initial] if reachable else np.flatnonzero(world.valid()).tolist()
    while waiting:
        state = waiting.pop()
        if state in found:
            continue
        found[state] = {}
        for number, action in enumerate(world.actions):
            answer = world.outcomes(number, np.array([state]))
            if answer.enabled[0]:
                moves = found[state][action] = {}
                for target, chance in zip(answer.successor[:, 0].tolist(), answer.probability[:, 0], strict=True):
                    if chance > 0:
                        moves[target] = moves.get(target, 0.0) + float(chance)
        if not found[state]:
            found[state] = {STUCK: {state: 1.0}}
        waiting += [target for moves in found[state].values() for target in moves]
    return found


def storm_dynamics(model: Any, state_of: Mapping[int, int]) -> tuple[Dynamics, int]:
    """The same of Storm's model and the number of choices; actions by their labels."""
    found: Dynamics = {}
    choices = 0
    for state in model.states:
        moves = found[state_of[state.id]] = {}
        for action in state.actions:
            choices += 1
            (label,) = action.labels
            moves[label] = {state_of[entry.column]: float(Fraction(str(entry.value))) for entry in action.transitions}
    return found, choices


def assert_same(actual: Dynamics, expected: Dynamics, names: Mapping[str, str]) -> None:
    """`names` is the identifier of each action."""
    assert actual.keys() == expected.keys()
    for state, moves in expected.items():
        renamed = {names[action]: outcomes for action, outcomes in moves.items()}
        assert actual[state].keys() == renamed.keys(), state
        for action, outcomes in renamed.items():
            assert actual[state][action].keys() == outcomes.keys(), (state, action)
            for target, chance in outcomes.items():
                assert abs(actual[state][action][target] - chance) < 1e-12


def maximum(model: Any, text: str) -> float:
    """Storm's answer to a property, at the initial state, with sound numerics."""
    import stormpy

    query = stormpy.parse_properties(text)[0]
    result = stormpy.model_checking(model, query, environment=stormpy.environments.sound())
    (initial,) = model.initial_states
    return float(result.get_value_vector()[initial])


def from_drn(text: str, folder: Path) -> Any:
    """Storm's model of a DRN text."""
    import stormpy

    file = folder / "model.drn"
    file.write_text(text)
    options = stormpy.io.DirectEncodingParserOptions()
    options.build_choice_labeling = True
    return stormpy.build_model_from_drn(file, options=options)


def from_prism(text: str, folder: Path, *, exact: bool = False) -> tuple[Any, Any]:
    """Storm's program and model of a PRISM text, with the values of states.

    `exact` has Storm check sums of probabilities and ranges; with floats it refuses sums that are 1 up to rounding.
    """
    import stormpy

    file = folder / "model.prism"
    file.write_text(text, encoding="utf-8")
    program = stormpy.parse_prism_program(file, simplify=False)
    options = stormpy.BuilderOptions(build_full=True)
    options.set_exploration_checks(exact)
    return program, stormpy.build_model[stormpy.Rational if exact else float](program, options=options)


def reach_probability(world_dynamics: Dynamics, goal: Iterable[int], sweeps: int = 3_000) -> dict[int, float]:
    """Maximal probabilities to reach a goal, by plain value iteration."""
    value = dict.fromkeys(world_dynamics, 0.0) | dict.fromkeys(goal, 1.0)
    fixed = set(goal)
    for _ in range(sweeps):
        change = 0.0
        for state, moves in world_dynamics.items():
            if state not in fixed:
                new = max(sum(p * value[t] for t, p in outcomes.items()) for outcomes in moves.values())
                change = max(change, new - value[state])
                value[state] = new
        if change < 1e-13:
            break
    return value


def fewest_steps(world_dynamics: Dynamics, goal: Iterable[int], start: int, sweeps: int = 3_000) -> float:
    """The fewest expected steps to a goal that can be reached almost surely, by plain value iteration."""
    value = dict.fromkeys(world_dynamics, 0.0)
    fixed = set(goal)
    for _ in range(sweeps):
        change = 0.0
        for state, moves in world_dynamics.items():
            if state not in fixed:
                new = 1 + min(sum(p * value[t] for t, p in outcomes.items()) for outcomes in moves.values())
                change = max(change, new - value[state])
                value[state] = new
        if change < 1e-12:
            break
    return value[start]
