"""The shipped systems on single texts: the paper's sentences, both domains, confidences, refusals."""

from __future__ import annotations

import math
import random
from pathlib import Path

import pytest

from models.language import BEAM_WIDTH, MAX_WORDS, TextTooLongError, Translation, Translator, WeightsError
from models.language.copynet import (
    CqCopyNetPosTranslator,
    CqCopyNetTranslator,
    LtlCopyNetTranslator,
    Models,
    answers,
    formulas,
    pos_answers,
)
from models.language.copynet.items import to_batch
from models.language.copynet.network import loss
from models.language.copynet.queries import spell_query
from models.language.copynet.translators import STRANGE
from models.language.dataset import Domain, generate
from models.language.tokens import words
from models.logic import parse
from models.queries import parse_query

PAPER = "Put the cylinder in the box, then put the box in the bedroom"
SHIP = "F (in(cylinder, box) & F (in(cylinder, box) & at(box, bedroom)))"
NOTHING = ["", "  \t\n", "?!...", "\x00\x07\u200b", "never go to the bakery", "don't pick up the ball"]


@pytest.fixture(scope="module")
def cq() -> CqCopyNetTranslator:
    return CqCopyNetTranslator.load()


@pytest.fixture(scope="module")
def pos() -> CqCopyNetPosTranslator:
    return CqCopyNetPosTranslator.load()


@pytest.fixture(scope="module")
def ltl() -> LtlCopyNetTranslator:
    return LtlCopyNetTranslator.load()


@pytest.mark.parametrize(
    ("text", "query", "formula"),
    [
        (PAPER, "ship(cylinder, box, bedroom)", SHIP),
        (PAPER.upper() + "!!!", "ship(cylinder, box, bedroom)", SHIP),
        ("Pick up the sphere", "pickup(sphere)", "F holding(sphere)"),
        ("Fetch the green cube", "pickup_colored(cube, green)", "F (holding(cube) & colored(cube, green))"),
        ("Go to the bakery", "navigate_one(bakery)", "F at(robot, bakery)"),
        (
            "Go to the coffee shop, then go to the pharmacy",
            "navigate_two(coffee shop, pharmacy)",
            "F (at(robot, coffee_shop) & F at(robot, pharmacy))",
        ),
    ],
)
def test_what_they_were_trained_on(
    cq: CqCopyNetTranslator,
    pos: CqCopyNetPosTranslator,
    ltl: LtlCopyNetTranslator,
    text: str,
    query: str,
    formula: str,
) -> None:
    for translator in (cq, pos):
        (reading,) = translator.translate(text)
        assert reading.query == parse_query(query)
        assert 0.5 < reading.confidence <= 1.0
    (read,) = ltl.translate(text)
    assert read.formula == parse(formula)
    assert 0.5 < read.confidence <= 1.0


def test_new_names(cq: CqCopyNetTranslator, ltl: LtlCopyNetTranslator) -> None:
    """CQ-CopyNet copies them; LTL-CopyNet can do so with places, and says other propositions of objects."""
    assert str(cq.translate("Put the mug in the crate, then put the crate in the attic")[0].query) == (
        "ship(mug, crate, attic)"
    )
    assert ltl.translate("Head for the brewery")[0].formula == parse("F at(robot, brewery)")
    assert ltl.translate("Pick up the hammer")[0].formula != parse("F holding(hammer)")


def test_the_domain_is_told_from_the_words(cq: CqCopyNetTranslator, ltl: LtlCopyNetTranslator) -> None:
    """Commands of both domains get the reading that the network of their own domain gives."""
    for index, domain in enumerate(Domain):
        examples = random.Random(0).sample([e for e in generate(domain).seen if e.distinct], 25)
        texts = [example.text for example in examples]
        queries, read = answers(cq.models[index], texts), formulas(ltl.models[index], texts)
        assert sum(q == cq.translate(t)[0].query for t, q in zip(texts, queries, strict=True)) >= 24
        assert sum(f == ltl.translate(t)[0].formula for t, f in zip(texts, read, strict=True)) >= 24


def test_part_of_speech(pos: CqCopyNetPosTranslator) -> None:
    """Every reading has the arguments of `pos_answers`, also too many."""
    text = "Grasp the hammer with your gripper"
    readings = pos.translate(text, candidates=BEAM_WIDTH)
    assert {reading.query.arguments for reading in readings} == {("hammer", "gripper")}
    assert [readings[0].query] == pos_answers(pos.models[0], [text])
    assert len({reading.query.task for reading in readings}) == len(readings) > 1


