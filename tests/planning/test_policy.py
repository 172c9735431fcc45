"""The policy as a value, as bytes, as JSON, and run by run."""

from __future__ import annotations

import json
from dataclasses import replace

import numpy as np
import pytest

from models.logic import parse
from models.planning import (
    InvalidMemoryError,
    InvalidPolicyError,
    Policy,
    from_bytes,
    plan,
    simulate,
    to_bytes,
    to_json,
)
from models.world import StateError, Variable, World, compile_world, load_environment, toys_spec
from tests.planning.doubles import ArrayWorld

TASK = "F (in(cylinder, box) & F at(box, kitchen))"


@pytest.fixture(scope="module")
def world() -> World:
    return compile_world(load_environment(toys_spec(columns=3, rows=1, toys=1, slip=0.2)))


@pytest.fixture(scope="module")
def policy(world: World) -> Policy:
    found = plan(world, parse(TASK)).policy
    assert found is not None
    return found


def test_the_loop_of_a_robot_ends_in_done(world: World, policy: Policy) -> None:
    state, memory = world.initial, policy.initial_memory
    for _ in range(100):
        step = policy.step(world.decode(state), memory)
        if step.done:
            break
        assert step.action is not None
        action = world.actions.index(step.action)
        answer = world.outcomes(action, np.array([state]))
        state, memory = int(answer.successor[0, 0]), step.memory
    assert step.done
    assert (step.status, step.action, step.probability, step.expected_steps) == ("satisfied", None, 1.0, 0.0)


def test_states_by_name_are_the_worlds(world: World, policy: Policy) -> None:
    for index in np.flatnonzero(world.valid()).tolist():
        assert policy.decode(index) == world.decode(index)
        assert policy.encode(world.decode(index)) == index
    assert policy.encode({}) == world.initial


def test_a_forbidden_state_is_refused_and_has_no_action(world: World, policy: Policy) -> None:
    held = {"robot": {"at": "kitchen"}, "box": {"in": "robot"}, "cylinder": {"in": "robot"}}
    with pytest.raises(StateError, match="does not allow"):
        policy.step(held, 0)
    invalid = np.flatnonzero(~world.valid())
    assert len(invalid)
    assert (policy.action[:, invalid] == -1).all()
    assert (policy.letter[invalid] == -1).all()
    for index in (int(invalid[0]), -1, world.size):
        with pytest.raises(StateError):
            policy.step(index, 0)


def test_unknown_names_are_refused_with_their_place(policy: Policy) -> None:
    with pytest.raises(StateError) as caught:
        policy.step({"box": {"in": "moon"}, "dog": {}}, 0)
    assert {place.pointer for place in caught.value.places} == {"/box/in", "/dog"}


def test_a_step_makes_up_nothing_that_was_not_observed(policy: Policy) -> None:
    with pytest.raises(StateError, match="missing: in of box, in of cylinder") as caught:
        policy.step({"robot": {"at": "kitchen"}, "box": {}}, 0)
    assert {(place.pointer, place.detail) for place in caught.value.places} == {
        ("/box/in", "missing"),
        ("/cylinder/in", "missing"),
    }
    # What is left out is said before a constraint that only the made-up rest would break.
    with pytest.raises(StateError, match="missing: at of robot"):
        policy.step({"box": {"in": "robot"}, "cylinder": {"in": "robot"}}, 0)


def test_at_most_twenty_missing_attributes_are_placed_and_their_names_escaped(policy: Policy) -> None:
    variables = (*(Variable(f"door {n}", "a/b", ("open",)) for n in range(23)), *policy.variables)
    with pytest.raises(StateError, match="and 6 more") as caught:
        replace(policy, variables=variables).step({}, 0)
    assert [place.pointer for place in caught.value.places] == [f"/door {n}/a~1b" for n in range(20)]


