"""The shipped translator: the paper's sentences, accuracy, refusals, nasty text, determinism, speed."""

from __future__ import annotations

import random
import statistics
import time
from collections.abc import Iterator

import pytest
import torch
from hypothesis import given, settings
from hypothesis import strategies as st

from models.language import BEAM_WIDTH, MAX_WORDS, CopyNetTranslator, TextTooLongError, Translator
from models.language.accuracy import by_task, refusals
from models.language.dataset import Domain, Example, Part, generate, no_task
from models.language.tokens import words
from models.language.translator import Translation
from models.queries import ContextualQuery, parse_query

PAPER = "Put the cylinder in the box, then put the box in the bedroom"

COMMANDS = {
    PAPER: "ship(cylinder, box, bedroom)",
    PAPER.upper() + "!!!": "ship(cylinder, box, bedroom)",
    "  put the cylinder in the box  then put the box in the bedroom .": "ship(cylinder, box, bedroom)",
    "Pickup the sphere": "pickup(sphere)",
    "pickup the sphere.": "pickup(sphere)",
    "PICKUP THE SPHERE": "pickup(sphere)",
    "Pick up the red ball": "pickup_colored(ball, red)",
    "Could you grab the ball that is red?": "pickup_colored(ball, red)",
    "Pick up the orange orange": "pickup_colored(orange, orange)",
    "Put the bag in the bag, then put the bag in the kitchen": "ship(bag, bag, kitchen)",
    "Ship the teddy bear to the living room in the basket": "ship(teddy bear, basket, living room)",
    "Approach the zorb": "move_to(zorb)",  # a word that no vocabulary holds
    "Ship the zorb to the blarg in the flonk": "ship(zorb, flonk, blarg)",
    "Go to the O'Hare, then go to the town hall": "navigate_two(o'hare, town hall)",
    "Navigate to the quarry by way of the university and then the clinic": "navigate_three(university, clinic, quarry)",
}

NO_TASK = [
    "",
    "   \t\n ",
    "?!...",
    "\x00\x07\u200b\ufeff",
    "\ud800",
    "🏀🤖",
    "hello",
    "what is the weather today?",
    "asdf qwer",
    "the",
    "x",
    "( , ) end of query no task",
    "Sing me a song about robots",
    "don't pick up the ball",
    "never go to the bakery",
    "throw the sphere",
    "SELECT * FROM users; --",
    "F (in(cylinder, box))",
    "привет, как дела?",
    "你好",
]


@pytest.fixture(scope="module", autouse=True)
def _one_thread() -> Iterator[None]:
    threads = torch.get_num_threads()
    torch.set_num_threads(1)
    yield
    torch.set_num_threads(threads)


@pytest.fixture(scope="module")
def translator() -> CopyNetTranslator:
    return CopyNetTranslator.load()


def _sample(part: Part, domain: Domain, per_task: int) -> list[Example]:
    """The same examples every time, `per_task` of each task class (all of a smaller one)."""
    groups: dict[str, list[Example]] = {}
    for example in generate(domain).seen if part is Part.SEEN else generate(domain).unseen:
        groups.setdefault(example.task, []).append(example)
    generator = random.Random(0)
    return [e for group in groups.values() for e in generator.sample(group, min(per_task, len(group)))]


@pytest.mark.parametrize(("text", "query"), COMMANDS.items())
def test_commands(translator: CopyNetTranslator, text: str, query: str) -> None:
    (reading,) = translator.translate(text)
    assert reading.query == parse_query(query)
    assert translator.min_confidence <= reading.confidence <= 1.0


@pytest.mark.parametrize("text", NO_TASK)
def test_no_task_fits(translator: CopyNetTranslator, text: str) -> None:
    assert translator.translate(text, candidates=3) == ()


@pytest.mark.parametrize("domain", list(Domain))
@pytest.mark.parametrize("part", list(Part))
def test_accuracy(translator: CopyNetTranslator, part: Part, domain: Domain) -> None:
    """The whole of S and U is measured by the training script; every class of this sample is near what it reports."""
    for task, tally in by_task(translator, _sample(part, domain, 40)).items():
        assert tally.rate >= 0.95, (task, str(tally))


def test_refusals(translator: CopyNetTranslator) -> None:
    """Texts whose sentences, verbs and frames training never read."""
    assert refusals(translator, no_task().held_out[::2]).rate >= 0.9


