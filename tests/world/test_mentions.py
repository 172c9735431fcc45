"""What a text names in an environment, by hand."""

from __future__ import annotations

import pytest

from models.world import builtin_environments, load_environment, mentions


@pytest.fixture(scope="module")
def worlds():
    return {name: load_environment(data) for name, data in builtin_environments()}


@pytest.mark.parametrize(
    ("world", "text", "expected"),
    [
        ("warehouse", "put the red parcel on shelf a", ["red parcel", "shelf a"]),
        ("warehouse", "go to shelf a and then to a trolley", ["shelf a", "trolley"]),
        ("warehouse", "the small parcel goes there", ["small parcel"]),
        ("toys", "put the ball in the box", ["ball", "box"]),
        ("toys", "put the box in", ["box"]),
        ("toys", "what is red", []),
        ("house", "take a cup to the sitting room", ["cup", "sitting room"]),
    ],
)
def test_names_in_a_text(worlds, world, text, expected) -> None:
    said = tuple(text.split())
    assert [" ".join(said[slice(*span)]) for span in mentions(said, worlds[world])] == expected
