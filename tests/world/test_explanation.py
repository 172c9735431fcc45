"""Formulas read aloud."""

import contextlib
import copy
import re
import sys
from itertools import product
from pathlib import Path

import pytest
import spot
from hypothesis import given, settings
from hypothesis import strategies as st

from models.logic import equivalent, parse, to_text, walk
from models.logic.errors import FormulaTooLargeError
from models.logic.formula import (
    FALSE,
    MAX_DEPTH,
    TRUE,
    Atom,
    Binary,
    Name,
    Op,
    Unary,
    conjunction,
    disjunction,
    nary,
)
from models.world import explain, load_environment, toys_spec
from models.world.explanation import MAX_READING, Speaker, cut
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
        ("F at(robot, kitchen)", "eventually the robot is in the kitchen"),
        ("G !at(robot, kitchen)", "the robot is never in the kitchen"),
        ("!F at(robot, kitchen)", "the robot is never in the kitchen"),
        ("G at(robot, living_room)", "the robot is always in the living room"),
        ("F G at(robot, kitchen)", "from some time on the robot is always in the kitchen"),
        ("X G at(robot, kitchen)", "from the next step on the robot is always in the kitchen"),
        ("G F at(robot, kitchen)", "again and again the robot is in the kitchen"),
        (
            "F at(robot, kitchen) & G !at(robot, bedroom)",
            "eventually the robot is in the kitchen, and the robot is never in the bedroom",
        ),
        (
            "F in(cylinder, box) & F at(box, bedroom)",
            "eventually the cylinder is in the box, and eventually the box is in the bedroom, in any order",
        ),
        (
            "F (in(cylinder, box) & F (in(cylinder, box) & at(box, bedroom)))",
            "eventually the cylinder is in the box, and then the box is in the bedroom "
            "while the cylinder is in the box",
        ),
        (
            "(!at(box, bedroom) U in(cylinder, box)) & F (in(cylinder, box) & F at(box, bedroom))",
            "eventually the cylinder is in the box, and only then the box is in the bedroom",
        ),
        (
            "!at(robot, bedroom) U at(robot, kitchen)",
            "eventually the robot is in the kitchen, and until then the robot is not in the bedroom",
        ),
        (
            "(!at(robot, bedroom) U at(robot, kitchen)) | G !at(robot, bedroom)",
            "the robot is not in the bedroom until the robot is in the kitchen, if ever",
        ),
        (
            "G (in(cylinder, box) -> F at(box, bedroom))",
            "whenever the cylinder is in the box, eventually the box is in the bedroom",
        ),
        (
            "F (in(cylinder, box) & at(box, bedroom))",
            "eventually both the cylinder is in the box and the box is in the bedroom",
        ),
        ("colored(cylinder, red)", "the cylinder is red"),
        ("!colored(cylinder, red)", "the cylinder is not red"),
        ("shaped(cylinder, cylinder)", "the cylinder is a cylinder"),
        ("holding_box", "the robot is holding the box"),
        ("F holding($1)", "eventually the robot is holding {1}"),
        ("in($2, $1)", "{2} is in {1}"),
        ("flies(a_b)", "flies(a_b) holds"),
        ("G !flies(a_b)", "flies(a_b) never holds"),
        (
            "at(robot, kitchen) & near(robot, bedroom)",
            "the robot is in the kitchen and the robot is at the bedroom",
        ),
    ],
)
def test_readings(toys, formula, reading):
    assert explain(parse(formula), toys) == reading


