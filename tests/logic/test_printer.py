"""Printing: what each dialect looks like, and that everything printed is read back."""

from __future__ import annotations

import pytest
from hypothesis import example, given, settings
from hypothesis import strategies as st

from models.logic import Atom, Dialect, Formula, Name, Parameter, atom_text, parse, to_text
from tests.logic.strategies import NASTY, formulas, nasty_atoms

SHIP = "F (in(cylinder, box) & F (in(cylinder, box) & at(box, bedroom)))"


@given(formulas(nasty_atoms), st.sampled_from(Dialect))
@example(parse(SHIP), Dialect.LATEX)
@settings(max_examples=150, deadline=None)
def test_what_is_printed_is_read_back_named_or_recognised(formula: Formula, dialect: Dialect) -> None:
    text = to_text(formula, dialect)
    assert parse(text, dialect=dialect) == formula
    assert parse(text) == formula
    assert "\n" not in text


@pytest.mark.parametrize("dialect", Dialect)
@pytest.mark.parametrize("name", NASTY)
def test_every_nasty_name_survives_as_function_and_as_argument(name: str, dialect: Dialect) -> None:
    for atom in (Atom(name), Atom(name, (Name(name), Parameter(1), Name("b")))):
        assert parse(to_text(atom, dialect), dialect=dialect) == parse(to_text(atom, dialect)) == atom


@pytest.mark.parametrize(
    "text",
    [
        SHIP,
        "!q U p",
        "G !q",
        "G F a",
        "F p & G !q",
        "F (p & !q)",
        "(!b U a) & F (a & b)",
        "F (in($1, $2) & F (in($1, $2) & at($2, $3)))",
        'at(robot, "H&M (2nd floor)")',
        "!(a & b)",
        "(a & b) | c",
        "a & b -> F c | d",
        "(a -> b) -> c",
        "a -> (b -> c)",
        "a <-> (b -> c)",
        "a U (b U c)",
        "(a U b) R !(c W d)",
        "F (a M b)",
        "X X !F a",
        "true U false",
        "!!a",
        '"F" & "and then" & "true"',
    ],
)
def test_infix_is_printed_as_people_write_it(text: str) -> None:
    assert to_text(parse(text)) == text


@pytest.mark.parametrize(
    ("dialect", "expected"),
    [
        (Dialect.SPOT, "<> (in(a, b) && [] !c) -> (X d U (true || e))"),
        (Dialect.PREFIX, "-> F & in(a, b) G ! c U X d | true e"),
        (Dialect.UNICODE, "◇ (in(a, b) ∧ □ ¬c) → (○ d U (⊤ ∨ e))"),
        (
            Dialect.LATEX,
            r"\mathcal{F}(\mathrm{in}(\mathrm{a}, \mathrm{b}) \wedge \mathcal{G}\,\neg \mathrm{c}) \rightarrow "
            r"(\mathcal{X}\,\mathrm{d} \mathbin{\mathcal{U}} (\top \vee \mathrm{e}))",
        ),
    ],
)
def test_each_dialect_has_its_own_signs(dialect: Dialect, expected: str) -> None:
    assert to_text(parse("F (in(a, b) & G !c) -> (X d U (true | e))"), dialect) == expected


def test_latex_escapes_what_latex_would_misread() -> None:
    atom = Atom("in", (Name("small_bucket"), Name("H&M (50% {off} ~ \\o/ ^_^ #$)"), Parameter(2)))
    assert atom_text(atom, Dialect.LATEX) == (
        r"\mathrm{in}(\mathrm{small\_bucket}, \text{H\&M (50\% \{off\} \textasciitilde{} \textbackslash{}o/ "
        r"\textasciicircum{}\_\textasciicircum{} \#\$)}, \$2)"
    )


def test_a_long_conjunction_is_flat_in_prefix_too() -> None:
    assert to_text(parse("a & b & c & (d | e | f)"), Dialect.PREFIX) == "& a & b & c | d | e f"
