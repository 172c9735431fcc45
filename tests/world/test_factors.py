"""The small tables of a world against what the world itself says, state by state, and guards as ranges."""

from __future__ import annotations

import operator
from collections.abc import Iterable
from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from numpy.typing import NDArray

from models.world import (
    Factored,
    OomdpWorld,
    Range,
    builtin_environments,
    compile_world,
    load_environment,
    navigation_spec,
    toys_spec,
)
from models.world.algebra import Algebra, Box, Combined, Table, Value, evaluate
from models.world.factors import UNBOUNDED, ranges_of
from tests.world.worlds import SWITCHES, changed

RADIX = (3, 2, 4)
SWAP = {
    "name": "swap",
    "kind": "oomdp",
    "domain_spec": {
        "name": "swap",
        "attributes": {"power": ["off", "on"]},
        "classes": {"spot": {}, "thing": {"state": {"at": "spot"}}, "lamp": {"state": {"power": "power"}}},
        "constants": {"a": "thing", "b": "thing", "lamp": "lamp"},
        "actions": {
            "swap": {
                "when": "a.at != b.at implies lamp.power == on",
                "outcomes": [
                    {"probability": "0.5 if lamp.power == on else 1", "set": {"a.at": "b.at", "b.at": "a.at"}},
                    {"probability": "0.5 if lamp.power == on else 0", "set": {"lamp.power": "off"}},
                ],
            },
            "light": {"when": "lamp.power == off", "outcomes": [{"set": {"lamp.power": "on"}}]},
        },
    },
    "objects": {name: {"class": "spot"} for name in ("left", "middle", "right")},
    "state": {"a": {"at": "left"}, "b": {"at": "right"}, "lamp": {"power": "off"}},
}
SHARES = (
    ("domain_spec/actions/flip/outcomes/0/probability", "count(x: lamp; bright(x)) / 4"),
    ("domain_spec/actions/flip/outcomes/1/probability", "1 - count(x: lamp; bright(x)) / 4"),
)
MOST = 5_000
WORLDS: dict[str, Any] = {
    **dict(builtin_environments()),
    "switches": SWITCHES,
    "shares": changed(SWITCHES, *SHARES),
    "swap": SWAP,
    "one room": toys_spec(columns=1, rows=1, toys=1, slip=0.5),
    "many toys": toys_spec(columns=2, rows=1, toys=4, slip=0.1),
    "walls": navigation_spec(columns=4, rows=3, slip=0.3, blocked=[(2, 2)], walls=[("home", "place_2_1")]),
}


def world_of(data: Any) -> OomdpWorld:
    world = compile_world(load_environment(data))
    assert isinstance(world, OomdpWorld)
    return world


def digits_of(world: Factored) -> NDArray[np.int64]:
    """[variables, states]"""
    return np.stack(np.unravel_index(np.arange(np.prod(world.radix)), world.radix))


def hold(ranges: Iterable[Range], digits: NDArray[np.int64]) -> NDArray[np.bool_]:
    """In which states all ranges hold."""
    result = np.ones(digits.shape[1], dtype=np.bool_)
    for one in ranges:
        total = sum(table.array.astype(np.int64)[tuple(digits[v] for v in table.scope)] for table in one.tables)
        result &= (one.low <= total) & (total <= one.high)
    return result


def check(world: OomdpWorld) -> None:
    """Validity, guards and outcomes of the tables are the world's; outcomes in at most MOST states of each action."""
    factored = world.factored
    assert factored is not None
    digits = digits_of(factored)
    valid = hold(factored.valid, digits)
    assert (valid == world.valid()).all()
    assert [action.index for action in factored.actions] == list(range(len(world.actions)))
    for action in factored.actions:
        known = world.outcomes(action.index)
        assert (hold(action.ranges, digits)[valid] == known.enabled[valid]).all()
        radix = [factored.radix[v] for v in action.scope]
        places = np.ravel_multi_index([digits[v] for v in action.scope], radix) if radix else np.zeros_like(digits[0])
        states = np.flatnonzero(valid & known.enabled)
        if len(states) > MOST:
            states = np.random.default_rng(action.index).choice(states, MOST, replace=False)
        for state in states.tolist():
            found = distribution(action.probability[:, places[state]], state + action.shift[:, places[state]])
            expected = distribution(known.probability[:, state], known.successor[:, state])
            assert found == pytest.approx(expected, abs=1e-15)