@pytest.mark.parametrize(
    ("formula", "reading"),
    [
        ("true", "anything is allowed"),
        ("!true", "the impossible happens"),
        ("!a", "a does not hold"),
        ("!!a", "a holds"),
        ("G a", "a always holds"),
        ("a & b & c", "a holds and b holds and c holds"),
        ("(a & b) | c", "both a holds and b holds, or c holds"),
        ("(a | b) & c", "either a holds or b holds, and c holds"),
        ("(a & b & c) | d", "(a holds and b holds and c holds) or d holds"),
        ("!(a & b)", "it is not so that both a holds and b holds"),
        ("!(a | b)", "a does not hold and b does not hold"),
        ("!(a -> b)", "a holds and b does not hold"),
        ("!(a <-> b)", "a holds exactly when b does not hold"),
        ("!G a", "eventually a does not hold"),
        ("!X a", "in the next step a does not hold"),
        ("!(a U b)", "it is not so that (eventually b holds, and until then a holds)"),
        ("X X a", "in 2 steps a holds"),
        ("F F a", "eventually a holds"),
        ("G G a", "a always holds"),
        ("F G F a", "from some time on again and again a holds"),
        ("G !(a & b)", "never both a holds and b holds"),
        ("G (!a | !b)", "never both a holds and b holds"),
        ("G (!a | G !b)", "whenever a holds, b never holds"),
        ("G (!a | b | c)", "always (a does not hold or b holds or c holds)"),
        ("G (a | b)", "always either a holds or b holds"),
        ("a -> b -> c", "if a holds, then if b holds, then c holds"),
        ("(a -> b) -> c", "if (if a holds, then b holds), then c holds"),
        ("F (a -> b)", "eventually (if a holds, then b holds)"),
        ("a <-> F b", "a holds exactly when eventually b holds"),
        ("a U b", "eventually b holds, and until then a holds"),
        ("(F a) U b", "eventually b holds, and until then eventually a holds"),
        ("F (a U b)", "eventually (eventually b holds, and until then a holds)"),
        ("(a U b) U c", "eventually c holds, and until then (eventually b holds, and until then a holds)"),
        ("a U (b U c)", "eventually (eventually c holds, and until then b holds), and until then a holds"),
        ("a W b", "a holds until b holds, if ever"),
        ("G a | (a U b)", "a holds until b holds, if ever"),
        ("(a U b) | G c", "eventually b holds, and until then a holds; or c always holds"),
        ("a R b", "b holds up to and including when a holds, if ever"),
        ("a M b", "eventually a holds, and up to and including then b holds"),
        ("G F (a & F b)", "again and again a holds, and then b holds"),
        ("F G (a -> F b)", "from some time on, whenever a holds, eventually b holds"),
    ],
)
def test_readings_without_an_environment(formula, reading):
    assert explain(parse(formula)) == reading


@pytest.mark.parametrize(
    ("formula", "reading"),
    [
        ("F (a & F (b & F c))", "eventually a holds, and then b holds, and then c holds"),
        ("F (a & X F b)", "eventually a holds, and after that b holds"),
        ("F (a & X X F b)", "eventually a holds, and at least 2 steps later b holds"),
        ("F (a & X b)", "eventually a holds, and one step later b holds"),
        ("F (a & (b U c))", "eventually a holds, and from then on b holds until c holds"),
        ("F (a & F b & F c)", "eventually (a holds; and eventually b holds, and eventually c holds, in any order)"),
        ("a U (b & (a U c))", "eventually b holds, and then c holds, and all the time until then a holds"),
        ("a U (b & F c)", "eventually b holds, and until then a holds, and then c holds"),
        ("(!b U a) & F b", "eventually a holds, and only then b holds"),
        ("!b U (a & F b)", "eventually a holds, and only then b holds"),
        ("(a U !b) & F (!b & F !a)", "eventually b does not hold, and only then a does not hold"),
        ("(!b U a) & (!c U b) & F c", "eventually a holds, and only then b holds, and only then c holds"),
        (
            "F (a & F (b & F c)) & (!c U b)",
            "eventually a holds, and then b holds, and only then c holds",
        ),
        ("F a & G !c & F b", "eventually a holds, and eventually b holds, in any order; and c never holds"),
        ("F (a & F b) & G !c", "eventually a holds, and then b holds; and c never holds"),
        ("F a & F G b", "eventually a holds, and from some time on b always holds"),
    ],
)
def test_what_comes_after_what(formula, reading):
    assert explain(parse(formula)) == reading


