"""Part-of-speech tags of phrases at their place in a text."""

from __future__ import annotations

import pytest

from models.language import TextTooLongError, part_of_speech


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
