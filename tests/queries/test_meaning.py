"""Meanings of compositions: written out by hand and compared by Spot, and on runs by what "done" means there."""

from __future__ import annotations

import pytest
from hypothesis import given
from hypothesis import strategies as st

from models.logic import Atom, Formula, Nary, Op, Unary, conjunction, disjunction, equivalent, parse
from models.queries import CompositionError, Operator, compose

A, B, C, D = (parse(f"F {name}") for name in "abcd")


def meaning(operator: str, *operands: str) -> Formula:
    return compose(Operator(operator), [parse(operand) for operand in operands])


@pytest.mark.parametrize(
    ("operator", "operands", "expected"),
    [
        ("then", ["F a", "F b"], "F (a & F b)"),
        ("then", ["F a", "F b", "F c"], "F (a & F (b & F c))"),
        ("then", ["F a & F b", "F c"], "F (a & F (b & F c)) | F (b & F (a & F c))"),
        ("then", ["F a | F b", "F c"], "F ((a | b) & F c)"),
        ("then", ["F a", "F b | F c"], "F (a & F (b | c))"),
        ("then", ["F (a & F b)", "F c"], "F (a & F (b & F c))"),
        ("then", ["F (a & F (a & b))", "F c"], "F (a & b & F c)"),
        ("then", ["F a & G !d", "F b"], "F (a & F b) & G !d"),
        ("then", ["F a", "G !d"], "F (a & G !d)"),
        ("then", ["F a", "F b & G !d"], "F (a & F b & G !d)"),
        ("then", ["F a", "G F b"], "F a & G F b"),
        ("then", ["!a U b", "F c"], "!a U (b & F c)"),
        ("then", ["F (a & c & G b)", "F d"], "F (a & c & G b & F d)"),
        ("then", ["X a", "F b"], "X (a & F b)"),
        ("then", ["a & b", "F c"], "a & b & F c"),
        ("and", ["F a", "F b", "F c"], "F a & F b & F c"),
        ("or", ["F a", "F b"], "F a | F b"),
        ("avoid", ["F a"], "G !a"),
        ("avoid", ["F (a & b)"], "G (!a | !b)"),
        ("avoid", ["F (a & F b)"], "G (a -> G !b)"),
        ("avoid", ["F a | F b"], "G !a & G !b"),
        ("avoid", ["G !a"], "F a"),
        ("avoid", ["X a"], "X !a"),
        ("avoid", ["a U b"], "!(a U b)"),
        ("until", ["G !a", "F b"], "!a U b"),
        ("until", ["G a", "F b"], "a U b"),
        ("until", ["G !a & G !d", "F b"], "(!a & !d) U b"),
        ("until", ["G !a", "F (b & F c)"], "!a U (b & (!a U c))"),
        ("until", ["G !a", "F b & F c"], "(!a U b) & (!a U c)"),
        ("until", ["G !a", "F b | F c"], "!a U (b | c)"),
        ("until", ["G !a", "!d U b"], "(!a & !d) U b"),
        ("until", ["G !a", "X b"], "!a & X b"),
        ("until", ["G !a", "F b & G !c"], "(!a U b) & G !c"),
        ("without", ["F a", "F b"], "F (a & !b)"),
        ("without", ["F (a & F b)", "F c"], "F (a & F (b & !c))"),
        ("without", ["F a", "F b | F c"], "F (a & !b & !c)"),
        ("repeat", ["F a"], "G F a"),
        ("repeat", ["F a & F b"], "G F a & G F b"),
        ("repeat", ["F a | F b"], "G F (a | b)"),
        ("repeat", ["F (a & F b)"], "G F a & G F b"),
    ],
)
def test_meanings(operator: str, operands: list[str], expected: str) -> None:
    assert equivalent(meaning(operator, *operands), parse(expected))


def test_avoid_in_four_ways() -> None:
    avoid = compose(Operator.AVOID, [B])
    assert equivalent(compose(Operator.AND, [A, avoid]), parse("F a & G !b"))
    assert equivalent(compose(Operator.UNTIL, [avoid, A]), parse("!b U a"))
    assert equivalent(compose(Operator.WITHOUT, [A, B]), parse("F (a & !b)"))
    assert equivalent(avoid, parse("G !b"))


