"""Contextual queries: reading, printing, and what is refused where."""

from __future__ import annotations

import re

import pytest
from hypothesis import given
from hypothesis import strategies as st

from models.queries import (
    MAX_ARGUMENTS,
    MAX_NESTING,
    MAX_PARTS,
    MAX_QUERY_TEXT,
    OPERATORS,
    Composition,
    ContextualQuery,
    Operator,
    Query,
    QuerySyntaxError,
    parse_query,
    parse_task,
)

NAMES = st.from_regex(r"[A-Za-z_][A-Za-z0-9_]{0,20}", fullmatch=True).filter(lambda name: name not in OPERATORS)
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


TASKS = st.builds(ContextualQuery, NAMES, st.lists(PHRASES, max_size=4).map(tuple))


def _composed(inner: st.SearchStrategy[Query]) -> st.SearchStrategy[Query]:
    def of(operator: Operator) -> st.SearchStrategy[Query]:
        least, most = operator.takes
        operands = st.lists(inner, min_size=least, max_size=most or 3)
        return st.builds(Composition, st.just(operator), operands.map(tuple))

    return st.sampled_from(Operator).flatmap(of)


@given(st.recursive(TASKS, _composed, max_leaves=6))
def test_what_is_printed_reads_back(query: Query) -> None:
    assert parse_query(str(query)) == query


def test_compositions() -> None:
    text = 'then(pickup(red ball), or( move_to(the  hall) ,and(move_to(a), avoid(move_to("b (2)")))))'
    query = parse_query(text)
    assert isinstance(query, Composition)
    assert str(query) == 'then(pickup(red ball), or(move_to(the hall), and(move_to(a), avoid(move_to("b (2)")))))'
    assert [(path, str(task)) for path, task in query.tasks] == [
        ((0,), "pickup(red ball)"),
        ((1, 0), "move_to(the hall)"),
        ((1, 1, 0), "move_to(a)"),
        ((1, 1, 1, 0), 'move_to("b (2)")'),
    ]


@pytest.mark.parametrize(
    ("text", "line", "column", "says"),
    [
        ("then(a(b))", 1, 1, "then takes 2 or more operands, not 1"),
        ("and(a(b),\n or(c(d)))", 2, 2, "or takes 2 or more operands, not 1"),
        ("avoid(a(b), c(d))", 1, 1, "avoid takes 1 operand, not 2"),
        ("until(a(b), c(d), e(f))", 1, 1, "until takes 2 operands, not 3"),
        ("repeat()", 1, 1, "repeat takes 1 operand, not 0"),
        ("then(a(b), kitchen)", 1, 12, "queries such as pickup(ball), not phrases"),
        ('avoid("the hall")', 1, 7, "queries such as pickup(ball), not phrases"),
        ("a(b(c))", 1, 4, "the arguments of a task are phrases"),
        ("and(a(b), not a name(c))", 1, 11, "is not a name"),
        ("and(a(b), c(d)", 1, 15, "found the end"),
        ("(" * 50, 1, MAX_NESTING + 1, "parts deep"),
    ],
)
def test_a_wrong_composition_names_its_place(text: str, line: int, column: int, says: str) -> None:
    with pytest.raises(QuerySyntaxError, match=re.escape(says)) as caught:
        parse_query(text)
    assert (caught.value.line, caught.value.column) == (line, column)
    assert caught.value.caret


def test_limits_of_compositions() -> None:
    task = ContextualQuery("go", ("x",))
    deep: Query = task
    for _ in range(MAX_NESTING - 1):
        deep = Composition(Operator.REPEAT, (deep,))
    assert parse_query(str(deep)) == deep
    with pytest.raises(QuerySyntaxError, match="deep"):
        Composition(Operator.REPEAT, (deep,))
    Composition(Operator.AND, (task,) * (MAX_PARTS - 1))
    with pytest.raises(QuerySyntaxError, match="parts"):
        Composition(Operator.AND, (task,) * MAX_PARTS)
    with pytest.raises(QuerySyntaxError, match="puts queries together"):
        ContextualQuery("then", ("a", "b"))


def test_a_task_is_not_a_composition() -> None:
    assert parse_task("go(x)") == ContextualQuery("go", ("x",))
    with pytest.raises(QuerySyntaxError, match="what is taught is one task"):
        parse_task("and(go(x), go(y))")


@given(st.text(max_size=80))
def test_any_text_is_read_or_refused(text: str) -> None:
    try:
        query = parse_query(text)
    except QuerySyntaxError:
        return
    assert parse_query(str(query)) == query
