"""What is a formula or a query, and what a command."""

from __future__ import annotations

import pytest

from models.language import ComposedTranslator, SpanTranslator
from models.language.formal import is_formal
from models.language.hearing import Hearing

FORMAL = [
    "F (in(cylinder, box))",
    "G !at(bathroom)",
    "G F holding(sphere) & G F holding(cube)",
    "(!at(lab)) U at(kitchen)",
    "ship(cylinder, box, bedroom)",
    "then(pickup(cup), repeat(navigate_one(the old library)))",
]


@pytest.mark.parametrize("text", FORMAL)
def test_formulas_and_queries_are_formal_and_say_nothing_as_commands(text: str) -> None:
    assert is_formal(text)
    hearing = Hearing(ComposedTranslator.load(SpanTranslator.load()), None, lambda _: None)
    assert hearing.readings(text, None, candidates=3) == ()


@pytest.mark.parametrize(
    "text",
    [
        "",
        "museum",
        "go to the museum",
        "go to the museum(s) and the zoo",
        "fetch the ball (the red one)",
        "put the cup in the box(the big one), please",
        "F(",
        "cafe, then H&M, then the fountain!",
    ],
)
def test_commands_are_not(text: str) -> None:
    assert not is_formal(text)
