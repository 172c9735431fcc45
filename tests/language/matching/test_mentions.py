"""The ways to see what a text mentions: probabilities, and what is expected of what it names."""

from __future__ import annotations

import numpy as np
import pytest

from models.language.matching import Matcher
from models.language.matching.mentions import NAMED, Seen, ways_to_see
from models.language.spans.tags import Span


@pytest.fixture(scope="module")
def matcher() -> Matcher:
    return Matcher.load()


def seen(matcher: Matcher, text: str, *named: Span) -> dict[tuple[Span, ...], Seen]:
    said = tuple(text.split())
    vectors = matcher.reader.read([said])[0]
    ways = ways_to_see(matcher.model.heads, said, vectors, named)
    assert len({way.spans for way in ways}) == len(ways)
    assert sum(way.probability for way in ways) <= 1 + 1e-6
    for way in ways:
        assert np.linalg.norm(way.asked) == pytest.approx(1, abs=1e-4)
        assert len(way.roles) == len(way.spans)
    return {way.spans: way for way in ways}


def test_what_is_named_is_what_a_text_is_about_rather_than_anything_else(matcher: Matcher) -> None:
    ways = seen(matcher, "turn off the floor lamp", (3, 5))
    assert ways[((3, 5),)].probability >= NAMED
    assert [spans for spans, way in ways.items() if way.named] == [((3, 5),)]


def test_all_of_a_kind_may_be_nothing_in_particular(matcher: Matcher) -> None:
    for text in ("turn off all the lamps", "turn off every single lamp"):
        ways = seen(matcher, text, (4, 5))
        assert {spans for spans, way in ways.items() if way.named} == {((4, 5),), ()}
    ways = seen(matcher, "put every cup on the shelf", (2, 3), (5, 6))
    assert [spans for spans, way in ways.items() if way.named] == [((2, 3), (5, 6))], "the shelf is one"


def test_what_is_mentioned_twice_counts_once(matcher: Matcher) -> None:
    assert ((2, 3),) in seen(matcher, "the first cup and then the cup", (2, 3), (6, 7))


def test_where_nothing_is_named_nothing_is_expected(matcher: Matcher) -> None:
    assert not any(way.named for way in seen(matcher, "turn off the lamp").values())
