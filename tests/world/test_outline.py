"""The parts of formulas."""

from __future__ import annotations

import time

from hypothesis import given

from models.logic import Atom, Binary, Nary, Op, children, conjunction, disjunction, parse, walk
from models.world import Part, explain, load_environment, outline, toys_spec
from models.world.explanation import CUT
from models.world.outline import MAX_PART_DEPTH, MAX_PART_READING, MAX_PARTS
from tests.logic.strategies import formulas, plain_atoms


def said(parts: tuple[Part, ...]) -> list[tuple[str, list]]:
    return [(part.explanation, said(part.parts)) for part in parts]


def every(parts: tuple[Part, ...], depth: int = 1) -> list[tuple[int, Part]]:
    return [found for part in parts for found in [(depth, part), *every(part.parts, depth + 1)]]


def test_parts_are_what_the_operators_join() -> None:
    toys = load_environment(toys_spec())
    formula = parse("F (at(robot, kitchen) & F at(robot, bedroom)) & G !holding(cylinder)")
    assert said(outline(formula, toys)) == [
        (
            "eventually the robot is in the kitchen, and then the robot is in the bedroom",
            [("the robot is in the kitchen", []), ("eventually the robot is in the bedroom", [])],
        ),
        ("the robot is never holding the cylinder", []),
    ]


def test_a_literal_has_no_parts() -> None:
    assert outline(parse("G F !a")) == ()
    assert outline(parse("true")) == ()


@given(formulas(plain_atoms))
def test_each_part_says_a_formula_of_its_parent(formula) -> None:
    def check(parent, parts) -> None:
        while not isinstance(parent, (Nary, Binary)) and children(parent):
            (parent,) = children(parent)
        assert [part.formula for part in parts] == list(children(parent)) or parts == ()
        for part in parts:
            assert part.explanation == explain(part.formula)
            check(part.formula, part.parts)

    check(formula, outline(formula))
    joined = [node for node in walk(formula) if isinstance(node, (Nary, Binary))]
    shown = every(outline(formula))
    if len(shown) < MAX_PARTS and all(depth < MAX_PART_DEPTH for depth, _ in shown):
        assert len(shown) == sum(len(children(node)) for node in joined)


def test_only_so_many_parts_are_shown_and_long_ones_are_cut() -> None:
    wide = disjunction(*(conjunction(*(Atom(f"x{i}_{j}") for j in range(60))) for i in range(60)))
    started = time.monotonic()
    found = every(outline(wide))
    assert time.monotonic() - started < 5
    assert len(found) == MAX_PARTS
    assert [depth for depth, _ in found].count(1) == 60
    assert all(len(part.explanation) <= MAX_PART_READING for _, part in found)
    assert found[0][1].explanation.endswith(CUT) is (len(explain(found[0][1].formula)) > MAX_PART_READING)
    deep = Atom("a")
    for _ in range(50):
        deep = Binary(Op.UNTIL, deep, Atom("b"))
    assert max(depth for depth, _ in every(outline(deep))) == MAX_PART_DEPTH
