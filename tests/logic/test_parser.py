"""Parsing: spellings, precedence (Spot is the judge), recognition, limits."""

from __future__ import annotations

import time

import pytest
import spot
from hypothesis import given, settings
from hypothesis import strategies as st

from models.errors import CqltlError
from models.logic import (
    FALSE,
    MAX_DEPTH,
    MAX_TEXT,
    TRUE,
    Atom,
    Dialect,
    Formula,
    FormulaSyntaxError,
    FormulaTooLargeError,
    Name,
    Op,
    Parameter,
    Unary,
    conjunction,
    parse,
    to_text,
)


@pytest.mark.parametrize(
    ("spelling", "infix"),
    [
        ("[] <> a && ! b || c", "(G F a & !b) | c"),
        ("[]<>a", "G F a"),
        ("~a \\/ b /\\ c => d <=> e", "!a | (b & c) -> (d <-> e)"),
        ("a --> b <--> c", "a -> (b <-> c)"),
        ("1 U 0", "true U false"),
        ("True | FALSE", "true | false"),
        ("a() & in(b,c)", "a & in(b, c)"),
        ("◇(a ∧ □¬b) ∨ ○⊤ → ⊥ ↔ c", "F (a & G !b) | X true -> (false <-> c)"),
        ("⋄a ⇒ ◻b ⟺ ◯c", "F a -> (G b <-> X c)"),
        (r"\mathcal{F}(\phi \wedge \mathcal{F}(\psi \wedge \mathcal{F}(\varphi)))", "F (phi & F (psi & F varphi))"),
        (r"$\mathcal{F}$(CVS $\wedge$ $\mathcal{F}$(park))", "F (CVS & F park)"),
        (r"\mathcal{F}(CVS \wedge \mathcal{F}(park))", "F (CVS & F park)"),
        (r"$\mathcal{F}(light\_on \wedge \mathcal{F}(ball\_in\_bucket))$", "F (light_on & F ball_in_bucket)"),
        (r"\[ \neg a \mathbin{\mathcal{U}} b \]", "!a U b"),
        (r"\(\Box\left(a \to \Diamond b\right)\)", "G (a -> F b)"),
        (r"$$\lnot \mathrm{in}(\mathrm{ball}, \mathrm{small\_bucket})\,\mathcal{U}\;\text{H\&M}$$",
         '!in(ball, small_bucket) U "H&M"'),
        (r"\bigcirc{} p_{1} \land {\top \lor q_2}", "X p_1 & (true | q_2)"),
        (r"a \mathbf{U} b \iff \mathsf{G} c \implies \mathrm{true}", "(a U b) <-> (G c -> true)"),
        (r"\mathcal F a \vee \mathcal G \text{U}", 'F a | G "U"'),
        (r"\mathrm{at}(\mathrm{U}, \text{ two  words\ })", '"at"("U", " two  words ")'),
        (r"in(\$1, $2)", "in($1, $2)"),
        ("Fa & FGa & aUb & V & and", "Fa & FGa & aUb & V & and"),
        ("Fa&F a&F(a)", "Fa & F a & F a"),
        ("at(robot, 3) & at(U, true)", 'at(robot, "3") & at("U", "true")'),
        ('"F"(a) U "U"', '"F"(a) U "U"'),
        ('"say \\"hi\\" \\\\o/"', '"say \\"hi\\" \\\\o/"'),
        ("étage_2 & 房間", "étage_2 & 房間"),
        ("  a\n\t&\r\n  b  ", "a & b"),
        ("F & a F b", "F (a & F b)"),
        ("-> a b", "a -> b"),
        ("& a & b & c d", "a & b & c & d"),
        ("& & & a b c d", "a & b & c & d"),
        ("& | a b | c d", "(a | b) & (c | d)"),
        ("U ! q p", "!q U p"),
        ("F & in(t, b) F & in(t, b) at(b, c)", "F (in(t, b) & F (in(t, b) & at(b, c)))"),
        ("∧ a ◇ b", "a & F b"),
        (r"\wedge \phi \Diamond \psi", "phi & F psi"),
        ("<-> a -> b 1", "a <-> (b -> true)"),
    ],
)  # fmt: skip
def test_spellings(spelling: str, infix: str) -> None:
    assert parse(spelling) == parse(infix, dialect=Dialect.INFIX)


def test_the_parts_of_an_atom() -> None:
    assert parse('in("x", $12)') == Atom("in", (Name("x"), Parameter(12)))
    assert parse('"two words"("H&M (2nd floor)")') == Atom("two words", (Name("H&M (2nd floor)"),))
    assert parse("true") == TRUE
    assert parse("0") == FALSE


@pytest.mark.parametrize("text", ["a", "F a", "! G in(a, b)", "X X X true", '"U"', "[] <> a"])
def test_a_text_without_binary_operators_is_the_same_in_infix_and_prefix(text: str) -> None:
    assert parse(text, dialect=Dialect.PREFIX) == parse(text, dialect=Dialect.INFIX) == parse(text)


def test_a_dialect_is_kept_to_when_it_is_named() -> None:
    with pytest.raises(FormulaSyntaxError):
        parse("& a b", dialect=Dialect.INFIX)
    with pytest.raises(FormulaSyntaxError):
        parse("a & b", dialect=Dialect.PREFIX)
    with pytest.raises(FormulaSyntaxError):
        parse("& (a) b", dialect=Dialect.PREFIX)
    assert parse("a && b", dialect=Dialect.LATEX) == parse("a ∧ b", dialect=Dialect.SPOT)


