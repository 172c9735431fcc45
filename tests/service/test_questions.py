"""Which readings are asked about, by how probable they are."""

from __future__ import annotations

from dataclasses import replace

import pytest

from models.errors import CqltlError
from models.logic import parse
from models.queries import GroundedQuery, parse_query
from models.world import builtin_environments, load_environment
from service.questions import Answer, Question, answered, question_of
from service.taught import Taught
from service.understanding import Meaning, Understanding

TOYS = load_environment(dict(builtin_environments())["toys"])
NOTHING_TAUGHT = Taught.of(0, {})
TEXT = "catch it"


def reading(query: str, ltl: str, confidence: float) -> Understanding:
    said, formula = parse_query(query), parse(ltl)
    return Understanding(said, confidence, Meaning(formula, GroundedQuery(said, formula, (), ())), None)


def asked(*readings: Understanding) -> Question | None:
    return question_of(TEXT, readings, NOTHING_TAUGHT, TOYS)


PICK = ("pickup(sphere)", "F holding(sphere)")
GO = ("move_to(sphere)", "F near(robot, sphere)")


@pytest.mark.parametrize(
    ("first", "second", "choices"),
    [
        (0.9, 0.05, None),
        (0.4, 0.2, None),  # improbable, but far more probable than the other
        (0.4, 0.3, ("pickup(sphere)", "move_to(sphere)")),
        (0.2, 0.01, ("pickup(sphere)", "move_to(sphere)")),  # so improbable that all that makes sense is offered
    ],
)
def test_readings_are_asked_about(first: float, second: float, choices: tuple[str, ...] | None) -> None:
    question = asked(reading(*PICK, first), reading(*GO, second))
    assert (question and question.choices) == choices


def test_a_single_improbable_reading_is_to_be_confirmed() -> None:
    doubtful = reading(*PICK, 0.1)
    question = asked(doubtful)
    assert question is not None
    assert (question.about, question.choices) == ("reading", ("pickup(sphere)",))
    assert question.text == "do you mean: eventually the robot is holding the sphere?"
    (left,) = answered(TEXT, [doubtful], [Answer("pickup(sphere)")], NOTHING_TAUGHT, TOYS)
    assert left.confidence == 1.0
    assert asked(left) is None
    assert asked(reading(*PICK, 0.3)) is None


def test_what_the_words_do_not_say_is_to_be_confirmed() -> None:
    impossible = CqltlError("kitchens cannot be picked up")
    found = replace(reading(*GO, 0.9), instead_of=impossible)
    question = asked(found)
    assert question is not None
    assert question.text == "kitchens cannot be picked up; do you mean: eventually the robot is at the sphere?"
    (left,) = answered(TEXT, [found], [Answer("move_to(sphere)")], NOTHING_TAUGHT, TOYS)
    assert asked(left) is None
