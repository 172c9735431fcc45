"""The shipped translator: the paper's sentences, accuracy, refusals, nasty text, determinism, speed."""

from __future__ import annotations

import random
import statistics
import time

import pytest
import torch
from hypothesis import given, settings
from hypothesis import strategies as st

from models.language import BEAM_WIDTH, MAX_WORDS, SpanTranslator, TextTooLongError, Translation, Translator
from models.language.dataset import Domain, Example, Part, by_task, generate, no_task, open_world
from models.language.encoder import encoder
from models.language.experiments import DefaultSystem
from models.language.spans.items import Item, likelihood
from models.language.spans.network import SpanNet
from models.language.tokens import words
from models.logic import parse
from models.queries import ContextualQuery, parse_query, resolve_grounded
from models.world import load_environment

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
    "Move close to any toy": "move_to(any toy)",  # a quantifier is a part of what it is said of
    "Go to one of the rooms": "navigate_one(one of the rooms)",
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
    "Sing me a song about robots",
    "don't pick up the ball",
    "never go to the bakery",
    "throw the sphere",
    "SELECT * FROM users; --",
    "привет, как дела?",
    "你好",
]


@pytest.fixture(scope="module")
def translator() -> SpanTranslator:
    return SpanTranslator.load()


def _sample(part: Part, domain: Domain, per_task: int) -> list[Example]:
    """The same examples every time, `per_task` of each task class (all of a smaller one)."""
    dataset = generate(domain)
    groups = by_task(dataset.seen if part is Part.SEEN else dataset.unseen)
    generator = random.Random(0)
    return [e for group in groups.values() for e in generator.sample(group, min(per_task, len(group)))]


def _read(translator: SpanTranslator, text: str) -> ContextualQuery | None:
    readings = translator.translate(text)
    return readings[0].query if readings else None


@pytest.mark.parametrize(("text", "query"), COMMANDS.items())
def test_commands(translator: SpanTranslator, text: str, query: str) -> None:
    (reading,) = translator.translate(text)
    assert reading.query == parse_query(query)
    assert 0.5 <= reading.confidence <= 1.0


@pytest.mark.parametrize("text", NO_TASK)
def test_no_task_fits(translator: SpanTranslator, text: str) -> None:
    assert translator.translate(text, candidates=3) == ()


@pytest.mark.parametrize("domain", list(Domain))
@pytest.mark.parametrize("part", list(Part))
def test_accuracy(translator: SpanTranslator, part: Part, domain: Domain) -> None:
    """The evaluation command measures the whole of S and U; here a sample, without help from an environment."""
    for task, group in by_task(_sample(part, domain, 60)).items():
        wrong = [example.text for example in group if _read(translator, example.text) != example.query]
        assert len(wrong) <= 0.02 * len(group), (task, wrong)


@pytest.mark.parametrize("domain", list(Domain))
def test_words_never_seen(translator: SpanTranslator, domain: Domain) -> None:
    """Set W with a vocabulary of its own. Without an environment nothing tells whether "the coffee mug" is a mug of a
    colour; where its names are known, hardly anything is wrong.
    """
    world = open_world(domain, seed=12_345, size=200)
    alone = [(e.text, str(_read(translator, e.text))) for e in world.examples if _read(translator, e.text) != e.query]
    assert len(alone) <= 0.1 * len(world.examples), alone
    environment = load_environment(world.environment)
    answers = DefaultSystem.of(translator).answer([e.text for e in world.examples], environment)
    wrong = [
        (example.text, str(answer.query))
        for example, answer in zip(world.examples, answers, strict=True)
        if answer.formula != resolve_grounded(parse(example.ltl), environment)
    ]
    assert len(wrong) <= 0.01 * len(world.examples), wrong


def test_refusals(translator: SpanTranslator) -> None:
    """Texts whose sentences, verbs and frames training never read: here a sample, as above."""
    texts = random.Random(0).sample(no_task().held_out, 400)
    read = [text for text in texts if translator.translate(text)]
    assert len(read) <= 0.1 * len(texts), read


@pytest.mark.parametrize("text", [PAPER, "Pick up the orange orange", "Go to the o'hare, then go to the town hall"])
def test_case_and_punctuation_change_nothing(translator: SpanTranslator, text: str) -> None:
    plain = text.replace(",", "").lower()
    for other in (text.upper(), text.title(), plain, f"  {plain}!!", f"{text} ...", f"“{text}.”"):
        assert translator.translate(other, candidates=3) == translator.translate(text, candidates=3)


def test_candidates(translator: SpanTranslator) -> None:
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


def test_every_argument_is_a_phrase_of_the_text(translator: SpanTranslator) -> None:
    for example in _sample(Part.UNSEEN, Domain.MANIPULATION, 10):
        for reading in translator.translate(example.text, candidates=BEAM_WIDTH):
            for phrase in reading.query.arguments:
                assert f" {phrase} " in f" {' '.join(words(example.text))} "


def test_the_confidence_is_the_sum_over_the_taggings_that_say_the_query(translator: SpanTranslator) -> None:
    """The same number from the likelihood that training uses, over every way to tag the container."""
    text = words("put the mug in the crate then put the crate in the attic")
    (reading, *_), _ = translator.read(text)
    assert reading.query == parse_query("ship(mug, crate, attic)")
    both, first, second = (((5, 6), (9, 10)), ((5, 6),), ((9, 10),))
    items = [Item(text, "ship", (((2, 3),), crates, ((12, 13),))) for crates in (both, first, second)]
    model = translator.reader.model
    with torch.inference_mode():
        likelihoods = likelihood(SpanNet.of(model), items, encoder(), temperature=model.temperature)
    assert reading.confidence == pytest.approx(float(likelihoods.exp().sum()), abs=1e-3)


@pytest.mark.parametrize("text", ["word " * 10_000, "a" * 100_000, "🏀" * 5_000, "go " * (MAX_WORDS + 1)])
def test_too_long(translator: SpanTranslator, text: str) -> None:
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
def test_odd_texts_are_answered(translator: SpanTranslator, text: str) -> None:
    for reading in translator.translate(text, candidates=3):
        assert parse_query(str(reading.query)) == reading.query


@settings(max_examples=40, deadline=None)
@given(st.text(max_size=80) | st.lists(st.sampled_from([*words(PAPER), "pickup", "zorb", "red", ","])).map(" ".join))
def test_any_text(text: str) -> None:
    translator = SpanTranslator.load()
    assert translator.translate(text, candidates=2) == translator.translate(text, candidates=2)


def test_loaded_again_it_says_the_same(translator: SpanTranslator) -> None:
    again = SpanTranslator.load()
    for text in (*COMMANDS, *NO_TASK):
        assert again.translate(text, candidates=3) == translator.translate(text, candidates=3)


def test_contract(translator: SpanTranslator) -> None:
    held: Translator = translator
    (reading,) = held.translate("Pickup the sphere")
    assert reading == Translation(ContextualQuery("pickup", ("sphere",)), reading.confidence)


def test_fast_enough(translator: SpanTranslator) -> None:
    """About 6 ms on one thread; the bound leaves room for a busy machine."""
    times = []
    for _ in range(15):
        started = time.perf_counter()
        translator.translate(PAPER)
        times.append(time.perf_counter() - started)
    assert statistics.median(times) < 0.1
