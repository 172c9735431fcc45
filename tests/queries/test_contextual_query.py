"""Contextual queries: reading, printing, and what is refused where."""

from __future__ import annotations

import pytest
from hypothesis import given
from hypothesis import strategies as st

from models.queries import MAX_ARGUMENTS, MAX_QUERY_TEXT, ContextualQuery, QuerySyntaxError, parse_query

NAMES = st.from_regex(r"[A-Za-z_][A-Za-z0-9_]{0,20}", fullmatch=True)
PHRASES = st.text(st.characters(exclude_categories=["C", "Z"]) | st.just(" "), min_size=1, max_size=30).filter(
    str.strip
)


@pytest.mark.parametrize(
    ("text", "task", "arguments"),
    [
        ("ship(cylinder, box, bedroom)", "ship", ("cylinder", "box", "bedroom")),
        ("  pickup ( the  small\tred bucket )  ", "pickup", ("the small red bucket",)),
        ('go("H&M (2nd floor)")', "go", ("H&M (2nd floor)",)),
        (r'go("say \"hi\" \\ there")', "go", (r'say "hi" \ there',)),
        ("patrol()", "patrol", ()),
        ("visit(Macy's, O'Hare, #12 - north)", "visit", ("Macy's", "O'Hare", "#12 - north")),
        ("go(\n  kitchen,\n  hall\n)", "go", ("kitchen", "hall")),
        ("véhicule(boîte)", "véhicule", ("boîte",)),
    ],
)
def test_reads(text: str, task: str, arguments: tuple[str, ...]) -> None:
    assert parse_query(text) == ContextualQuery(task, arguments)


@pytest.mark.parametrize(
    ("text", "line", "column"),
    [
        ("", 1, 1),
        ("ship", 1, 5),
        ("ship(", 1, 6),
        ("ship(a", 1, 7),
        ("ship(a,)", 1, 8),
        ("ship(,a)", 1, 6),
        ("ship(a) b", 1, 9),
        ("ship(a))", 1, 8),
        ("2ship(a)", 1, 1),
        ('ship("a)', 1, 6),
        ('ship(a "b")', 1, 8),
        ("ship(a,\n     b(c))", 2, 7),
        ("(a)", 1, 1),
    ],
)
def test_a_syntax_error_names_its_place(text: str, line: int, column: int) -> None:
    with pytest.raises(QuerySyntaxError) as caught:
        parse_query(text)
    error = caught.value
    assert (error.line, error.column) == (line, column)
    source, mark = error.caret.split("\n")
    assert source == (text.split("\n")[line - 1] if text else "")
    assert mark == " " * (column - 1) + "^"


def test_the_caret_of_a_long_line_stays_in_view() -> None:
    text = "go(" + "x" * 3000 + '"' + "y" * 500 + ")"
    with pytest.raises(QuerySyntaxError) as caught:
        parse_query(text)
    source, mark = caught.value.caret.split("\n")
    assert caught.value.column == 3004
    assert len(source) <= 90
    assert source[mark.index("^")] == '"'


@pytest.mark.parametrize(
    "text",
    [
        "a" * (MAX_QUERY_TEXT + 1),
        "f(" + ",".join("a" for _ in range(MAX_ARGUMENTS + 1)) + ")",
        "f(\x00)",
        'f("")',
    ],
)
def test_limits_and_unprintable_phrases_are_refused(text: str) -> None:
    with pytest.raises(QuerySyntaxError):
        parse_query(text)


@given(NAMES, st.lists(PHRASES, max_size=5))
def test_what_is_printed_reads_back(task: str, arguments: list[str]) -> None:
    query = ContextualQuery(task, tuple(arguments))
    assert parse_query(str(query)) == query


@given(st.text(max_size=80))
def test_any_text_is_read_or_refused(text: str) -> None:
    try:
        query = parse_query(text)
    except QuerySyntaxError:
        return
    assert parse_query(str(query)) == query
