"""Single runs of a policy, against the plan's own values and its trajectory."""

from __future__ import annotations

from itertools import pairwise

import numpy as np
import pytest

from models.logic import parse
from models.planning import InvalidMemoryError, likeliest_run, plan, run
from models.world import StateError, compile_world, load_environment, toys_spec

WORLD = compile_world(load_environment(toys_spec(columns=3, rows=1, toys=1, slip=0.3)))
PLAN = plan(WORLD, parse("F (in(cylinder, box) & at(box, kitchen))"))


def test_the_mean_length_of_runs_is_what_the_plan_expects() -> None:
    policy = PLAN.policy
    assert policy is not None
    lengths = np.array([len(run(WORLD, policy, seed=seed, max_steps=1_000)) - 1 for seed in range(600)])
    deviation = lengths.std() / np.sqrt(len(lengths))
    assert abs(lengths.mean() - policy.step(policy.initial_state, policy.initial_memory).expected_steps) < 4 * deviation


def test_a_run_follows_the_policy_and_the_world() -> None:
    policy = PLAN.policy
    assert policy is not None
    steps = run(WORLD, policy, seed=7, max_steps=1_000)
    assert (steps[0].state, steps[0].memory) == (policy.initial_state, policy.initial_memory)
    assert [s.step.status for s in steps[:-1]] == ["running"] * (len(steps) - 1)
    assert steps[-1].step.status == "satisfied"
    for before, after in pairwise(steps):
        assert before.step == policy.step(before.state, before.memory)
        assert after.memory == before.step.memory
        assert before.step.action is not None
        outcomes = WORLD.outcomes(WORLD.actions.index(before.step.action), np.array([before.state]))
        assert after.state in outcomes.successor[outcomes.probability[:, 0] > 0, 0]
    assert run(WORLD, policy, seed=7, max_steps=1_000) == steps
    assert run(WORLD, policy, seed=8, max_steps=1_000) != steps


def test_a_run_goes_on_from_any_step_and_is_cut_off() -> None:
    policy = PLAN.policy
    assert policy is not None
    steps = run(WORLD, policy, seed=1, max_steps=2)
    assert len(steps) == 3
    further = run(WORLD, policy, seed=1, max_steps=1_000, state=steps[-1].state, memory=steps[-1].memory)
    assert further[0] == steps[-1]
    assert further[-1].step.status == "satisfied"


def test_what_the_policy_does_not_have_is_refused() -> None:
    policy = PLAN.policy
    assert policy is not None
    with pytest.raises(InvalidMemoryError):
        run(WORLD, policy, seed=0, max_steps=1, memory=99)
    with pytest.raises(StateError):
        run(WORLD, policy, seed=0, max_steps=1, state=WORLD.size)


@pytest.mark.parametrize("formula", ["F holding(cylinder)", "G F at(robot, kitchen) & G F at(robot, bathroom)"])
def test_the_likeliest_run_is_the_trajectory_of_the_plan(formula: str) -> None:
    found = plan(WORLD, parse(formula))
    assert found.policy is not None
    assert likeliest_run(WORLD, found.policy) == found.trajectory