def distribution(probability: NDArray[np.float64], successor: NDArray[np.int64]) -> dict[int, float]:
    kept = probability > 0
    found = dict(zip(successor[kept].tolist(), probability[kept].tolist(), strict=True))
    assert len(found) == kept.sum(), "outcomes with the same successor are merged"
    return found


@pytest.mark.parametrize("name", WORLDS)
def test_the_tables_are_the_world(name: str) -> None:
    check(world_of(WORLDS[name]))


@given(st.integers(1, 3), st.integers(1, 2), st.integers(0, 2), st.sampled_from([0.0, 0.25, 1.0]), st.integers(0, 99))
@settings(max_examples=15, deadline=None)
def test_toys_of_any_size(columns: int, rows: int, toys: int, slip: float, seed: int) -> None:
    check(world_of(toys_spec(columns=columns, rows=rows, toys=toys, slip=slip, seed=seed)))


@pytest.mark.parametrize("entries", [1, 4, 8, 64])
def test_where_tables_are_small_they_are_right_or_there_are_none(monkeypatch: pytest.MonkeyPatch, entries: int) -> None:
    for limit in ("algebra.MAX_TABLE", "actions.MAX_TABLE", "factors.WIDE"):
        monkeypatch.setattr(f"models.world.{limit}", entries)
    world = world_of(SWITCHES)
    assert (world.factored is None) == (entries < 4)  # what `go` does takes a table of four entries
    if entries >= 4:
        check(world)


def test_a_world_too_large_to_number_has_no_tables() -> None:
    assert world_of(toys_spec(columns=5, rows=2, toys=24)).factored is None


def test_actions_change_what_they_set() -> None:
    world = world_of(WORLDS["swap"])
    assert world.factored is not None
    assert [(world.actions[a.index], a.changes) for a in world.factored.actions] == [
        ("swap", {0, 1, 2}),
        ("light", {2}),
    ]


# Guards as ranges.

A = Table((0,), np.array([True, False, True]))
B = Table((1,), np.array([False, True]))
C = Table((2,), np.array([False, False, True, True]))
YES, NO = Table((), np.array(True)), Table((), np.array(False))


def number(n: float) -> Table:
    return Table((), np.array(n))


def both(operation: Any, *parts: Value, folds: bool = True) -> Combined:
    """As the algebra makes it of what is too large for a table."""
    return Combined(tuple(sorted({v for part in parts for v in part.scope})), operation, parts, folds)


def counted(*parts: Table) -> Combined:
    return both(np.add, *(Table(part.scope, part.array.astype(np.int16)) for part in parts))


def agrees(value: Value, *, holds: bool = True) -> tuple[Range, ...] | None:
    """The ranges of a value, after comparing them with it everywhere."""
    found = ranges_of(Algebra(RADIX), value, holds=holds)
    if found is not None:
        box = Box(RADIX, (0, 1, 2))
        truth = np.broadcast_to(evaluate(value, box), box.shape).reshape(-1)
        digits = np.stack(np.unravel_index(np.arange(24), RADIX))
        assert (hold(found, digits) == (truth == holds)).all()
    return found


def bounds(found: tuple[Range, ...] | None) -> list[tuple[int, int, int]]:
    """Number of terms and ends of each range."""
    assert found is not None
    return [(len(one.tables), one.low, one.high) for one in found]


def test_constants() -> None:
    assert agrees(YES) == ()
    assert agrees(NO, holds=False) == ()
    assert bounds(agrees(NO)) == [(1, 1, UNBOUNDED)]
    assert bounds(agrees(YES, holds=False)) == [(1, 0, 0)]


def test_a_conjunction_is_a_range_for_each_part() -> None:
    assert len(agrees(both(np.logical_and, A, B, C)) or ()) == 3
    assert len(agrees(both(np.logical_or, A, B, C), holds=False) or ()) == 3
    assert (
        len(agrees(both(np.logical_and, both(np.logical_and, A, B), both(np.logical_not, C, folds=False))) or ()) == 3
    )


