"""The policy as a value, as bytes, as JSON, and run by run."""

from __future__ import annotations

import json
from itertools import pairwise

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
from models.world import StateError, World, compile_world, load_environment, toys_spec
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
    held = {"box": {"in": "robot"}, "cylinder": {"in": "robot"}}
    with pytest.raises(StateError):
        policy.step(held, 0)
    invalid = np.flatnonzero(~world.valid())
    assert len(invalid)
    assert (policy.action[:, invalid] == -1).all()
    assert (policy.next_memory[:, invalid] == -1).all()
    for index in (int(invalid[0]), -1, world.size):
        with pytest.raises(StateError):
            policy.step(index, 0)


def test_unknown_names_are_refused_with_their_place(policy: Policy) -> None:
    with pytest.raises(StateError) as caught:
        policy.step({"box": {"in": "moon"}, "dog": {}}, 0)
    assert {place.pointer for place in caught.value.places} == {"/box/in", "/dog"}


@pytest.mark.parametrize("memory", [-1, 99])
def test_an_unknown_memory_is_refused(policy: Policy, memory: int) -> None:
    with pytest.raises(InvalidMemoryError):
        policy.step(0, memory)


def test_a_lost_cause_is_said(world: World) -> None:
    found = plan(
        world, parse("!at(robot, kitchen) U in(cylinder, box)"), initial=world.encode({"robot": {"at": "bedroom"}})
    )
    assert found.policy is not None
    step = found.policy.step({"robot": {"at": "kitchen"}}, found.policy.initial_memory)
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
            entry = memory * data["states"] + number
            action = data["action"][entry]
            assert (data["actions"][action] if action >= 0 else None) == step.action
            assert data["next_memory"][entry] == step.memory
            assert bool(data["accepted"][step.memory]) == step.done
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


def test_the_trajectory_is_a_run_of_the_policy(world: World) -> None:
    result = plan(world, parse(TASK))
    assert result.policy is not None
    assert result.trajectory is not None
    assert result.trajectory.complete
    steps = result.trajectory.steps
    assert (steps[0].state, steps[0].memory) == (world.initial, result.initial_memory)
    for here, there in pairwise(steps):
        step = result.policy.step(here.state, here.memory)
        assert here.action is not None
        assert step.action == here.action
        answer = world.outcomes(world.actions.index(here.action), np.array([here.state]))
        assert there.state in answer.successor[answer.probability[:, 0] > 0, 0]
        assert there.memory == step.memory
    assert result.policy.step(steps[-1].state, steps[-1].memory).done


def test_the_trajectory_passes_over_what_changes_nothing() -> None:
    model = ArrayWorld(3, {0: {"try": {0: 0.8, 1: 0.1, 2: 0.1}}, 1: {"go": {2: 1.0}}}, {"a": frozenset({2})})
    found = plan(model, parse("F a")).trajectory
    assert found is not None
    assert [step.state for step in found.steps] == [0, 1, 2]


def test_the_trajectory_ends_where_only_visited_states_follow() -> None:
    # In 1 the likeliest way on that was not visited leads to 2, and from 2 only back.
    moves = {0: {"go": {1: 1.0}}, 1: {"go": {2: 0.9, 3: 0.1}}, 2: {"go": {1: 1.0}}}
    found = plan(ArrayWorld(4, moves, {"a": frozenset({3})}), parse("F a")).trajectory
    assert found is not None
    assert not found.complete
    assert [step.state for step in found.steps] == [0, 1, 2]
