"""Formulas read aloud."""

import contextlib

import pytest
from hypothesis import given
from hypothesis import strategies as st

from models.logic.errors import FormulaTooLargeError
from models.logic.formula import (
    FALSE,
    MAX_DEPTH,
    TRUE,
    Atom,
    Binary,
    Name,
    Op,
    Parameter,
    Unary,
    conjunction,
    disjunction,
    nary,
)
from models.world import explain, load_environment, toys_spec
from tests.world.worlds import SWITCHES

A, B, C = Atom("a"), Atom("b"), Atom("c")
IN = Atom("in", (Name("cylinder"), Name("box")))
BEDROOM = Atom("at", (Name("box"), Name("bedroom")))
KITCHEN = Atom("at", (Name("robot"), Name("kitchen")))


def not_(f):
    return Unary(Op.NOT, f)


def f_(f):
    return Unary(Op.FINALLY, f)


def g_(f):
    return Unary(Op.GLOBALLY, f)


def x_(f):
    return Unary(Op.NEXT, f)


@pytest.fixture(scope="module")
def toys():
    return load_environment(toys_spec())


@pytest.mark.parametrize(
    ("formula", "reading"),
    [
        (
            f_(conjunction(IN, f_(conjunction(IN, BEDROOM)))),
            "eventually cylinder is in box, and then box is at bedroom while cylinder is in box",
        ),
        (f_(conjunction(KITCHEN, f_(BEDROOM))), "eventually robot is at kitchen, and then box is at bedroom"),
        (
            f_(conjunction(KITCHEN, f_(conjunction(IN, f_(BEDROOM))))),
            "eventually robot is at kitchen, and then cylinder is in box, and then box is at bedroom",
        ),
        (f_(conjunction(KITCHEN, x_(f_(IN)))), "eventually robot is at kitchen, and after that cylinder is in box"),
        (f_(conjunction(IN, BEDROOM)), "eventually both cylinder is in box and box is at bedroom"),
        (f_(disjunction(IN, not_(BEDROOM))), "eventually either cylinder is in box or box is not at bedroom"),
        (Binary(Op.UNTIL, not_(KITCHEN), IN), "robot is not at kitchen until cylinder is in box"),
        (g_(not_(KITCHEN)), "robot is never at kitchen"),
        (not_(f_(KITCHEN)), "robot is never at kitchen"),
        (g_(f_(KITCHEN)), "again and again robot is at kitchen"),
        (f_(g_(KITCHEN)), "from some time on, always robot is at kitchen"),
        (g_(Binary(Op.IMPLIES, IN, f_(BEDROOM))), "whenever cylinder is in box, eventually box is at bedroom"),
        (x_(x_(IN)), "in 2 steps cylinder is in box"),
        (x_(IN), "in the next step cylinder is in box"),
        (conjunction(f_(IN), g_(not_(KITCHEN))), "eventually cylinder is in box and robot is never at kitchen"),
        (Atom("holding_box"), "the robot is holding box"),
        (f_(Atom("holding", (Parameter(1),))), "eventually the robot is holding $1"),
        (Atom("in", (Parameter(2), Parameter(1))), "$2 is in $1"),
        (Atom("flies", (Name("a_b"),)), "flies(a b)"),
        (not_(Atom("flies", (Name("a_b"),))), "not flies(a b)"),
    ],
)
def test_readings(toys, formula, reading):
    assert explain(formula, toys) == reading


@pytest.mark.parametrize(
    ("formula", "reading"),
    [
        (TRUE, "anything is allowed"),
        (not_(TRUE), "the impossible happens"),
        (not_(A), "a does not hold"),
        (disjunction(conjunction(A, B), C), "(a holds and b holds) or c holds"),
        (conjunction(disjunction(A, B), C), "(a holds or b holds) and c holds"),
        (Binary(Op.UNTIL, Binary(Op.UNTIL, A, B), C), "(a holds until b holds) until c holds"),
        (Binary(Op.UNTIL, A, Binary(Op.UNTIL, B, C)), "a holds until (b holds until c holds)"),
        (Binary(Op.IMPLIES, A, B), "if a holds, then b holds"),
        (Binary(Op.IFF, A, B), "a holds exactly when b holds"),
        (Binary(Op.WEAK_UNTIL, A, B), "a holds until b holds, or for ever"),
        (Binary(Op.RELEASE, A, B), "b holds up to and including when a holds, or for ever"),
        (Binary(Op.STRONG_RELEASE, A, B), "b holds up to and including when a holds, which must happen"),
        (not_(conjunction(A, B)), "it is not so that both a holds and b holds"),
        (not_(g_(A)), "it is not so that always a holds"),
        (f_(f_(A)), "eventually a holds"),
        (g_(g_(A)), "always a holds"),
        (g_(not_(conjunction(A, B))), "never both a holds and b holds"),
        (conjunction(A, B, C), "a holds and b holds and c holds"),
        (f_(conjunction(A, f_(B), f_(C))), "eventually (a holds and eventually b holds and eventually c holds)"),
    ],
)
def test_readings_without_an_environment(formula, reading):
    assert explain(formula) == reading


def test_default_readings():
    switches = load_environment(SWITCHES)
    assert explain(Atom("lit", (Name("one"),)), switches) == "one is on"
    assert explain(not_(Atom("lit", (Name("one"),))), switches) == "one is not on"
    assert explain(Atom("idle"), switches) == "idle"
    assert explain(not_(Atom("idle")), switches) == "not (idle)"
    assert explain(Atom("alike", (Name("one"), Name("two"))), switches) == "alike(one, two)"


FORMULAS = st.recursive(
    st.sampled_from([A, B, C, TRUE, FALSE, IN]),
    lambda inner: st.one_of(
        st.builds(Unary, st.sampled_from([Op.NOT, Op.NEXT, Op.FINALLY, Op.GLOBALLY]), inner),
        st.builds(
            Binary,
            st.sampled_from([Op.UNTIL, Op.RELEASE, Op.WEAK_UNTIL, Op.STRONG_RELEASE, Op.IMPLIES, Op.IFF]),
            inner,
            inner,
        ),
        st.builds(nary, st.sampled_from([Op.AND, Op.OR]), inner, inner),
    ),
    max_leaves=12,
)


@given(FORMULAS)
def test_every_formula_has_a_reading(formula):
    reading = explain(formula)
    assert reading
    assert reading.count("(") == reading.count(")")


@pytest.mark.parametrize("wrap", [not_, lambda f: f_(not_(f)), lambda f: x_(g_(f)), lambda f: Binary(Op.UNTIL, A, f)])
def test_deep_formulas(wrap):
    formula = A
    with contextlib.suppress(FormulaTooLargeError):
        while True:
            formula = wrap(formula)
    assert formula.depth >= MAX_DEPTH - 2
    assert explain(formula)
