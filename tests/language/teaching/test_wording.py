"""Taught wordings on cases worked out by hand."""

from __future__ import annotations

import time

import pytest
from hypothesis import given
from hypothesis import strategies as st

from models.language import (
    ExampleArgumentNotFoundError,
    ExampleTooGeneralError,
    TaughtTranslator,
    TextTooLongError,
    Utterance,
    Wording,
)
from models.queries import ContextualQuery, parse_task


def said(utterance: str, query: str) -> Utterance:
    return Utterance.of(utterance, parse_task(query))


def reads(utterance: str, query: str, command: str) -> str | None:
    found = TaughtTranslator.of([Utterance.of(utterance, parse_task(query))]).translate(command)
    return str(found[0].query) if found else None


@pytest.mark.parametrize(
    ("utterance", "query", "command", "expected"),
    [
        ("stow the ball in the box", "stow(ball, box)", "stow the cube in the crate", "stow(cube, crate)"),
        ("stow the ball in the box", "stow(ball, box)", "Stow a cube in my crate!", "stow(cube, crate)"),
        ("stow the ball in the box", "stow(ball, box)", "stow cube in crate", "stow(cube, crate)"),
        (
            "stow the ball in the box",
            "stow(ball, box)",
            "stow the small red cube in the crate",
            "stow(small red cube, crate)",
        ),
        ("stow the ball in the box", "stow(ball, box)", "stow the cube on the crate", None),
        ("stow the ball in the box", "stow(ball, box)", "stow the cube in", None),
        ("stow the ball in the box", "stow(ball, box)", "now stow the cube in the crate", None),
        # mention order is not argument order
        ("in the box stow the ball", "stow(ball, box)", "in the crate stow the cube", "stow(cube, crate)"),
        # an argument that is said twice is said twice
        ("put x in y then take y away", "haul(x, y)", "put a in b then take b away", "haul(a, b)"),
        ("put x in y then take y away", "haul(x, y)", "put a in b then take c away", None),
        # the longer argument is found first
        ("bring the box to the box office", "bring(box, box office)", "bring the cup to the desk", "bring(cup, desk)"),
        # nothing to fill
        ("go home", "home()", "Go home.", "home()"),
        ("go home", "home()", "go home now", None),
        # a question names nothing
        ("the ball is in the box", "stow(ball, box)", "what is in the crate", None),
        (
            "the ball is in the box",
            "stow(ball, box)",
            "the red one which i like is in the crate",
            "stow(red one which i like, crate)",
        ),
        # another clause is not part of a phrase
        ("get the ball", "get(ball)", "get the ball and put it in the box", None),
    ],
)
def test_reads_what_was_taught(utterance: str, query: str, command: str, expected: str | None) -> None:
    assert reads(utterance, query, command) == expected


@pytest.mark.parametrize(
    ("utterance", "query"),
    [("stow it", "stow(ball)"), ("stow the balls", "stow(ball)"), ("", "stow(ball)"), ("ball", "stow(ball, ball)")],
)
def test_an_argument_that_is_not_said_is_refused(utterance: str, query: str) -> None:
    with pytest.raises(ExampleArgumentNotFoundError):
        Wording.of(Utterance.of(utterance, parse_task(query)))


def test_an_utterance_that_is_too_long_is_refused() -> None:
    with pytest.raises(TextTooLongError):
        Utterance.of("go " * 1000, parse_task("home()"))


def test_the_most_literal_wording_is_read_first() -> None:
    translator = TaughtTranslator.of(
        [said("bring the ball", "bring(ball)"), said("bring the ball here", "bring_here(ball)")]
    )
    found = translator.translate("bring the cup here", candidates=5)
    assert [(str(t.query), t.confidence) for t in found] == [("bring_here(cup)", 1.0), ("bring(cup here)", 0.0)]
    assert translator.translate("bring the cup here") == found[:1]


@pytest.mark.parametrize(("utterance", "query"), [("kitchen", "go(kitchen)"), ("the ball, a box", "put(ball, box)")])
def test_an_utterance_of_nothing_but_arguments_is_refused(utterance: str, query: str) -> None:
    with pytest.raises(ExampleTooGeneralError):
        Wording.of(Utterance.of(utterance, parse_task(query)))


def test_readings_of_equally_literal_wordings_share_the_confidence() -> None:
    translator = TaughtTranslator.of([said("tidy the kitchen", "clean(kitchen)"), said("tidy the ball", "stow(ball)")])
    found = translator.translate("tidy the cup", candidates=3)
    assert [(str(t.query), t.confidence) for t in found] == [("clean(cup)", 0.5), ("stow(cup)", 0.5)]


def test_a_wording_of_many_slots_gives_up_in_time() -> None:
    slots = [f"w{number}" for number in range(16)]
    wording = Wording.of(Utterance.of(" ".join(slots) + " end", ContextualQuery("many", tuple(slots))))
    started = time.monotonic()
    wording.match(["word"] * 200)
    assert time.monotonic() - started < 2


WORDS = st.lists(st.sampled_from(["red", "cup", "mug", "saucer"]), min_size=1, max_size=4).map(" ".join)


@given(WORDS, WORDS)
def test_any_phrases_fill_the_slots(first: str, second: str) -> None:
    assert reads("move x beside y", "move(x, y)", f"move the {first} beside the {second}") == str(
        ContextualQuery("move", (first, second))
    )


@given(st.text(max_size=60))
def test_any_command_is_read_or_not(text: str) -> None:
    translator = TaughtTranslator.of([said("put x in y", "put(x, y)")])
    assert len(translator.translate(text)) <= 1


def test_many_wordings_do_not_slow_a_command() -> None:
    slots = [f"t{number}" for number in range(12)]
    query = ContextualQuery("evil", tuple(slots))
    hard = [Utterance.of(" ".join([*slots, "end", f"x{number}"]), query) for number in range(500)]
    translator = TaughtTranslator.of([*hard, said("put x in y", "put(x, y)")])
    started = time.monotonic()
    assert translator.translate(" ".join(["word"] * 50)) == ()
    assert str(translator.translate("put the cup in the sink")[0].query) == "put(cup, sink)"
    translator.translate(" ".join(["word"] * 150 + ["end", *(f"x{number}" for number in range(40))]))
    assert time.monotonic() - started < 5
