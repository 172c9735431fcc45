"""Long words for short ones."""

from __future__ import annotations

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
    assert found.texts == (short,)
    assert found.put_together([parse_query("avoid(go(hall))")]) == parse_query("avoid(go(hall))")


@pytest.mark.parametrize("text", ["never go there", "don't go there", "under these circumstances go there", ""])
def test_short_words_stay(text: str) -> None:
    assert list(restated(text)) == []
