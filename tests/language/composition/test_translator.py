"""Commands of one task and of several, with the shipped networks."""

from __future__ import annotations

import pytest

from models.language import ComposedTranslator, SpanTranslator, TaughtTranslator, Utterance
from models.queries import Composition, ContextualQuery, parse_task


@pytest.fixture(scope="module")
def single() -> SpanTranslator:
    return SpanTranslator.load()


@pytest.fixture(scope="module")
def translator(single: SpanTranslator) -> ComposedTranslator:
    return ComposedTranslator.load(single)


def best(translator: ComposedTranslator, text: str) -> str:
    found = translator.translate(text)
    return str(found[0].query) if found else ""


@pytest.mark.parametrize(
    ("text", "query"),
    [
        ("pick up the ball or go to the kitchen", "or(pickup(ball), navigate_one(kitchen))"),
        ("never go to the zoo", "avoid(navigate_one(zoo))"),
        ("visit the museum but avoid the bridge", "and(navigate_one(museum), avoid(navigate_one(bridge)))"),
        (
            "don't enter the gallery until you have been to the bank",
            "until(avoid(navigate_one(gallery)), navigate_one(bank))",
        ),
        ("go to the cafe again and again", "repeat(navigate_one(cafe))"),
        ("pick up the mug, then go to the attic", "then(pickup(mug), navigate_one(attic))"),
        ("get the mug, then go to the attic", "then(pickup(mug), navigate_one(attic))"),
        ("the mug must be picked up before you go to the attic", "then(pickup(mug), navigate_one(attic))"),
        ("go to shelf b and never go to shelf a", "and(navigate_one(shelf b), avoid(navigate_one(shelf a)))"),
        ("my bread is all gone, so go to the bakery", "navigate_one(bakery)"),
    ],
)
def test_compositions(translator: ComposedTranslator, text: str, query: str) -> None:
    assert best(translator, text) == query


@pytest.mark.parametrize(
    "text",
    ["pick up the ball and sing a song", "never go to the attic while you are holding the mug", "sing and dance"],
)
def test_what_is_understood_in_part_is_not_understood(translator: ComposedTranslator, text: str) -> None:
    assert translator.translate(text) == ()


@pytest.mark.parametrize("text", ["pick up the ball", "go to the zoo and then to the bank", "qwertz", "", " , ."])
def test_what_is_one_task_is_read_as_alone(translator: ComposedTranslator, single: SpanTranslator, text: str) -> None:
    assert translator.translate(text, candidates=3) == single.translate(text, candidates=3)


def test_readings_have_shares_of_one_and_the_same_text_the_same_readings(translator: ComposedTranslator) -> None:
    for text in ("visit the museum but avoid the bridge", "never go to the zoo", "take the cup or the plate"):
        found = translator.translate(text, candidates=5)
        assert found == translator.translate(text, candidates=5)
        assert len({reading.query for reading in found}) == len(found)
        assert sum(reading.confidence for reading in found) <= 1 + 1e-9
        assert [r.confidence for r in found] == sorted((r.confidence for r in found), reverse=True)


def test_taught_clauses(translator: ComposedTranslator) -> None:
    taught = TaughtTranslator.of([Utterance.of("water the roses", parse_task("water(roses)"))])
    found = translator.knowing(taught).translate("never water the tulips")
    assert str(found[0].query) == "avoid(water(tulips))"
    assert not any("water(" in str(reading.query) for reading in translator.translate("never water the tulips"))


def test_a_single_task_is_a_contextual_query_and_several_are_a_composition(translator: ComposedTranslator) -> None:
    assert isinstance(translator.translate("pick up the ball")[0].query, ContextualQuery)
    assert isinstance(translator.translate("never pick up the ball")[0].query, Composition)
