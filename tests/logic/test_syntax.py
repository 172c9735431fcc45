"""Syntax errors: the place, the caret, the sentence and its hint."""

from __future__ import annotations

import pickle

import pytest

from models.errors import Place
from models.logic import Dialect, FormulaSyntaxError, parse
from models.source import CARET_WIDTH


def refusal(text: str, dialect: Dialect | None = None) -> FormulaSyntaxError:
    with pytest.raises(FormulaSyntaxError) as caught:
        parse(text, dialect=dialect)
    return caught.value


@pytest.mark.parametrize(
    ("text", "line", "column", "words"),
    [
        ("", 1, 1, "the formula is empty"),
        (" \n\t ", 1, 1, "the formula is empty"),
        ("a &", 1, 4, "expected a proposition or an operator before one, found the end"),
        ("a & & b", 1, 5, "expected a proposition or an operator before one, found `&`"),
        ("F", 1, 2, "found the end"),
        ("a b", 1, 3, "expected an operator or the end, found `b`"),
        ("(a & b", 1, 7, "expected an operator or `)`, found the end; the `(` at line 1, column 1 is never closed"),
        ("(a & (b |", 1, 10, "the `(` at line 1, column 6 is never closed"),
        ("{a", 1, 3, "expected an operator or `}`"),
        ("a)", 1, 2, "found `)`; no `(` is open here"),
        ("{a)", 1, 3, "the bracket open here is the `{` at line 1, column 1"),
        ("at(a", 1, 5, "expected `,` or `)` after an argument, found the end; the `(` at line 1, column 3"),
        ("at(a,", 1, 6, "expected a name, a quoted name or a parameter such as $1"),
        ("at(a & b)", 1, 6, "expected `,` or `)` after an argument, found `&`"),
        ("at(in(a, b))", 1, 6, "found `(`"),
        ("a = b", 1, 3, "found `=`; equivalence is written <->"),
        ("a == b", 1, 3, "equivalence is written <->"),
        ("a and b", 1, 3, "found `and`; write & for `and`"),
        ("not a", 1, 5, "write ! for `not`"),
        ("F U a", 1, 6, "found the end"),
        ("a & U b", 1, 5, 'U is an operator; a name that is spelt so is quoted: "U"'),
        ("F(a, b)", 1, 4, "a function named like an operator is quoted"),
        ("at(living-room)", 1, 10, "a name with other characters than letters, digits and _ is quoted"),
        ("at(living room)", 1, 11, "a name with other characters than letters, digits and _ is quoted"),
        ("at('H&M')", 1, 4, "straight double quotes"),
        ("at(“H&M”)", 1, 4, "straight double quotes"),
        ('at("H&M)', 1, 4, "the quoted name is not ended"),
        ('at("H\n&M")', 1, 4, "the quoted name is not ended"),
        ("[a]", 1, 1, "group with parentheses"),
        ("$1", 1, 1, "stand only among the arguments"),
        (r"\frac a", 1, 1, r"found `\frac`; this LaTeX command has no meaning here"),
        ("a \x00", 1, 3, "found `U+0000`"),
        ('in(a, "")', 1, 7, "a name is empty"),
        ('in("a\tb")', 1, 4, "control character"),
        (r"\mathrm{}", 1, 1, "a name is empty"),
        ("in($0)", 1, 4, "counted from $1"),
        ("in($" + "9" * 5_000 + ")", 1, 4, "counted from $1 to $9999"),
        ("a &\n\n  & b", 3, 3, "found `&`"),
        ("a\r\n& &", 2, 3, "found `&`"),
        ("& a", 1, 4, "found the end"),
        ("& a b c", 1, 7, "expected the end, found `c`"),
    ],
)
def test_place_and_sentence(text: str, line: int, column: int, words: str) -> None:
    error = refusal(text)
    assert error.slug == "formula-syntax"
    assert (error.line, error.column) == (line, column)
    assert error.detail.startswith(f"line {line}, column {column}: ")
    assert words in error.detail
    assert error.places == (Place("", error.detail),)


@pytest.mark.parametrize(
    ("text", "caret"),
    [
        ("a & & b", "a & & b\n    ^"),
        ("F (a\n  & ) & b\n| c", "  & ) & b\n    ^"),
        ("\ta\t& & b", " a & & b\n     ^"),
        ("(a", "(a\n  ^"),
        ("房 & &", "房 & &\n    ^"),
    ],
)
def test_the_caret_is_under_the_column(text: str, caret: str) -> None:
    assert refusal(text).caret == caret


@pytest.mark.parametrize("column", [1, 20, 30_000, 59_999])
def test_of_a_long_line_a_window_is_shown(column: int) -> None:
    text = " " * (column - 1) + "=" + " " * (60_000 - column) + "a"
    error = refusal(text)
    shown, mark = error.caret.split("\n")
    assert error.column == column
    assert shown[mark.index("^")] == "="
    assert max(len(shown), len(mark)) <= CARET_WIDTH + 6


def test_a_megabyte_is_not_echoed() -> None:
    error = refusal("a " + "b" * 60_000)
    assert "bbb..." in error.detail
    assert len(error.detail) < 200
    assert len(error.caret) < 3 * CARET_WIDTH


def test_the_error_of_the_reading_that_got_furthest_is_reported() -> None:
    assert refusal("F & a F &").column == 10
    assert refusal("a & F &").column == 7
    assert refusal("& a b c", Dialect.INFIX).column == 1


def test_delimiters_do_not_shift_the_place() -> None:
    assert refusal("  $a & & b$").column == 8


def test_errors_survive_the_way_between_processes() -> None:
    error = refusal("a & & b")
    again = pickle.loads(pickle.dumps(error))
    assert (again.detail, again.line, again.column, again.caret) == (error.detail, 1, 5, error.caret)