def test_where_no_action_is_enabled_a_step_is_waited_and_the_memory_moves_on() -> None:
    policy = plan(ArrayWorld(2, {0: {"go": {1: 1.0}}}, {"a": frozenset({1})}), parse("F (a & X X a)")).policy
    assert policy is not None
    memory, told = policy.initial_memory, []
    for state in (0, 1, 1, 1):
        step = policy.step(state, memory)
        told.append((step.action, step.status, step.expected_steps))
        memory = step.memory
    assert told == [("go", "running", 3), (None, "running", 2), (None, "running", 1), (None, "satisfied", 0)]


@pytest.mark.parametrize("memory", [-1, 99])
def test_an_unknown_memory_is_refused(policy: Policy, memory: int) -> None:
    with pytest.raises(InvalidMemoryError):
        policy.step(0, memory)


def test_a_lost_cause_is_said(world: World) -> None:
    found = plan(
        world, parse("!at(robot, kitchen) U in(cylinder, box)"), initial=world.encode({"robot": {"at": "bedroom"}})
    )
    assert found.policy is not None
    there = world.decode(world.encode({"robot": {"at": "kitchen"}}))
    step = found.policy.step(there, found.policy.initial_memory)
    assert (step.status, step.action, step.done, step.probability) == ("lost", None, False, 0.0)


def test_bytes_read_back_equal(policy: Policy) -> None:
    again = from_bytes(to_bytes(policy))
    for name in Policy.__slots__:
        before, after = getattr(policy, name), getattr(again, name)
        if isinstance(before, np.ndarray):
            assert np.array_equal(before, after)
            assert before.dtype == after.dtype
        else:
            assert before == after
    assert to_bytes(again) == to_bytes(policy)


def test_bytes_are_compact(policy: Policy) -> None:
    assert len(to_bytes(policy)) < 24 * policy.action.size / 4 + 2_000


def test_damaged_bytes_are_refused(policy: Policy) -> None:
    data = to_bytes(policy)
    header = data.index(b"{")
    damaged = [b"", b"cqltl", data[:-1], data[: len(data) // 2], data[:20] + b"\xff" + data[21:], data[:12]]
    damaged.append(data[:8] + (2**32 - 1).to_bytes(4, "little") + data[12:])
    damaged.append(data[:header] + data[header:].replace(b'"accepted":[0', b'"accepted":[1,0', 1))
    for bad in damaged:
        with pytest.raises(InvalidPolicyError):
            from_bytes(bad)


def test_json_decodes_as_documented(world: World, policy: Policy) -> None:
    data = json.loads(json.dumps(to_json(policy), allow_nan=False))
    for index in np.flatnonzero(world.valid()).tolist():
        named = world.decode(index)
        number = sum(v["stride"] * v["values"].index(named[v["object"]][v["attribute"]]) for v in data["variables"])
        assert number == index
        for memory in range(data["memories"]):
            step = policy.step(index, memory)
            automaton = data["automaton"]
            after = automaton["successors"][memory][data["letter"][number]]
            assert after == step.memory
            assert bool(automaton["accepted"][after]) == step.done
            row = automaton["row"][after]
            if row < 0:
                assert (step.action, step.probability, step.expected_steps) == (None, float(step.done), 0.0)
                continue
            entry = row * data["places"] + number
            action = data["action"][entry]
            assert (data["actions"][action] if action >= 0 else None) == step.action
            assert data["probability"][entry] == pytest.approx(step.probability, abs=1e-9)
            assert data["expected_steps"][entry] == pytest.approx(step.expected_steps, abs=1e-8)
    assert data["initial"] == {"state": world.initial, "memory": policy.initial_memory}


def test_simulation_is_seeded(world: World, policy: Policy) -> None:
    first, second, other = (simulate(world, policy, runs=200, seed=seed) for seed in (1, 1, 2))
    assert np.array_equal(first.steps, second.steps)
    assert not np.array_equal(first.steps, other.steps)


def test_simulation_cuts_off_what_does_not_end(world: World, policy: Policy) -> None:
    runs = simulate(world, policy, runs=20, seed=0, max_steps=2)
    assert not runs.decided.any()
    assert runs.steps.tolist() == [2] * 20
