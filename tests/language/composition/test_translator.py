"""Commands of one task and of several, with the shipped networks."""

from __future__ import annotations

from collections.abc import Sequence

import pytest

from models.language import ComposedTranslator, SpanTranslator, TaughtTranslator, Translation, Utterance
from models.language.composition.translator import voted
from models.queries import Composition, ContextualQuery, parse_query, parse_task


@pytest.fixture(scope="module")
def single() -> SpanTranslator:
    return SpanTranslator.load()


@pytest.fixture(scope="module")
def translator(single: SpanTranslator) -> ComposedTranslator:
    return ComposedTranslator.load(single)


def test_the_odds_of_both_kinds_of_network_are_multiplied() -> None:
    """0.3 to 0.6 against one task, times 95 to 5 for it, are 0.285 to 0.03; what is left out stays left out."""
    several = parse_query("and(navigate_one(zoo), navigate_one(bank))")
    found, alone = voted({several: 0.6}, 0.3, 0.95)
    assert alone == pytest.approx(0.9 * 0.285 / 0.315)
    assert found == {several: pytest.approx(0.9 * 0.03 / 0.315)}


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
        ("go to bay 3, then to gate 12a", "navigate_two(bay 3, gate 12a)"),
        ("don't pick up the sphere", "avoid(pickup(sphere))"),
        ("don't move to the crate", "avoid(move_to(crate))"),
        ("never pick up the red ball", "avoid(pickup_colored(ball, red))"),
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


class Eager:
    """Takes everything for one task."""

    def translate_all(self, texts: Sequence[str], *, candidates: int = 1) -> list[tuple[Translation, ...]]:
        return [(Translation(parse_task("other(thing)"), 0.4),)] * len(texts)


def test_only_what_says_nothing_else_is_asked_of_what_is_near(translator: ComposedTranslator) -> None:
    knowing = translator.knowing(TaughtTranslator.of([]), nearby=Eager())
    assert best(knowing, "never pick up the ball") == "avoid(pickup(ball))"
    assert best(knowing, "pick up the ball, then marinate the carrots") == "then(pickup(ball), other(thing))"


def test_a_single_task_is_a_contextual_query_and_several_are_a_composition(translator: ComposedTranslator) -> None:
    assert isinstance(translator.translate("pick up the ball")[0].query, ContextualQuery)
    assert isinstance(translator.translate("never pick up the ball")[0].query, Composition)
