"""The first thing that went wrong is the cause."""

from __future__ import annotations

import pytest

from models.language.dataset import fill
from models.language.experiments.answer import Answer
from models.language.experiments.causes import NO_TEMPLATE, Cause, cause_of_formula, cause_of_query
from models.logic import parse
from models.queries import parse_query

EXAMPLE = fill("manipulation", "pickup_colored", "Grab the {color} {object}", {"color": "red", "object": "ball"})


@pytest.mark.parametrize(
    ("query", "refusal", "cause"),
    [
        (None, None, Cause.NO_ANSWER),
        ("pickup(ball)", None, Cause.WRONG_CLASS),
        ("pickup(cube)", "ambiguous-grounding", Cause.WRONG_CLASS),
        ("pickup_colored(ball)", "arity-mismatch", Cause.WRONG_COUNT),
        ("pickup_colored(red, ball)", "type-mismatch", Cause.WRONG_ARGUMENT),
        ("pickup_colored(ball, blue)", None, Cause.WRONG_ARGUMENT),
        ("pickup_colored(ball, orange)", "ambiguous-grounding", Cause.WRONG_ARGUMENT),
        ("pickup_colored(ball, red)", NO_TEMPLATE, Cause.NO_TEMPLATE),
        ("pickup_colored(ball, red)", "ambiguous-grounding", Cause.AMBIGUOUS_GROUNDING),
        ("pickup_colored(ball, red)", "unknown-object", Cause.WRONG_GROUNDING),
        ("pickup_colored(ball, red)", None, Cause.WRONG_GROUNDING),
    ],
)
def test_queries(query: str | None, refusal: str | None, cause: Cause) -> None:
    answer = Answer(None if query is None else parse_query(query), refusal=refusal)
    assert cause_of_query(answer, EXAMPLE) is cause


@pytest.mark.parametrize(
    ("formula", "cause"),
    [
        (None, Cause.NOT_A_FORMULA),
        ("F holding(ball)", Cause.WRONG_STRUCTURE),
        ("F (holding(ball) & colored(ball, blue))", Cause.WRONG_PROPOSITION),
    ],
)
def test_formulas(formula: str | None, cause: Cause) -> None:
    answer = Answer(formula=None if formula is None else parse(formula))
    assert cause_of_formula(answer, parse("F (holding(ball) & colored(ball, red))")) is cause
