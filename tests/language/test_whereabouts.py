"""A command is said without where a thing is, and the place is put back into the thing's name."""

from __future__ import annotations

import pytest

from models.language.whereabouts import located
from models.queries import parse_query
from models.world import Environment, builtin_environments, load_environment


@pytest.fixture(scope="module")
def toys() -> Environment:
    return load_environment(dict(builtin_environments())["toys"])


@pytest.mark.parametrize(
    ("text", "shorter", "query", "whole"),
    [
        ("Take the ball out of the box", "take the ball", "pickup(ball)", "pickup(ball out of box)"),
        (
            "get the red cylinder off the bag!",
            "get the red cylinder !",
            "get(cylinder, red)",
            "get(cylinder off bag, red)",
        ),
        (
            "grab the bag from my kitchen and leave it in the bedroom",
            "grab the bag and leave it in the bedroom",
            "and(pickup(bag), bring(bag, bedroom))",
            "and(pickup(bag from kitchen), bring(bag from kitchen, bedroom))",
        ),
        ("take the ball that's in the kitchen", "take the ball", "pickup(ball)", "pickup(ball in kitchen)"),
        ("take the ball that is on my bag", "take the ball", "pickup(ball)", "pickup(ball on bag)"),
        ("take the ball from the kitchen", "take the ball", "pickup(cylinder)", None),
    ],
)
def test_the_place_is_put_back(toys: Environment, text: str, shorter: str, query: str, whole: str | None) -> None:
    (found,) = located(text, toys)
    assert found.texts == (shorter,)
    together = found.put_together([parse_query(query)])
    assert (None if together is None else str(together)) == whole


@pytest.mark.parametrize("text", ["put the ball in the box", "go from here to the kitchen", "take the ball out", ""])
def test_nothing_is_said_of_where_things_are(toys: Environment, text: str) -> None:
    assert list(located(text, toys)) == []
