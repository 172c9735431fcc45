"""Warnings, and the search for a simpler formula, judged by Spot."""

from __future__ import annotations

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from models.logic import Atom, Binary, Formula, Op, Unary, conjunction, disjunction, equivalent, parse
from models.logic import to_text as formula_text
from models.queries import Example, learn, parse_query, review, simplest_equivalent
from models.world import Environment


@pytest.mark.parametrize(
    ("ltl", "simplest"),
    [
        ("F (a & F (a & b))", "F (a & b)"),  # the paper's ship orders nothing
        ("F (a & F b)", "F (a & F b)"),  # a real order stays
        ("(!b U a) & F (a & b)", "(!b U a) & F (a & b)"),
        ("F F a", "F a"),
        ("a & (a | b)", "a"),
        ("G (a & G b)", "G (a & b)"),
    ],
)
def test_simplest_equivalent(ltl: str, simplest: str) -> None:
    assert formula_text(simplest_equivalent(parse(ltl))) == formula_text(parse(simplest))


ATOMS = st.sampled_from([Atom("a"), Atom("b")])
FORMULAS = st.recursive(
    ATOMS,
    lambda inner: st.one_of(
        st.builds(Unary, st.sampled_from([Op.NOT, Op.NEXT, Op.FINALLY, Op.GLOBALLY]), inner),
        st.builds(Binary, st.sampled_from([Op.UNTIL, Op.IMPLIES]), inner, inner),
        st.builds(conjunction, inner, inner),
        st.builds(disjunction, inner, inner),
    ),
    max_leaves=4,
)


@settings(max_examples=40, deadline=None)
@given(FORMULAS)
def test_simplifying_keeps_the_meaning_and_never_grows(formula: Formula) -> None:
    simpler = simplest_equivalent(formula)
    assert equivalent(simpler, formula)
    assert simpler.size <= formula.size


@pytest.mark.parametrize(
    ("query", "ltl", "warnings"),
    [
        ("go(p)", "F at(robot, p)", []),
        (
            "put(ball, q)",
            "F (lies(ball, q) & F (lies(ball, q) & colored(ball, red)))",
            ["equivalent to", "red is no argument"],
        ),
        ("never(p)", "F (at(robot, p) & !at(robot, p))", ["can never hold"]),
        ("always(p)", "F at(robot, p) | G !at(robot, p)", ["always holds"]),
        ("bring(ball)", "F lies(ball, q)", ["q is no argument of bring"]),
    ],
)
def test_warnings(store: Environment, query: str, ltl: str, warnings: list[str]) -> None:
    template = learn([Example(parse_query(query), parse(ltl))], store)
    found = review(template, store)
    assert len(found) == len(warnings)
    assert all(part in warning for part, warning in zip(warnings, found, strict=True))


def test_the_only_robot_is_no_suspicious_constant(store: Environment) -> None:
    template = learn([Example(parse_query("go(p)"), parse("F at(robot, p)"))], store)
    assert review(template, store) == ()
