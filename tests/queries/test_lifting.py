"""Lifting: the objects taken out, the structure kept."""

from __future__ import annotations

import pytest

from models.logic import parse
from models.logic import to_text as formula_text
from models.queries import lift
from models.world import Environment, resolve


@pytest.mark.parametrize(
    ("ltl", "expected"),
    [
        (
            "F (by(ball, crate) & F (by(ball, crate) & lies(crate, q)))",
            "F (by(t, b) & F (by(t, b) & lies(b, p)))",
        ),
        ("F (at(robot, p) & F at(robot, q))", "F (at(r, p1) & F at(r, p2))"),
        ("G colored(orange, orange)", "G colored(t, c)"),
        ("true U false", "true U false"),
    ],
)
def test_lifts(store: Environment, ltl: str, expected: str) -> None:
    lifted = lift(resolve(parse(ltl), store), store)
    assert formula_text(lifted.formula) == formula_text(parse(expected))


def test_variables_remember_what_they_stood_for(store: Environment) -> None:
    lifted = lift(resolve(parse("F by(ball, crate) & F by(orange, crate)"), store), store)
    named = [(variable, symbol.name) for variable, symbol in lifted.variables]
    assert named == [("t1", "ball"), ("b", "crate"), ("t2", "orange")]