@pytest.mark.parametrize(
    ("operator", "operands"),
    [
        ("then", ["G !a", "F b"]),
        ("then", ["G F a", "F b"]),
        ("then", ["F a | G b", "F c"]),
        ("then", ["F G a", "F b"]),
        ("then", ["a W b", "F c"]),
        ("until", ["F a", "F b"]),
        ("until", ["G F a", "F b"]),
        ("until", ["G !a", "G b"]),
        ("without", ["F a", "F (b & F c)"]),
        ("without", ["G a", "F b"]),
    ],
)
def test_what_has_no_meaning_is_refused(operator: str, operands: list[str]) -> None:
    with pytest.raises(CompositionError):
        meaning(operator, *operands)


ATOMS = st.sampled_from([Atom(name) for name in "abc"])


def _tasks(inner: st.SearchStrategy[Formula]) -> st.SearchStrategy[Formula]:
    """What can be done: `F` of a condition, which others may follow, and several of these."""
    later = st.builds(lambda now, then: Unary(Op.FINALLY, conjunction(now, then)), ATOMS, inner)
    several = st.lists(inner, min_size=2, max_size=3, unique=True)
    return later | several.map(lambda parts: conjunction(*parts)) | several.map(lambda parts: disjunction(*parts))


TASKS = st.recursive(ATOMS.map(lambda atom: Unary(Op.FINALLY, atom)), _tasks, max_leaves=4)
WORDS = st.lists(st.frozensets(st.sampled_from("abc")), min_size=1, max_size=6)


def done(task: Formula, word: list[frozenset[str]], start: int) -> set[int]:
    """When a task may be done that begins at `start`, on a word after which nothing holds."""
    match task:
        case Atom(function=name):
            return {start} if name in word[start] else set()
        case Unary(operand=operand):
            return {end for begin in range(start, len(word)) for end in done(operand, word, begin)}
        case Nary(op=Op.AND, operands=operands):
            ends = [done(operand, word, start) for operand in operands]
            found = {start}
            for some in ends:
                found = {max(one, other) for one in found for other in some}
            return found
        case _:
            return {end for operand in task.operands for end in done(operand, word, start)}  # type: ignore[union-attr]


@given(TASKS, TASKS, WORDS)
def test_then_begins_when_the_first_is_done(first: Formula, second: Formula, word: list[frozenset[str]]) -> None:
    expected = any(done(second, word, end) for end in done(first, word, 0))
    assert bool(done(compose(Operator.THEN, [first, second]), word, 0)) == expected


@given(TASKS, WORDS)
def test_avoid_is_never_done(task: Formula, word: list[frozenset[str]]) -> None:
    never = compose(Operator.AVOID, [task])
    assert holds(never, word, 0) == (not done(task, word, 0))


def holds(formula: Formula, word: list[frozenset[str]], at: int) -> bool:
    """LTL on the word, after which nothing holds."""
    here = word[at] if at < len(word) else frozenset[str]()
    times = range(at, max(at, len(word)) + 1)
    match formula:
        case Atom(function=name):
            return name in here
        case Unary(op=Op.NOT, operand=operand):
            return not holds(operand, word, at)
        case Unary(op=Op.FINALLY, operand=operand):
            return any(holds(operand, word, time) for time in times)
        case Unary(op=Op.GLOBALLY, operand=operand):
            return all(holds(operand, word, time) for time in times)
        case Nary(op=op, operands=operands):
            return (all if op is Op.AND else any)(holds(operand, word, at) for operand in operands)
        case _:
            raise AssertionError(formula)


@given(TASKS, WORDS)
def test_until_keeps_up_its_condition_before_the_task_is_done(task: Formula, word: list[frozenset[str]]) -> None:
    """With d at every time but one: the task has to be done before, as if the word ended there."""
    kept = compose(Operator.UNTIL, [parse("G d"), task])
    for stop in range(len(word)):
        marked = [letter | {"d"} if time < stop else letter for time, letter in enumerate(word)]
        ends = done(task, word, 0)
        assert bool(until(kept, marked, 0)) == any(end <= stop for end in ends)


def until(formula: Formula, word: list[frozenset[str]], at: int) -> bool:
    """LTL of until and conditions, where what is awaited comes within the word."""
    match formula:
        case Atom(function=name):
            return name in word[at]
        case Nary(op=op, operands=operands):
            return (all if op is Op.AND else any)(until(operand, word, at) for operand in operands)
        case _:
            left, right = formula.left, formula.right  # type: ignore[union-attr]
            ends = (t for t in range(at, len(word)) if until(right, word, t))
            return any(all(until(left, word, before) for before in range(at, end)) for end in ends)
