"""Long words for short ones."""

from __future__ import annotations

import time

import pytest

from models.language.restating import restated
from models.queries import parse_query


@pytest.mark.parametrize(
    ("text", "short"),
    [
        ("Under no circumstances put it there", "never put it there"),
        ("you must on no account go in", "you must never go in"),
        ("go there and don't ever enter the hall", "go there and never enter the hall"),
        ("Do not you ever go", "never go"),
    ],
)
def test_never_has_many_names(text: str, short: str) -> None:
    (found,) = restated(text)
    assert (found.texts, found.mistaken) == ((short,), False)
    assert found.put_together([parse_query("avoid(go(hall))")]) == parse_query("avoid(go(hall))")


@pytest.mark.parametrize("text", ["never go there", "don't go there", "under these circumstances go there", ""])
def test_short_words_stay(text: str) -> None:
    assert list(restated(text)) == []


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("Keep your hands off the cup!", "never pick up the cup!"),
        ("to the zoo, and last but not least to the bank", "to the zoo, and finally to the bank"),
        ("Pass the fountain on your way back from the zoo.", "go to the zoo, then Pass the fountain"),
        ("on the way home from the zoo, stop at the bank", "go to the zoo, then stop at the bank"),
        ("grab the towel on your way to the hall", "grab the towel, then go to the hall"),
        ("On the way to the hall, grab the towel", "grab the towel, then go to the hall"),
        ("last of all go to the hall; before that, grab the towel", "grab the towel, then go to the hall"),
        ("see the zoo. But before you do so, see the bank.", "see the bank, then see the zoo"),
        ("Go to the zoo and the bank, the bank first", "Go to the bank, then Go to the zoo"),
        ("neither the oven nor the lamp should be on", "never switch on the oven and never switch on the lamp"),
        ("the oven must never be running", "never switch on the oven"),
        ("no, not the hall, the lounge please", "not the hall but the lounge"),
        ("1. get the cup 2. go to the hall", "get the cup, then go to the hall"),
    ],
)
def test_what_is_mistaken_is_said_in_other_words(text: str, said: str) -> None:
    (found,) = restated(text)
    assert (found.texts, found.mistaken) == ((said,), True)


@pytest.mark.parametrize(
    "text",
    [
        "on the way to the zoo",
        "take the cup off the shelf",
        "go to the zoo before that bank",
        "go to room 1. Then stop",
        "not the zoo",
        "1. Get it. 2. Go to the hall.",
        "1) get it\n2) go to the hall",
        "go to 1. then 2. please",
        "the oven should be on",
    ],
)
def test_what_is_understood_stays(text: str) -> None:
    assert list(restated(text)) == []


@pytest.mark.parametrize(
    "part",
    ["to and ", "see a and ", "on the way back from ", "a on the way to ", "neither a nor ", "before that; ", "!"],
)
def test_long_texts_are_looked_through_at_once(part: str) -> None:
    """No pattern tries the ways in which parts that repeat may be divided."""
    began = time.perf_counter()
    list(restated((part * 2000)[:2000]))
    assert time.perf_counter() - began < 0.5
