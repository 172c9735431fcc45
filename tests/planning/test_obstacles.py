"""Why a goal cannot be reached: small worlds by hand, and random ones against exact probabilities."""

from __future__ import annotations

import random

import pytest

from models.logic import Atom, Binary, Formula, Op, Unary, conjunction, equivalent, is_satisfiable, parse, to_text
from models.planning import Options, Plan, plan
from models.planning import obstacles as module
from models.world import builtin_environments, compile_world, explain, load_environment, resolve
from tests.planning import brute
from tests.planning.doubles import ArrayWorld, random_world
from tests.planning.test_random_models import random_formula, solve

LINE = ArrayWorld(
    5,
    {0: {"go": {1: 1.0}}, 1: {"go": {2: 0.5, 0: 0.5}}, 2: {"go": {3: 1.0}}, 3: {"go": {2: 1.0}}, 4: {}},
    {"a": frozenset({0}), "b": frozenset({3}), "c": frozenset({4}), "d": frozenset({0, 1, 2, 3}), "e": frozenset({2})},
)
"""0 and 1, from there no way back 2 and 3, and 4, which nothing leads to."""


def why(found: Plan) -> list[str]:
    assert found.outcome == "unreachable"
    return [to_text(fact) for fact in found.obstacles]


@pytest.mark.parametrize(
    ("goal", "expected"),
    [
        ("F c", ["G !c"]),
        ("F !d", ["G d"]),
        ("b", ["!b"]),
        ("G !a", ["a"]),
        ("F (b & e)", ["G !(b & e)"]),
        ("F (b & F a)", ["G (b -> G !a)"]),
        ("F (c & b)", ["G !c"]),
        ("F (c & !d)", ["G !c", "G d"]),  # each alone
        ("F c | F (b & e)", ["G !c", "G !(b & e)"]),  # both together
        ("X b", []),  # which is there, and later
    ],
)
def test_by_hand(goal: str, expected: list[str]) -> None:
    assert why(plan(LINE, parse(goal))) == expected


def test_what_can_be_done_has_none() -> None:
    assert plan(LINE, parse("F b")).obstacles == ()
    assert plan(LINE, parse("F b & G !b")).obstacles == ()  # which no world could


def test_with_too_many_states_none_are_known(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(module, "MOST_STATES", 3)
    assert why(plan(LINE, parse("F c"))) == []


def test_without_time_none_are_known() -> None:
    hurried = Options(hurry=lambda stage: stage == "evaluate")
    assert why(plan(LINE, parse("F c"), options=hurried)) == []


def test_with_many_propositions_they_are_looked_at_one_by_one(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(module, "MOST_ATOMS", 1)
    assert why(plan(LINE, parse("F (b & e)"))) == []
    assert why(plan(LINE, parse("F (b & c)"))) == ["G !c"]


def test_in_english() -> None:
    """The robot of the toys has one hand."""
    toys = load_environment(dict(builtin_environments())["toys"])
    goal = resolve(parse("F (holding(sphere) & holding(cylinder))"), toys)
    (fact,) = plan(compile_world(toys), goal).obstacles
    said = explain(fact, toys)
    assert said.startswith("never both")
    assert "holding the sphere" in said


def negated(fact: Formula) -> brute.LTL:
    """The negation of a fact, which is co-safe."""
    match fact:
        case Atom():
            return ("not", fact.function)
        case Unary(op=Op.NOT, operand=Atom() as atom):
            return ("ap", atom.function)
        case Unary(op=Op.GLOBALLY, operand=Binary(op=Op.IMPLIES, left=Atom() as one, right=later)):
            return ("F", ("and", ("ap", one.function), negated(later)))
        case Unary(op=Op.GLOBALLY, operand=Unary(op=Op.NOT, operand=inner)) if not isinstance(inner, Atom):
            one, other = inner.operands  # type: ignore[union-attr]
            return ("F", ("and", ("ap", one.function), ("ap", other.function)))  # type: ignore[union-attr]
        case Unary(op=Op.GLOBALLY, operand=inner):
            return ("F", negated(inner))
    raise AssertionError(fact)


def test_facts_hold_in_every_run_and_leave_no_way_to_the_goal() -> None:
    kinds = set()
    for seed in range(400):
        world, pick = random_world(seed), random.Random(seed)
        goal = parse(brute.text(random_formula(pick, 2)))
        found = plan(world, goal)
        if found.outcome == "solved":
            continue
        for fact in found.obstacles:
            kinds.add(type(fact.operand if isinstance(fact, Unary) else fact))
            assert solve(world, negated(fact)).probability == 0
        assert not found.obstacles or not is_satisfiable(conjunction(goal, *found.obstacles))
    assert kinds == {Atom, Unary, Binary}


def test_none_that_are_together_needed_can_be_left_out() -> None:
    first, second = plan(LINE, parse("F c | F (b & e)")).obstacles
    goal = parse("F c | F (b & e)")
    assert all(is_satisfiable(conjunction(goal, fact)) for fact in (first, second))
    assert equivalent(conjunction(goal, first, second), parse("false"))


def test_many_ways_from_one_state_to_another_are_a_way() -> None:
    back = {f"back{number}": {0: 1.0} for number in range(256)}
    world = ArrayWorld(
        3, {0: {"go": {1: 1.0}}, 1: back, 2: {}}, {"a": frozenset({0}), "b": frozenset({1}), "c": frozenset({2})}
    )
    assert why(plan(world, parse("F (b & F a & F c)"))) == ["G !c"]
