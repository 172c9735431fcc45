"""Shapes and what fills them."""

from __future__ import annotations

import pytest

from models.language.composition.shapes import filled, forbidden, read_shape
from models.language.dataset.composition import patterns
from models.queries import parse_query


@pytest.mark.parametrize(
    ("shape", "clauses", "query"),
    [
        ("1", ["go(a)"], "go(a)"),
        ("then(1, or(2, 3))", ["go(a)", "go(b)", "go(c)"], "then(go(a), or(go(b), go(c)))"),
        ("and(1, avoid(2))", ["go(a)", "pick(b)"], "and(go(a), avoid(pick(b)))"),
        ("and(1, until(avoid(2), 1))", ["go(a)", "go(b)"], "and(go(a), until(avoid(go(b)), go(a)))"),
        ("then(1, 2)", ["then(go(a), go(b))", "go(c)"], "then(go(a), go(b), go(c))"),
        ("or(1, 2)", ["and(go(a), go(b))", "go(c)"], "or(and(go(a), go(b)), go(c))"),
        ("and(1, 2)", ["go(a)", "go(a)"], "go(a)"),
        ("then(1, 2)", ["go(a)", "go(a)"], "then(go(a), go(a))"),
    ],
)
def test_a_shape_is_filled(shape: str, clauses: list[str], query: str) -> None:
    given = {number: parse_query(clause) for number, clause in enumerate(clauses, start=1)}
    assert filled(read_shape(shape), given) == parse_query(query)


def test_forbidden_clauses() -> None:
    assert forbidden("and(then(1, 2), avoid(3))") == {3}
    assert forbidden("and(1, until(avoid(2), 3))") == {2, 3}
    assert forbidden("and(1, 2)") == set()


def test_every_shape_of_the_patterns_is_read() -> None:
    for shape, group in patterns().items():
        assert {int(task.arguments[0]) for _, task in read_shape(shape).tasks} == {h.leaf for h in group[0].holes}
