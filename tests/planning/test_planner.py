"""The answer as a whole: progress, cancellation, initial states, sizes, what is reached when time is short."""

from __future__ import annotations

import math
from itertools import pairwise

import pytest

from models.logic import parse
from models.planning import Options, plan, simulate
from models.world import StateError
from tests.planning.doubles import ArrayWorld

SLOW = ArrayWorld(3, {0: {"go": {0: 0.9, 1: 0.05, 2: 0.05}}, 2: {"go": {2: 1.0}}}, {"a": frozenset({1})})


def test_progress_hears_of_every_sweep_with_bounds_that_tighten() -> None:
    heard: list[tuple[str, int, float, float, int]] = []
    result = plan(SLOW, parse("F a"), progress=lambda *event: heard.append(event))
    stages = [event[0] for event in heard]
    assert stages == sorted(stages, key=["compile", "graph", "probability", "steps", "evaluate"].index)
    for stage in ("probability", "steps"):
        sweeps = [event for event in heard if event[0] == stage]
        numbers = [event[1] for event in sweeps]
        assert numbers == sorted(numbers)
        assert sorted(set(numbers)) == list(range(1, numbers[-1] + 1))
        assert all(a[2] <= b[2] and a[3] >= b[3] for a, b in pairwise(sweeps))
    last = [event for event in heard if event[0] == "probability"][-1]
    assert last[2] <= result.lower + 1e-9
    assert last[3] == result.upper


def test_an_exception_from_progress_cancels() -> None:
    class StopError(Exception):
        pass

    def stop(stage: str, sweep: int, lower: float, upper: float, states: int, left: float = 0) -> None:
        if stage == "probability" and sweep == 3:
            raise StopError

    with pytest.raises(StopError):
        plan(SLOW, parse("F a"), progress=stop)


def test_an_answer_cut_short_says_what_was_reached_and_its_policy_still_decides() -> None:
    result = plan(SLOW, parse("F a"), options=Options(max_sweeps=2))
    assert result.lower < 0.5 < result.upper
    assert result.upper - result.lower > 1e-6
    assert result.expected_steps is not None
    assert result.expected_steps_upper is not None
    assert result.expected_steps <= 10 <= result.expected_steps_upper
    assert result.policy is not None
    assert simulate(SLOW, result.policy, runs=50, seed=0).decided.all()


def test_steps_without_a_bound_are_infinite_and_the_policy_still_proper() -> None:
    walk = ArrayWorld(
        40, {s: {"back": {max(s - 1, 0): 1.0}, "on": {s + 1: 0.5, s: 0.5}} for s in range(39)}, {"a": frozenset({39})}
    )
    result = plan(walk, parse("F a"), options=Options(max_sweeps=1))
    assert (result.lower, result.upper) == (1.0, 1.0)
    assert result.policy is not None
    assert result.expected_steps_upper == math.inf or result.expected_steps_upper >= 78
    assert simulate(walk, result.policy, runs=20, seed=0).satisfied.all()


def test_the_initial_state_may_be_another() -> None:
    assert plan(SLOW, parse("F a"), initial=1).expected_steps == 0
    assert plan(SLOW, parse("F a"), initial=2).outcome == "unreachable"


def test_an_initial_state_that_is_none_is_refused() -> None:
    forbidden = ArrayWorld(2, {0: {"go": {0: 1.0}}}, {"a": frozenset()}, forbidden=frozenset({1}))
    for state in (-1, 1, 2):
        with pytest.raises(StateError):
            plan(forbidden, parse("F a"), initial=state)


def test_sizes_are_those_of_world_and_automaton() -> None:
    sizes = plan(SLOW, parse("F a")).sizes
    assert (sizes.states, sizes.product_states, sizes.automaton_states) == (3, 6, 2)


@pytest.mark.parametrize(
    "wrong", [{"epsilon": 0.0}, {"epsilon": 2.0}, {"max_states": 0}, {"max_bytes": 2**40}, {"device": "abacus"}]
)
def test_options_out_of_range_are_refused(wrong: dict[str, object]) -> None:
    with pytest.raises(ValueError, match=r".+"):
        Options(**wrong)  # type: ignore[arg-type]


def test_a_hurried_plan_answers_with_bounds_that_hold() -> None:
    """A walk that wins or loses at its ends mixes far too slowly for a few sweeps; the true value is 1/2."""
    size = 4_001  # more than are solved directly
    moves = {s: {"go": {s - 1: 0.5, s + 1: 0.5}} for s in range(1, size - 1)}
    world = ArrayWorld(size, moves, {"a": frozenset({size - 1})})
    asked: list[str] = []

    def hurry(stage: str) -> bool:
        asked.append(stage)
        return asked.count(stage) > 3

    result = plan(world, parse("F a"), initial=size // 2, options=Options(hurry=hurry))
    assert result.outcome == "solved"
    assert result.lower <= 0.5 <= result.upper
    assert result.upper - result.lower > 0.1
    assert {"probability", "steps"} <= set(asked)
    assert len(asked) < 20
