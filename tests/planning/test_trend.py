"""How many sweeps are left: exact where a measure shrinks evenly, and what the planner tells of its iterations."""

from __future__ import annotations

import math
import random
from typing import Any

import pytest
from hypothesis import given
from hypothesis import strategies as st

from models.logic import parse
from models.planning import Options, plan
from models.planning.trend import WINDOW, Trend
from models.world import compile_world, load_environment, toys_spec
from tests.planning.doubles import ArrayWorld


@given(st.floats(0.01, 0.99), st.floats(1e-12, 1e-3), st.integers(2, 3 * WINDOW))
def test_an_even_shrinkage_is_extrapolated_exactly(ratio: float, aim: float, sweeps: int) -> None:
    trend = Trend(aim)
    left = [trend.left(ratio**sweep) for sweep in range(sweeps)]
    assert math.isnan(left[0])
    for sweep in range(1, sweeps):
        assert left[sweep] == pytest.approx(max(0.0, math.log(aim) / math.log(ratio) - sweep), rel=1e-6, abs=1e-6)


def test_it_goes_by_the_last_sweeps() -> None:
    """A tenth in each of the first sweeps, then half: eleven times more."""
    trend = Trend(1e-20 * 2.0**-50)
    for sweep in range(20):
        trend.left(10.0**-sweep)
    for sweep in range(WINDOW):
        left = trend.left(1e-20 * 2.0**-sweep)
    assert left == pytest.approx(50 - (WINDOW - 1))


def test_a_pause_goes_by_all_sweeps_and_a_setback_is_none() -> None:
    trend = Trend(0.25)
    for measure in (4.0, 2.0):
        trend.left(measure)
    assert trend.left(3.0) == pytest.approx(6)  # it halved in two sweeps, and has to three times more
    for _ in range(WINDOW):
        left = trend.left(2.0)
    assert left == pytest.approx(3 * (WINDOW + 2))


def test_no_rate_no_estimate_and_no_more_sweeps_than_there_may_be() -> None:
    trend = Trend(0.5, most=10)
    assert math.isnan(trend.left(8.0))
    assert math.isnan(trend.left(9.0))
    assert trend.left(8.0 - 1e-9) == 7
    assert Trend(0.5).left(0.0) == Trend(0.5).left(0.5) == 0


def slow(length: int, stay: float) -> ArrayWorld:
    """A chain that falls back to its beginning with some probability and is lost with a small one."""
    moves = {i: {"go": {i + 1: 1 - stay - 0.001, 0: stay, length + 1: 0.001}} for i in range(length)}
    moves |= {length: {}, length + 1: {}}
    return ArrayWorld(length + 2, moves, {"a": frozenset({length})})


def heard(world: Any, formula: str, **options: Any) -> dict[str, list[tuple[int, float]]]:
    told: dict[str, list[tuple[int, float]]] = {}

    def hear(stage: str, sweep: int, lower: float, upper: float, states: int, left: float = math.nan) -> None:
        told.setdefault(stage, []).append((sweep, left))

    plan(world, parse(formula), options=Options(**options), progress=hear)
    return told


@pytest.mark.parametrize("stage", ["probability", "steps"])
def test_iterations_tell_how_many_sweeps_are_left(stage: str) -> None:
    """From the third sweep on there is an estimate; at half time it is right within a factor of two, at the end 0."""
    told = heard(slow(3_000, 0.002), "F a")[stage]
    assert len(told) > 5
    assert all(not math.isnan(left) for sweep, left in told if sweep > 2)
    last = max(sweep for sweep, _ in told)
    halfway, left = next((sweep, left) for sweep, left in told if sweep >= last // 2)
    assert (last - halfway) / 2 <= left + 1
    assert left <= 2 * (last - halfway) + 1
    assert told[-1][1] == 0


def test_dense_sweeps_tell_too() -> None:
    world = compile_world(load_environment(toys_spec(columns=5, rows=5, toys=2, slip=0.1)))
    told = heard(world, "F (in(cylinder, box) & F at(box, kitchen))", relevance=False)["steps"]
    assert told[-1][1] == 0
    assert any(left > 0 for _, left in told[:-1])


def test_rounds_tell_too() -> None:
    pick = random.Random(1)
    count = 6_000
    moves = {i: {a: {(i + 1) % count: 0.5, pick.randrange(count): 0.5} for a in ("b", "c")} for i in range(count)}
    told = heard(ArrayWorld(count, moves, {"a": frozenset(range(0, count, 100))}), "G F a")["rounds"]
    unknown = [math.isnan(left) for _, left in told]
    assert told[-1][1] == 0
    assert unknown == sorted(unknown, reverse=True)  # until every state has heard of the mark, and not again
    assert sum(unknown) < len(told) / 2


def test_what_is_listed_is_counted(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("models.planning.compiled.BLOCK", 100)
    told = heard(slow(298, 0.0), "F a")["compile"]
    assert told == [(1, 2), (2, 1), (3, 0)]