def test_default_readings():
    switches = load_environment(SWITCHES)
    assert explain(parse("lit(one)"), switches) == "one is on"
    assert explain(parse("!lit(one)"), switches) == "one is not on"
    assert explain(parse("G !lit(one)"), switches) == "one is never on"
    assert explain(parse("idle"), switches) == "idle holds"
    assert explain(parse("!idle"), switches) == "idle does not hold"
    assert explain(parse("alike(one, two)"), switches) == "alike(one, two) holds"


def changed(path, value, objects=()):
    """The switches with another reading of a function, and further lamps."""
    data = copy.deepcopy(SWITCHES)
    data["domain_spec"]["functions"]["lit"] |= {path: value}
    for name in objects:
        data["objects"][name] = {"class": "lamp", "attributes": {"color": "red"}}
        data["state"][name] = {"level": "low"}
    return load_environment(data)


@pytest.mark.parametrize(
    ("says", "denies", "readings"),
    [
        ("{x} glows", None, ["one glows", "it is not so that one glows", "it never happens that one glows"]),
        ("{x} can glow", None, ["one can glow", "one cannot glow", "one can never glow"]),
        ("lamps {x} are on", None, ["lamps one are on", "lamps one are not on", "lamps one are never on"]),
        ("{x} is on", "{x} is off", ["one is on", "one is off", "it never happens that one is on"]),
        ("{x} is on and hot", None, ["(one is on and hot)", "(one is not on and hot)", "never (one is on and hot)"]),
    ],
)
def test_other_ways_to_say_a_function(says, denies, readings):
    world = changed("says", says) if denies is None else changed("denies", denies)
    assert [explain(parse(formula), world) for formula in ("lit(one)", "!lit(one)", "G !lit(one)")] == readings


def test_names_that_could_be_misread_are_set_off():
    world = changed("says", "{x} is on", ["a_b", "a b", "hall, and then the attic", "Hall 2"])
    say = lambda name: explain(Atom("lit", (Name(name),)), world)  # noqa: E731
    assert say("a_b") == '"a_b" is on'
    assert say("a b") == '"a b" is on'
    assert say("hall, and then the attic") == '"hall, and then the attic" is on'
    assert say("Hall 2") == "Hall 2 is on"


def test_atoms_that_are_read_alike_show_what_is_written(toys):
    world = changed("says", "something is on")
    assert explain(parse("lit(one)"), world) == "something is on"
    assert explain(parse("F lit(one) & G !lit(two)"), world) == (
        "eventually something is on [lit(one)], and something is never on [lit(two)]"
    )
    twice = explain(parse("cylinder_in_box & in(cylinder, box)"), toys)
    assert twice == "the cylinder is in the box and the cylinder is in the box"


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


def every_formula(size):
    """All formulas over a and b with exactly so many operators and atoms, but for the order within `&` and `|`."""
    if size == 1:
        yield from (A, B)
        return
    for op in (Op.NOT, Op.NEXT, Op.FINALLY, Op.GLOBALLY):
        yield from (Unary(op, inner) for inner in every_formula(size - 1))
    for left_size in range(1, size - 1):
        for left, right in product(every_formula(left_size), every_formula(size - 1 - left_size)):
            yield conjunction(left, right)
            yield disjunction(left, right)
            for op in (Op.IMPLIES, Op.IFF, Op.UNTIL, Op.RELEASE, Op.WEAK_UNTIL, Op.STRONG_RELEASE):
                yield Binary(op, left, right)


def misread(formulas, environment=None):
    """Pairs that are read alike and do not mean the same, by Spot; and how many formulas share a reading."""
    known, pairs, shared = {}, [], 0
    for formula in formulas:
        other = known.setdefault(explain(formula, environment), formula)
        if other != formula:
            shared += 1
            if not equivalent(formula, other):
                pairs.append((to_text(formula), to_text(other)))
    return pairs, shared


def test_no_two_small_formulas_are_read_alike_unless_they_mean_the_same():
    pairs, shared = misread(formula for size in range(1, 6) for formula in every_formula(size))
    assert pairs == []
    assert shared > 500  # such as `!F a` and `G !a`


