"""The arguments of CQ-CopyNet+POS."""

from __future__ import annotations

import pytest

from models.language.copynet.tagged import arguments
from models.language.tagging import TaggedWord, tagged
from models.world import PartOfSpeech

PARTS: dict[str, PartOfSpeech | None] = {"n": "noun", "a": "adjective", "-": None}


@pytest.mark.parametrize(
    ("words", "parts", "expected"),
    [
        ("put the ball in the box", "--n--n", ("ball", "box")),
        ("pick up the red ball", "---an", ("ball", "red")),  # attributes last
        ("pick up the red teddy bear", "---ann", ("teddy bear", "red")),  # nouns together are one phrase
        ("take the big red ball", "--aan", ("ball", "big", "red")),  # adjectives together are not
        ("put ball in box then put box in hall", "-n-n--n-n", ("ball", "box", "hall")),  # each once
        ("the orange orange", "-an", ("orange",)),
        ("go there", "--", ()),
        ("", "", ()),
    ],
)
def test_arguments(words: str, parts: str, expected: tuple[str, ...]) -> None:
    tokens = [TaggedWord(word, PARTS[part]) for word, part in zip(words.split(), parts, strict=True)]
    assert arguments(tokens) == expected


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("Put the cylinder in the box, then put the box in the bedroom", ("cylinder", "box", "bedroom")),
        ("Pick up the black candle", ("candle", "black")),
        ("Go to the coffee shop, then the town hall", ("coffee shop", "town hall")),
        ("Grasp the ball with your gripper", ("ball", "gripper")),  # one too many
        ("Ship the ball to the kitchen in the box", ("ball", "kitchen", "box")),  # not in the order of the task
    ],
)
def test_of_tagged_text(text: str, expected: tuple[str, ...]) -> None:
    (tokens,) = tagged([text])
    assert arguments(tokens) == expected
