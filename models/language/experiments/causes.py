"""Why an answer is wrong (paper, § Discussion): the first of these that applies."""

from __future__ import annotations

from enum import StrEnum

from models.language.dataset import Example
from models.language.experiments.answer import Answer
from models.language.experiments.comparison import says, shape
from models.logic import Formula
from models.queries import AmbiguousGroundingError

NO_TEMPLATE = "no-template"
"""The refusal of a query whose task class has no template."""


class Cause(StrEnum):
    """What went wrong on the way to the grounded formula."""

    NO_ANSWER = "no answer"
    NOT_A_FORMULA = "not a formula"
    WRONG_CLASS = "wrong class"
    WRONG_COUNT = "wrong argument count"
    WRONG_ARGUMENT = "wrong argument"
    NO_TEMPLATE = "no template"
    AMBIGUOUS_GROUNDING = "ambiguous grounding"
    WRONG_GROUNDING = "wrong grounding"
    WRONG_STRUCTURE = "wrong structure"
    WRONG_PROPOSITION = "wrong proposition"


def cause_of_query(answer: Answer, example: Example) -> Cause:
    """Why the formula that a system that speaks queries gives for an example is wrong."""
    said = answer.query
    if said is None:
        return Cause.NO_ANSWER
    if said.task != example.task:
        return Cause.WRONG_CLASS
    if len(said.arguments) != len(example.query.arguments):
        return Cause.WRONG_COUNT
    if not says(said, example):
        return Cause.WRONG_ARGUMENT
    if answer.refusal == NO_TEMPLATE:
        return Cause.NO_TEMPLATE
    if answer.refusal == AmbiguousGroundingError.slug:
        return Cause.AMBIGUOUS_GROUNDING
    return Cause.WRONG_GROUNDING


def cause_of_formula(answer: Answer, formula: Formula) -> Cause:
    """Why the formula of a system that speaks nothing else is wrong, where `formula` would have been right."""
    if answer.formula is None:
        return Cause.NOT_A_FORMULA
    return Cause.WRONG_PROPOSITION if shape(answer.formula) == shape(formula) else Cause.WRONG_STRUCTURE
