"""Worlds too large to plan for as a whole, of which few states can be reached."""

from __future__ import annotations

import numpy as np
import pytest

from models.logic import parse
from models.planning import ModelTooLargeError, Options, check, from_bytes, plan, simulate, to_bytes, to_json
from models.world import OomdpWorld, StateError, compile_world, load_environment, toys_spec
from tests.world.test_reachable import lock


def test_a_row_of_latches_is_planned_though_its_states_are_too_many() -> None:
    """Each latch opens with probability 1/2, in order: two steps each, and 2^40 states, 41 of which are reached."""
    world = lock(40, chance="0.5")
    result = plan(world, parse("F open(l39)"), options=Options(relevance=False))
    assert result.outcome == "solved"
    assert (result.lower, result.upper) == (1.0, 1.0)
    assert result.expected_steps == pytest.approx(80)
    assert result.sizes.states == 41
    assert result.policy is not None
    assert check(world, result.policy).expected_steps == pytest.approx(80)
    runs = simulate(world, result.policy, runs=200, seed=1)
    assert runs.success_rate == 1
    assert runs.mean_steps == pytest.approx(80, abs=5)


@pytest.mark.parametrize("formula", ["F open(l3)", "G !open(l2)", "G F open(l0) & F open(l1)", "!open(l1) U open(l4)"])
@pytest.mark.parametrize("objective", ["max", "min"])
def test_the_reachable_part_has_the_plans_of_the_whole(formula: str, objective: str) -> None:
    world = lock(6, chance="0.5")
    whole = plan(world, parse(formula), options=Options(relevance=False, objective=objective))  # type: ignore[arg-type]
    few = Options(relevance=False, objective=objective, max_states=60)  # type: ignore[arg-type]
    part = plan(world, parse(formula), options=few)
    assert part.outcome == whole.outcome
    assert (part.lower, part.upper) == (whole.lower, whole.upper)
    if part.policy is not None and whole.policy is not None:
        assert part.expected_steps == pytest.approx(whole.expected_steps)
        assert part.policy.indices is not None
        assert part.policy.places == 7
        assert whole.policy.indices is None
        for opened in range(7):
            index = 2**6 - 2 ** (6 - opened)  # the first latches are the most significant digits
            for memory in range(part.policy.memories):
                assert part.policy.step(index, memory).action == whole.policy.step(index, memory).action


def test_its_policy_says_that_a_state_was_not_planned_for() -> None:
    world = lock(40)
    policy = plan(world, parse("F open(l39)"), options=Options(relevance=False)).policy
    assert policy is not None
    with pytest.raises(StateError, match="plan again"):
        policy.step(1, 0)
    assert policy.planned(np.array([0, 1])).tolist() == [True, False]


def test_its_policy_is_stored_and_written_as_json() -> None:
    world = lock(40)
    policy = plan(world, parse("F open(l39)"), options=Options(relevance=False)).policy
    assert policy is not None
    data = to_bytes(policy)
    again = from_bytes(data)
    assert to_bytes(again) == data
    written = to_json(again)
    assert len(written["indices"]) == written["places"] == 41
    state = written["indices"].index(2**39)  # the first latch is open
    entry = written["automaton"]["row"][written["automaton"]["successors"][0][written["letter"][state]]] * 41 + state
    assert written["actions"][written["action"][entry]] == "push(l1)"


def test_what_reaches_too_much_is_refused_with_the_size_of_the_whole() -> None:
    world = compile_world(load_environment(toys_spec(columns=2, toys=2)))
    assert isinstance(world, OomdpWorld)
    with pytest.raises(ModelTooLargeError) as caught:
        plan(world, parse("F in(cylinder, box)"), options=Options(relevance=False, max_states=20))
    assert caught.value.estimate == 2 * world.size
