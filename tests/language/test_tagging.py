"""Part-of-speech tags of phrases at their place in a text."""

from __future__ import annotations

import pytest

from models.language import TextTooLongError, part_of_speech
from models.language.tagging import TaggedWord, tagged


@pytest.mark.parametrize(
    ("text", "phrase", "expected"),
    [
        ("Pick up the ball that is orange", "orange", "adjective"),
        ("Pick up the orange", "orange", "noun"),
        ("pick up the large red ball", "red", "adjective"),
        ("pick up the large red ball", "large red ball", "noun"),  # the head decides
        ("pick up the red ball", "ball", "noun"),
        ("Go to Paris!", "paris", "noun"),  # a proper noun
        ("They quickly left", "quickly", None),
        ("pick up the red ball", "the ball", None),  # does not stand there
        ("pick up the red ball", "", None),
        ("", "ball", None),
        ("\ud800 pick up the\x00 ball 🏀", "ball", "noun"),
    ],
)
def test_part_of_speech(text: str, phrase: str, expected: str | None) -> None:
    assert part_of_speech(text, phrase) == expected


def test_too_long() -> None:
    with pytest.raises(TextTooLongError):
        part_of_speech("ball " * 1_000, "ball")


def test_tagged_words() -> None:
    """The words are those of the tokeniser, also where spaCy splits them in two; texts keep their order."""
    first, empty, second = tagged(["Fetch the green cube!", "", "I can't go to Paris"])
    assert first == (
        TaggedWord("fetch", None),
        TaggedWord("the", None),
        TaggedWord("green", "adjective"),
        TaggedWord("cube", "noun"),
    )
    assert empty == ()
    assert [word.text for word in second] == ["i", "can't", "go", "to", "paris"]
    assert [word.part for word in second] == [None, None, None, None, "noun"]


def test_too_long_among_others() -> None:
    with pytest.raises(TextTooLongError):
        list(tagged(["go", "ball " * 1_000]))