def test_candidates(cq: CqCopyNetTranslator, pos: CqCopyNetPosTranslator, ltl: LtlCopyNetTranslator) -> None:
    text = "Fetch the flimsy grelb"
    for translator in (cq, pos, ltl):
        readings = translator.translate(text, candidates=BEAM_WIDTH)
        assert 1 < len(set(readings)) == len(readings) <= BEAM_WIDTH
        confidences = [reading.confidence for reading in readings]
        assert confidences == sorted(confidences, reverse=True)
        assert 0 < sum(confidences) <= 1.0 + 1e-6
        for count in range(1, BEAM_WIDTH + 1):
            assert translator.translate(text, candidates=count) == readings[:count]
        assert translator.translate(text, candidates=99) == readings
        with pytest.raises(ValueError, match="at least one"):
            translator.translate(text, candidates=0)


def test_arguments_are_phrases_of_the_text(cq: CqCopyNetTranslator) -> None:
    for example in random.Random(1).sample(generate("manipulation").unseen, 15):
        for reading in cq.translate(example.text, candidates=BEAM_WIDTH):
            for phrase in reading.query.arguments:
                assert f" {phrase} " in f" {' '.join(words(example.text))} "


def test_confidence_of_one_domain_is_its_networks_probability(small: Models) -> None:
    translator = CqCopyNetTranslator((small.cq,))
    text = "Head for the bank"
    (reading,) = translator.translate(text)
    source, target = to_batch([words(text)], [spell_query(reading.query)], [()], small.cq.vocabulary)
    expected = math.exp(-loss(small.cq.network(source, target), source, target).item())
    assert reading.confidence == pytest.approx(expected, rel=1e-4)


def test_shares_of_two_domains(small: Models, cq: CqCopyNetTranslator) -> None:
    """A word that only one of the networks knows makes it ten times as likely."""
    both = CqCopyNetTranslator((cq.models[1], cq.models[0]))
    text = "Navigate to the zorb"  # the second does not know "navigate"
    alone = [
        {r.query: r.confidence for r in CqCopyNetTranslator((m,)).translate(text, candidates=5)} for m in both.models
    ]
    for reading in both.translate(text, candidates=5):
        first, second = (readings.get(reading.query, 0.0) for readings in alone)
        assert reading.confidence == pytest.approx((first + STRANGE * second) / (1 + STRANGE), rel=1e-4)


@pytest.mark.parametrize("text", NOTHING)
def test_nothing_is_said(
    cq: CqCopyNetTranslator, pos: CqCopyNetPosTranslator, ltl: LtlCopyNetTranslator, text: str
) -> None:
    for translator in (cq, pos, ltl):
        assert translator.translate(text, candidates=3) == ()


@pytest.mark.parametrize("text", ["word " * 10_000, "a" * 100_000, "go " * (MAX_WORDS + 1)])
def test_too_long(cq: CqCopyNetTranslator, pos: CqCopyNetPosTranslator, ltl: LtlCopyNetTranslator, text: str) -> None:
    for translator in (cq, pos, ltl):
        with pytest.raises(TextTooLongError):
            translator.translate(text)


@pytest.mark.parametrize(
    "text",
    [
        "pickup the " + "z" * 1_900,
        "Ship the {0} to the {0} in the {0}".format("z" * 600),
        "go to the bank, then " * 40,
        "pick up the " + "very " * 180 + "red ball",
        'pick up the "ball", (the) red\\one',
        "Pickup the \ud800sphere 🏀",
        "привет, как дела?",
    ],
)
def test_odd_texts_are_answered(
    cq: CqCopyNetTranslator, pos: CqCopyNetPosTranslator, ltl: LtlCopyNetTranslator, text: str
) -> None:
    for translator in (cq, pos):
        for reading in translator.translate(text, candidates=3):
            assert parse_query(str(reading.query)) == reading.query
    assert len(ltl.translate(text, candidates=3)) <= 3


def test_contract(cq: CqCopyNetTranslator, pos: CqCopyNetPosTranslator) -> None:
    for translator in (cq, pos):
        held: Translator = translator
        (reading,) = held.translate("Pick up the sphere")
        assert reading == Translation(parse_query("pickup(sphere)"), reading.confidence)


def test_no_weights(tmp_path: Path) -> None:
    for system in (CqCopyNetTranslator, CqCopyNetPosTranslator, LtlCopyNetTranslator):
        with pytest.raises(WeightsError):
            system.load(tmp_path)


def test_loaded_again_they_say_the_same(cq: CqCopyNetTranslator) -> None:
    again = CqCopyNetTranslator.load()
    assert again.translate(PAPER, candidates=5) == cq.translate(PAPER, candidates=5)
