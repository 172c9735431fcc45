"""Grounding by name alone: what it gives, and what it cannot tell."""

from __future__ import annotations

import pytest

from models.language.dataset import Domain
from models.language.experiments.commands import paper_sets
from models.language.experiments.naming import answer_by_name
from models.language.experiments.templates import given
from models.logic import to_text
from models.queries import parse_query

SEEN, UNSEEN = paper_sets(Domain.MANIPULATION)
TEMPLATES = given(SEEN)


@pytest.mark.parametrize(
    ("query", "formula"),
    [
        ("pickup(teddy bear)", "F holding(teddy_bear)"),
        ("pickup(cylinder)", "F holding(cylinder)"),  # a shape too, but no task speaks of shapes
        ("pickup_colored(ball, red)", "F (holding(ball) & colored(ball, red))"),
        ("ship(ball, box, living room)", "F (in(ball, box) & F (in(ball, box) & at(box, living_room)))"),
    ],
)
def test_a_query_of_known_names(query: str, formula: str) -> None:
    parsed = parse_query(query)
    answer = answer_by_name(TEMPLATES[parsed.task], parsed, SEEN.environment)
    assert answer.formula is not None
    assert to_text(answer.formula) == formula
    assert (answer.query, answer.refusal, answer.confidence) == (parsed, None, 1.0)


@pytest.mark.parametrize(
    ("query", "refusal"),
    [
        ("pickup(orange)", "ambiguous-grounding"),  # a fruit and a colour, though no colour can be held
        ("ship(ball, bag, kitchen)", "ambiguous-grounding"),  # a toy and a container
        ("pickup_colored(ball, orange)", "ambiguous-grounding"),
        ("pickup(bear)", "unknown-object"),  # the head of "teddy bear" is not its name
        ("pickup(the ball)", "unknown-object"),
        ("pickup(mug)", "unknown-object"),
        ("pickup(red)", "type-mismatch"),
        ("pickup(ball, red)", "arity-mismatch"),
        ("ship(ball, box)", "arity-mismatch"),
    ],
)
def test_what_is_refused(query: str, refusal: str) -> None:
    parsed = parse_query(query)
    answer = answer_by_name(TEMPLATES[parsed.task], parsed, SEEN.environment)
    assert (answer.formula, answer.refusal) == (None, refusal)


def test_a_template_of_s_serves_the_world_of_u() -> None:
    answer = answer_by_name(TEMPLATES["pickup"], parse_query("pickup(mug)"), UNSEEN.environment)
    assert answer.formula is not None
    assert to_text(answer.formula) == "F holding(mug)"