def test_a_disjunction_is_one_range() -> None:
    assert bounds(agrees(both(np.logical_or, A, B, C))) == [(3, 1, UNBOUNDED)]
    assert bounds(agrees(both(np.logical_and, A, B, C), holds=False)) == [(3, 1, UNBOUNDED)]


@pytest.mark.parametrize("holds", [True, False])
@pytest.mark.parametrize("limit", [-1, 0, 1, 2, 3, 4, 2.0])
@pytest.mark.parametrize("compare", [operator.le, operator.lt, operator.ge, operator.gt])
def test_counts_are_one_range_whichever_side_the_number_is_on(compare: Any, limit: float, holds: bool) -> None:
    for parts in ((counted(A, B, C), number(limit)), (number(limit), counted(A, B, C))):
        found = agrees(both(compare, *parts, folds=False), holds=holds)
        assert [terms for terms, _, _ in bounds(found)] == [3]


@pytest.mark.parametrize("parts", [(counted(A, B, C), number(2)), (number(2), counted(A, B, C))])
def test_counts_that_are_just_so(parts: tuple[Value, ...], monkeypatch: pytest.MonkeyPatch) -> None:
    assert bounds(agrees(both(operator.eq, *parts, folds=False))) == [(3, 2, 2)]
    assert len(agrees(both(operator.eq, *parts, folds=False), holds=False) or ()) == 1  # tabulated
    monkeypatch.setattr("models.world.factors.WIDE", 0)
    assert agrees(both(operator.eq, *parts, folds=False), holds=False) is None


@pytest.mark.parametrize("limit", [1.5, float("inf"), float("nan"), 3e9, -3e9, 1e30])
@pytest.mark.parametrize("compare", [operator.le, operator.lt, operator.ge, operator.gt, operator.eq])
def test_a_count_may_be_compared_with_any_number(compare: Any, limit: float) -> None:
    assert agrees(both(compare, counted(A, B, C), number(limit), folds=False)) is not None


def test_what_has_no_such_form(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("models.world.factors.WIDE", 0)
    apart = both(operator.ne, A, B, folds=False)
    for value in (
        apart,
        both(np.logical_and, A, apart),
        both(np.logical_or, A, apart),
        both(np.logical_or, both(np.logical_and, A, B), C),
        both(operator.le, counted(A, B), counted(B, C), folds=False),
        both(operator.le, counted(A, B), number(1.5), folds=False),
        both(operator.lt, Table((0,), np.array([0.5, 1.5, 2.5])), number(1), folds=False),
    ):
        assert agrees(value) is None


tables = st.sampled_from([(0,), (1,), (2,), (0, 1), (1, 2), ()]).flatmap(
    lambda scope: st.lists(st.booleans(), min_size=24, max_size=24).map(
        lambda bits: Table(scope, np.resize(np.array(bits), [RADIX[v] for v in scope]))
    )
)
compared = st.builds(
    lambda compare, parts, limit, left: both(
        compare, *((number(limit), counted(*parts)) if left else (counted(*parts), number(limit))), folds=False
    ),
    st.sampled_from([operator.le, operator.lt, operator.ge, operator.gt, operator.eq, operator.ne]),
    st.lists(tables, min_size=2, max_size=4),
    st.sampled_from([-1, 0, 1, 2, 2.5, 3]),
    st.booleans(),
)
values = st.recursive(
    st.one_of(tables, compared),
    lambda inner: st.one_of(
        inner.map(lambda value: both(np.logical_not, value, folds=False)),
        st.builds(
            lambda operation, parts: both(operation, *parts),
            st.sampled_from([np.logical_and, np.logical_or]),
            st.lists(inner, min_size=2, max_size=3),
        ),
    ),
    max_leaves=6,
)


@given(values, st.booleans())
@settings(max_examples=100, deadline=None)
def test_ranges_hold_where_the_value_does(value: Value, holds: bool) -> None:
    agrees(value, holds=holds)
