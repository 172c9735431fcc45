"""What a thing is in is told from where it shall go."""

from __future__ import annotations

import pytest

from models.language.teaching import TaughtTranslator, Utterance
from models.language.teaching.sources import mistakes_source
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
