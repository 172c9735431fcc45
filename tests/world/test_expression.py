"""Expressions: what is read, how it nests, what is refused."""

import contextlib
import re

import pytest
from hypothesis import given
from hypothesis import strategies as st

from models.world.expression import (
    Access,
    Arithmetic,
    Call,
    Compare,
    Conditional,
    Connective,
    ExpressionError,
    Is,
    Not,
    Nothing,
    Number,
    Quantified,
    Quantifier,
    Truth,
    Variable,
    parse_expression,
)
from models.world.limits import MAX_NESTING, MAX_TEXT

A, B, C = Variable("a"), Variable("b"), Variable("c")


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("a", A),
        ("true", Truth(True)),
        ("none", Nothing()),
        ("0.25", Number(0.25)),
        ("1e-3", Number(0.001)),
        ('"H&M (2nd floor)"', Variable("H&M (2nd floor)")),
        ("a.in.north", Access(Access(A, "in"), "north")),
        ("a.if == b.is", Compare("==", Access(A, "if"), Access(B, "is"))),
        ("a or b and c", Connective(False, (A, Connective(True, (B, C))))),
        ("a and b and c", Connective(True, (A, B, C))),
        ("not a and b", Connective(True, (Not(A), B))),
        ("not a == b", Not(Compare("==", A, B))),
        ("a implies b implies c", Connective(False, (Not(A), Connective(False, (Not(B), C))))),
        ("a is b | c", Is(A, ("b", "c"))),
        ("a is not b", Not(Is(A, ("b",)))),
        ("a if b else c", Conditional(A, B, C)),
        ("a if b else b if c else a", Conditional(A, B, Conditional(B, C, A))),
        ("1 - a / 2", Arithmetic("-", Number(1.0), Arithmetic("/", A, Number(2.0)))),
        ("a - b - c", Arithmetic("-", Arithmetic("-", A, B), C)),
        ("(a - b) * c", Arithmetic("*", Arithmetic("-", A, B), C)),
        ("-a", Arithmetic("-", Number(0.0), A)),
        ("a + b <= c", Compare("<=", Arithmetic("+", A, B), C)),
        ("f()", Call("f", ())),
        ("f(a, b.c)", Call("f", (A, Access(B, "c")))),
        ("count(x: b | c; a)", Quantified(Quantifier.COUNT, "x", ("b", "c"), A)),
        (
            "any (x: b; all(y: c; a))",
            Quantified(Quantifier.ANY, "x", ("b",), Quantified(Quantifier.ALL, "y", ("c",), A)),
        ),
        ("any == all", Compare("==", Variable("any"), Variable("all"))),
    ],
)
def test_reads(text, expected):
    assert parse_expression(text) == expected


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("", "ends too early"),
        ("a and", "ends too early"),
        ("(a", "ends too early"),
        ("a b", "at character 3: 'b'"),
        ("a == b == c", "at character 8: '== c'"),
        ("a ! b", "at character 3: '! b' (write not)"),
        ("a.", "ends too early"),
        ("any(x; a)", "at character 6"),
        ("1e999", "too large"),
        ("__import__('os')", "at character 12"),
        ("a = b", "at character 3: '= b' (write == to compare)"),
        ("lambda: a", "at character 7"),
        ("a" * (MAX_TEXT + 1), f"longer than {MAX_TEXT}"),
        ("(" * 400 + "a" + ")" * 400, None),
        ("not " * (MAX_NESTING + 1) + "a", "nested more than"),
        ("- " * 400 + "a", "nested more than"),
        ("a" + ".a" * 400, "nested more than"),
        ("a" + " + a" * 200, "nested more than"),
        ("a implies " * 90 + "a", "nested more than"),
        ("a if a else " * 80 + "a", "nested more than"),
        ("f(" * 300 + ")" * 300, "nested more than"),
    ],
)
def test_refuses(text, message):
    if message is None:  # redundant parentheses do not nest
        assert parse_expression(text) == A
        return
    with pytest.raises(ExpressionError, match=re.escape(message)):
        parse_expression(text)


@pytest.mark.parametrize(
    ("text", "instead"),
    [
        ("a = b", "== to compare"),
        ("a === b", "== to compare"),
        ("a <-> b", "== to compare"),
        ("a <=> b", "== to compare"),
        ("a =< b", "<= to compare"),
        ("a <> b", "!= to compare"),
        ("a ≠ b", "!= to compare"),
        ("a && b", "and"),
        ("a & b", "and"),
        ("a AND b", "and"),
        ("a || b", "or"),
        ("a | b", "or"),
        ("a is b || c", "or"),
        ("!a", "not"),
        ("a and !b", "not"),
        ("NOT a", "not"),
        ("¬a", "not"),
        ("a -> b", "implies"),
        ("a->b", "implies"),
        ("a => b", "implies"),
        ("a -->", "implies"),
        ("a == 'b'", "names in double quotes"),
    ],
)
def test_operators_of_other_languages_are_explained(text, instead):
    with pytest.raises(ExpressionError) as caught:
        parse_expression(text)
    assert str(caught.value).endswith(f" (write {instead})")
    assert len(str(caught.value)) < 100


@pytest.mark.parametrize("text", ["a b", "!= b", "a == == b", "a < > b", "any(x; a)", "a and and b", "if a"])
def test_other_faults_are_only_placed(text):
    with pytest.raises(ExpressionError, match=r"^cannot read the expression at character") as caught:
        parse_expression(text)
    assert "write" not in str(caught.value)


@given(st.text(alphabet='abx.()|:;,<=>!+-*/"01 ifelsenotandorcount\n', max_size=60))
def test_any_text_is_read_or_refused(text):
    with contextlib.suppress(ExpressionError):
        parse_expression(text)