def test_candidates(translator: CopyNetTranslator) -> None:
    text = "pick up the flimsy grelb"  # may be one thing of two words
    readings = translator.translate(text, candidates=BEAM_WIDTH)
    assert {str(reading.query) for reading in readings} >= {"pickup_colored(grelb, flimsy)", "pickup(flimsy grelb)"}
    confidences = [reading.confidence for reading in readings]
    assert confidences == sorted(confidences, reverse=True)
    assert sum(confidences) <= 1.0 + 1e-6
    assert len({reading.query for reading in readings}) == len(readings) <= BEAM_WIDTH
    for count in range(1, BEAM_WIDTH + 1):
        assert translator.translate(text, candidates=count) == readings[:count]
    with pytest.raises(ValueError, match="at least one"):
        translator.translate(text, candidates=0)


def test_every_argument_is_a_phrase_of_the_text(translator: CopyNetTranslator) -> None:
    for example in _sample(Part.UNSEEN, Domain.MANIPULATION, 10):
        for reading in translator.translate(example.text, candidates=BEAM_WIDTH):
            for phrase in reading.query.arguments:
                assert f" {phrase} " in f" {' '.join(words(example.text))} "


def test_confidence_is_the_networks_probability(translator: CopyNetTranslator) -> None:
    """The same number from teacher forcing: the loss of the answer is its negative log-probability."""
    from models.language.accuracy import greedy
    from models.language.items import command

    example = _sample(Part.UNSEEN, Domain.NAVIGATION, 1)[0]
    (reading,) = translator.translate(example.text)
    value, _ = greedy(translator.network, translator.vocabulary, [command(example)])
    assert reading.confidence == pytest.approx(float(torch.tensor(-value).exp()), rel=1e-4)


def test_below_the_least_confidence(translator: CopyNetTranslator) -> None:
    strict = CopyNetTranslator(translator.network, translator.vocabulary, translator.arities, 1.1)
    assert strict.translate(PAPER) == ()
    lax = CopyNetTranslator(translator.network, translator.vocabulary, translator.arities, 0.0)
    assert lax.translate(PAPER) == translator.translate(PAPER)


@pytest.mark.parametrize("text", ["word " * 10_000, "a" * 100_000, "🏀" * 5_000, "go " * (MAX_WORDS + 1)])
def test_too_long(translator: CopyNetTranslator, text: str) -> None:
    with pytest.raises(TextTooLongError):
        translator.translate(text)


@pytest.mark.parametrize(
    "text",
    [
        "pickup the " + "z" * 1_900,
        f"put the {'z' * 1_800} in the {'z' * 10}",
        "Ship the {0} to the {0} in the {0}".format("z" * 600),
        "put the box " * 60,
        "go to the bank, then " * 40,
        "pick up the " + "very " * 180 + "red ball",
        'pick up the "ball", (the) red\\one',
        "Pickup the \ud800sphere",
    ],
)
def test_odd_texts_are_answered(translator: CopyNetTranslator, text: str) -> None:
    for reading in translator.translate(text, candidates=3):
        assert parse_query(str(reading.query)) == reading.query


@settings(max_examples=40, deadline=None)
@given(st.text(max_size=80) | st.lists(st.sampled_from([*words(PAPER), "pickup", "zorb", "red", ","])).map(" ".join))
def test_any_text(text: str) -> None:
    translator = CopyNetTranslator.load()
    assert translator.translate(text, candidates=2) == translator.translate(text, candidates=2)


def test_loaded_again_it_says_the_same(translator: CopyNetTranslator) -> None:
    again = CopyNetTranslator.load()
    for text in (*COMMANDS, *NO_TASK):
        assert again.translate(text, candidates=3) == translator.translate(text, candidates=3)


def test_contract(translator: CopyNetTranslator) -> None:
    held: Translator = translator
    (reading,) = held.translate("Pickup the sphere")
    assert reading == Translation(ContextualQuery("pickup", ("sphere",)), reading.confidence)


def test_fast_enough(translator: CopyNetTranslator) -> None:
    """About 6 ms on one thread; the bound leaves room for a busy machine."""
    times = []
    for _ in range(15):
        started = time.perf_counter()
        translator.translate(PAPER)
        times.append(time.perf_counter() - started)
    assert statistics.median(times) < 0.1