tokens = st.lists(
    st.sampled_from(["a", "b", "c", "!", "X", "F", "G", "&", "|", "->", "<->", "U", "R", "W", "M", "(", ")", "1", "0"]),
    min_size=1,
    max_size=12,
)
# Operands and operators in turn, so that most texts are formulas.
operand = st.tuples(
    st.lists(st.sampled_from(["!", "X", "F", "G"]), max_size=2), st.sampled_from(["a", "b", "c", "1", "0"])
).map(lambda pair: " ".join([*pair[0], pair[1]]))
operator = st.sampled_from(["&", "|", "->", "<->", "U", "R", "W", "M", "&&", "||"])
chains = st.lists(st.tuples(operand, operator), max_size=6).flatmap(
    lambda pairs: operand.map(lambda last: " ".join([f"{left} {op}" for left, op in pairs] + [last]))
)


@given(chains)
@settings(max_examples=100, deadline=None)
def test_precedence_is_spots(text: str) -> None:
    assert spot.are_equivalent(spot.formula(text), spot.formula(to_text(parse(text))))
    assert spot.formula(text) == spot.formula(to_text(parse(text)))


@given(tokens)
@settings(max_examples=120, deadline=None)
def test_infix_accepts_just_what_spot_accepts(pieces: list[str]) -> None:
    text = " ".join(pieces)
    expected = spot.parse_infix_psl(text)
    if expected.errors:
        with pytest.raises(FormulaSyntaxError):
            parse(text, dialect=Dialect.INFIX)
    else:
        assert spot.formula(to_text(parse(text, dialect=Dialect.INFIX))) == expected.f


@given(tokens)
@settings(max_examples=120, deadline=None)
def test_no_text_has_two_meanings(pieces: list[str]) -> None:
    text = " ".join(pieces)
    attempts = [attempt(text, dialect)[0] for dialect in (Dialect.INFIX, Dialect.PREFIX)]
    readings = [formula for formula in attempts if formula is not None]
    assert len(set(readings)) <= 1
    if readings:
        assert parse(text) == readings[0]


@given(st.text(max_size=60) | st.text(alphabet='ab1FGU!&|<->[]()"\\{}$_ \n\t,^~textmathrm', max_size=60))
@settings(max_examples=200, deadline=None)
def test_any_text_is_a_formula_or_a_refusal(text: str) -> None:
    for dialect in (None, Dialect.PREFIX):
        formula, refusal = attempt(text, dialect)
        assert formula is not None or len(str(refusal)) < 400
        assert formula is None or parse(to_text(formula)) == formula


def attempt(text: str, dialect: Dialect | None) -> tuple[Formula | None, CqltlError | None]:
    """The formula, or the refusal; anything else that is raised is a failure of the test."""
    try:
        return parse(text, dialect=dialect), None
    except (FormulaSyntaxError, FormulaTooLargeError) as error:
        return None, error


@pytest.mark.parametrize(
    "text",
    [
        "a" * 1_000_000,
        "(" * 1_000_000,
        "a" * (MAX_TEXT + 1),
        "(" * 10_000 + "a" + ")" * 10_000,
        "(" * 10_000,
        "{" * 10_000,
        "!" * 10_000 + "a",
        "F " * 10_000 + "a",
        " & ".join(["a"] * 5_000),
        "a|" * 30_000 + "a",
        "& " * 5_000 + "a " * 5_001,
        "|a" * 30_000 + " a",
        " -> ".join(["a"] * 1_000),
        "a U " * 1_000 + "a",
        "-> a " * 1_000 + "a",
        "X(" * 5_000 + "a" + ")" * 5_000,
    ],
    ids=lambda text: f"{text[:8]}x{len(text)}",
)
def test_hostile_texts_are_refused_quickly(text: str) -> None:
    start = time.process_time()
    for dialect in (None, Dialect.PREFIX):
        with pytest.raises((FormulaTooLargeError, FormulaSyntaxError)) as caught:
            parse(text, dialect=dialect)
        assert len(str(caught.value)) < 400
    assert time.process_time() - start < 5


@pytest.mark.parametrize(
    "text",
    [
        "a(" + "b," * 32_000,
        '"' * 65_000,
        '"\\' * 32_000,
        "a{" * 32_000,
        "\\text{" * 10_000,
        "\\" * 65_000,
        "a_{" * 20_000,
    ],
)
def test_no_text_makes_the_lexer_slow(text: str) -> None:
    start = time.process_time()
    with pytest.raises((FormulaTooLargeError, FormulaSyntaxError)):
        parse(text)
    assert time.process_time() - start < 5


def test_long_flat_formulas_are_read() -> None:
    assert parse(" & ".join(["a"] * 4_999)) == conjunction(*[Atom("a")] * 4_999)
    assert parse("& " * 4_998 + "a " * 4_999) == conjunction(*[Atom("a")] * 4_999)
    assert parse("& a " * 4_998 + "a") == conjunction(*[Atom("a")] * 4_999)


def test_nesting_up_to_the_limit_is_read() -> None:
    assert parse("(" * MAX_DEPTH + "a(b)" + ")" * MAX_DEPTH) == Atom("a", (Name("b"),))
    formula = parse("!" * (MAX_DEPTH - 1) + "a")
    assert formula.depth == MAX_DEPTH
    assert isinstance(formula, Unary)
    assert formula.op is Op.NOT