def of_spot(size, number, seed):
    """Random formulas of Spot's randltl over p0, p1 and p2."""
    for found in spot.randltl(3, number, seed=seed, tree_size=size, simplify=0):
        text = found.to_str("spot", True)
        if "xor" not in text:
            yield parse(text)


@pytest.mark.parametrize("size", [6, 9, 14])
def test_no_two_random_formulas_are_read_alike_unless_they_mean_the_same(size):
    formulas = list(of_spot(size, 1_500, seed=size))
    assert misread(formulas)[0] == []


SEQUENCES = st.recursive(
    st.sampled_from([A, B, C, not_(A), not_(B)]),
    lambda inner: st.one_of(
        st.builds(lambda now, then: f_(conjunction(now, f_(then))), inner, inner),
        st.builds(lambda kept, then: Binary(Op.UNTIL, kept, then), st.sampled_from([A, not_(A), not_(B)]), inner),
        st.builds(lambda *parts: conjunction(*parts), inner, inner),
        st.builds(f_, inner),
        st.builds(g_, inner),
        st.builds(x_, inner),
    ),
    max_leaves=6,
)


@settings(max_examples=30)
@given(st.lists(SEQUENCES, min_size=200, max_size=200))
def test_no_two_sequences_are_read_alike_unless_they_mean_the_same(formulas):
    assert misread(formulas)[0] == []


@pytest.mark.parametrize("wrap", [not_, lambda f: f_(not_(f)), lambda f: x_(g_(f)), lambda f: Binary(Op.UNTIL, A, f)])
def test_deep_formulas(wrap):
    formula = A
    with contextlib.suppress(FormulaTooLargeError):
        while True:
            formula = wrap(formula)
    assert formula.depth >= MAX_DEPTH - 2
    assert explain(formula)


def test_a_reading_is_made_with_few_calls_within_each_other():
    """A deep formula is read where little of the stack is left."""
    formula = A
    for _ in range(98):
        formula = Binary(Op.RELEASE, not_(formula), B)
    frames, frame = 0, sys._getframe()
    while frame is not None:
        frames, frame = frames + 1, frame.f_back
    limit = sys.getrecursionlimit()
    try:
        sys.setrecursionlimit(frames + 60)
        assert explain(formula).endswith("if ever")
    finally:
        sys.setrecursionlimit(limit)


def test_a_long_reading_is_cut_after_a_word():
    long = explain(conjunction(*(f_(Atom(f"x{number}")) for number in range(1_000))))
    assert len(long) <= MAX_READING
    assert long.startswith("eventually x0 holds, and eventually x1 holds")
    assert re.search(r" (?:eventually|holds,|and|x\d+) \[\.\.\.\]$", long)
    assert cut("one two three", 12) == "one [...]"
    assert cut("one two", 7) == "one two"


def test_a_reading_takes_time_in_proportion_to_the_formula(monkeypatch):
    """Every part is read once, however deep it is and however often it comes."""
    read = []
    known = Speaker._read

    def counted(self, formula, denied):
        read.append(formula)
        return known(self, formula, denied)

    monkeypatch.setattr(Speaker, "_read", counted)
    formula = A
    for number in range(1, 60):
        formula = Binary(Op.UNTIL, disjunction(formula, Atom(f"x{number}")), disjunction(formula, B))
        if formula.size > 2_000:
            break
    explain(formula)
    assert len(read) <= len(set(walk(formula)))


def test_the_table_of_readings_in_the_documents():
    text = (Path(__file__).parents[2] / "docs" / "ltl.md").read_text(encoding="utf-8")
    rows = re.findall(r"^\| (`.*`) \| (.*) \|$", text.partition("## In plain English")[2], re.MULTILINE)
    assert len(rows) > 20
    for formulas, documented in rows:
        found = [parse(formula.replace("\\|", "|")) for formula in re.findall("`([^`]*)`", formulas)]
        assert "; ".join(dict.fromkeys(map(explain, found))) == documented
        assert len(found) == len(documented.split("; ")) or all(equivalent(found[0], other) for other in found)
