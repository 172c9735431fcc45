"""Worlds as arrays: contents, order, limits."""

from __future__ import annotations

from importlib.resources import files

import numpy as np
import pytest
import yaml

import models.world as worlds
from models.logic import parse
from models.planning import ModelTooLargeError, Options, plan
from models.planning import compiled as module
from models.planning.compiled import STAY, CompiledWorld, check_memory, compile_world
from models.world import Outcomes
from tests.planning.doubles import ArrayWorld, random_world


def as_transitions(compiled: CompiledWorld, names: tuple[str, ...]) -> dict[int, dict[str, dict[int, float]]]:
    result: dict[int, dict[str, dict[int, float]]] = {}
    for state in range(compiled.states):
        result[state] = {}
        for choice in range(compiled.first_choice[state], compiled.first_choice[state + 1]):
            outcomes = range(compiled.first_outcome[choice], compiled.first_outcome[choice + 1])
            action = compiled.action[choice]
            result[state]["stay" if action == STAY else names[action]] = {
                int(compiled.successor[i]): float(compiled.probability[i]) for i in outcomes
            }
    return result


@pytest.mark.parametrize("block", [1, 3, module.BLOCK])
def test_every_choice_is_there_in_order_whatever_the_block(block: int, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(module, "BLOCK", block)
    for seed in range(30):
        world = random_world(seed)
        compiled = compile_world(world)
        found = as_transitions(compiled, world.actions)
        for state, moves in found.items():
            expected = world.transitions[state] or {"stay": {state: 1.0}}
            assert list(moves) == sorted(expected, key=lambda a: world.actions.index(a) if a != "stay" else 0)
            for action, move in moves.items():
                assert move == pytest.approx(expected[action], rel=1e-15)


def test_forbidden_states_have_no_choices() -> None:
    world = ArrayWorld(3, {0: {"go": {2: 1.0}}, 1: {"go": {0: 1.0}}}, {}, forbidden=frozenset({1}))
    compiled = compile_world(world)
    assert compiled.valid.tolist() == [True, False, True]
    assert np.diff(compiled.first_choice).tolist() == [1, 0, 1]


def test_probabilities_that_sum_to_one_nearly_are_scaled() -> None:
    thirds = [[0, 0.333333333], [1, 0.333333333], [2, 0.333333333]]
    spec = {
        "name": "thirds",
        "kind": "explicit",
        "states": 3,
        "transitions": [{"from": 0, "action": "go", "to": thirds}],
    }
    world = worlds.compile_world(worlds.load_environment(spec))
    assert compile_world(world).probability[:3].sum() == pytest.approx(1.0, abs=1e-15)
    assert world.outcomes(0, np.array([0])).probability.sum() == pytest.approx(1.0, abs=1e-15)


def test_so_are_those_of_the_world_language() -> None:
    slip = worlds.toys_spec(columns=2, rows=1, toys=1)
    domain = yaml.safe_load((files("models.world") / "domains" / "toys.yaml").read_text())
    for outcome in domain["actions"]["north"]["outcomes"]:
        outcome["probability"] = 0.333333333
    del slip["domain"]
    world = worlds.compile_world(worlds.load_environment({**slip, "domain_spec": domain}))
    north = world.actions.index("north")
    assert world.outcomes(north).probability.sum(axis=0) == pytest.approx(1.0, abs=1e-15)
    assert isinstance(world, worlds.OomdpWorld)
    assert world.factored is not None
    assert world.factored.actions[north].probability.sum(axis=0) == pytest.approx(1.0, abs=1e-15)


class Untouchable(ArrayWorld):
    """A world that claims to be huge and must not be asked for all its states."""

    def outcomes(self, action: int, states: object = None) -> Outcomes:
        assert states is not None, "compiled in spite of the limit"
        return super().outcomes(action, states)  # type: ignore[arg-type]

    def labels(self, atoms: object, states: object = None) -> object:  # type: ignore[override]
        raise AssertionError("labelled in spite of the limit")


def test_too_many_states_are_refused_with_estimate_and_limit() -> None:
    world = Untouchable(10_000, {s: {"go": {s + 1: 1.0}} for s in range(9_999)}, {"a": frozenset()})
    with pytest.raises(ModelTooLargeError) as caught:
        plan(world, parse("F a"), options=Options(max_states=200))
    error = caught.value
    assert (error.slug, error.estimate, error.limit, error.unit) == ("model-too-large", 20_000, 200, "states")
    assert "20000" in error.detail


def test_too_much_memory_is_refused_before_it_is_allocated() -> None:
    moves = {s: {"go": {(s + k) % 10_000: 0.25 for k in range(4)}} for s in range(10_000)}
    world = Untouchable(10_000, moves, {"a": frozenset()})
    with pytest.raises(ModelTooLargeError) as caught:
        plan(world, parse("F a"), options=Options(max_bytes=1_000_000))
    assert caught.value.unit == "bytes"
    assert caught.value.estimate > caught.value.limit == 1_000_000


def test_a_small_world_with_many_outcomes_is_refused_too() -> None:
    moves = {s: {"go": dict.fromkeys(range(60), 1 / 60)} for s in range(60)}
    with pytest.raises(ModelTooLargeError) as caught:
        plan(ArrayWorld(60, moves, {"a": frozenset({1})}), parse("F a"), options=Options(max_bytes=100_000))
    choices, outcomes = 60, 60 * 60
    estimate = 60 * (2 * 16 + 160) + choices * (20 + 48) + outcomes * (12 + 28)
    assert (caught.value.unit, caught.value.estimate) == ("bytes", estimate)
    assert [(place.pointer, place.detail) for place in caught.value.places] == [("", caught.value.detail)]


def test_the_memory_estimate_grows_with_the_world() -> None:
    with pytest.raises(ModelTooLargeError) as caught:
        check_memory(ArrayWorld(5_000, {}, {}), 2, 1, Options(max_bytes=1))
    small = caught.value.estimate
    with pytest.raises(ModelTooLargeError) as caught:
        check_memory(ArrayWorld(50_000, {}, {}), 2, 1, Options(max_bytes=1))
    assert caught.value.estimate == 10 * small
