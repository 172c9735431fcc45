"""What a thing is in is told from where it shall go."""

from __future__ import annotations

import pytest

from models.language.teaching import TaughtTranslator, Utterance
from models.language.teaching.sources import mistakes_source, moves_back
from models.language.tokens import words
from models.queries import ContextualQuery

STORE = ContextualQuery("store", ("ball", "box"))


@pytest.mark.parametrize(
    ("text", "mistaken"),
    [
        ("take the ball out of the box", True),
        ("get the ball off my box", True),
        ("fetch the ball from box", True),
        ("put the ball in the box", False),
        ("switch off the box with the ball", False),  # nothing is said to be anywhere
        ("out of the box", False),
    ],
)
def test_a_source_is_no_destination(text: str, mistaken: bool) -> None:
    assert mistakes_source(words(text), STORE, frozenset()) is mistaken


def test_unless_it_was_taught_so() -> None:
    taught = TaughtTranslator.of(
        [Utterance.of("unpack the ball from the box", ContextualQuery("unpack", STORE.arguments))]
    )
    assert taught.sources == {("unpack", 1)}
    said = words("take the cup out of the crate")
    assert not mistakes_source(said, ContextualQuery("unpack", ("cup", "crate")), taught.sources)
    assert mistakes_source(said, ContextualQuery("store", ("cup", "crate")), taught.sources)


@pytest.mark.parametrize(
    ("text", "back"),
    [
        ("put the box in the ball", True),
        ("shove the box onto my ball", True),
        ("put the ball in the box", False),
        ("bring the box, the ball goes in there", False),
    ],
)
def test_what_goes_where_is_as_it_is_said(text: str, back: bool) -> None:
    taught = TaughtTranslator.of([Utterance.of("put the ball in the box", STORE)])
    assert taught.moves == {("store", 0, 1)}
    assert moves_back(words(text), STORE, taught.moves) is back


def test_unless_it_was_taught_both_ways() -> None:
    ways = [Utterance.of(text, STORE) for text in ("put the ball in the box", "set the box on the ball")]
    assert not moves_back(words("put the box in the ball"), STORE, TaughtTranslator.of(ways).moves)
