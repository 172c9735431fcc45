"""Warnings about templates."""

from __future__ import annotations

import pytest

from models.logic import parse
from models.queries import Example, GroundedQuery, learn, parse_query, review, review_composition
from models.world import Environment


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


@pytest.mark.parametrize(
    ("query", "ltl", "warning"),
    [
        ("and(go(p), avoid(go(p)))", "F a & G !a", "contradict each other"),
        ("then(go(p), avoid(go(p)))", "F (a & G !a)", "contradict each other"),
        ("or(go(p), avoid(go(p)))", "F a | G !a", "always holds"),
        ("and(go(p), avoid(go(q)))", "F a & G !b", None),
        ("go(p)", "F (a & !a)", None),  # of a task its template tells
    ],
)
def test_warnings_of_composed_queries(query: str, ltl: str, warning: str | None) -> None:
    found = review_composition(GroundedQuery(parse_query(query), parse(ltl), (), ()))
    assert [warning in one for one in found] == [True] if warning else found == ()
