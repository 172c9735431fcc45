"""Singulars of the things that worlds have."""

from __future__ import annotations

import pytest

from models.world.names import singular

PLURALS = """
shelves shelf, knives knife, loaves loaf, leaves leaf, gloves glove, stoves stove, olives olive, tomatoes tomato,
potatoes potato, shoes shoe, buses bus, lenses lens, vases vase, houses house, cases case, glasses glass, boxes box,
batteries battery, cookies cookie, pies pie, trolleys trolley, dishes dish, benches bench, people person, women woman,
children child, mice mouse, feet foot, teeth tooth, cubes cube, keys key, pizzas pizza, puzzles puzzle, axes axe
"""
SINGULARS = "glass bus gas lens dress chess scissors series grass cactus this box shelf kiosk oasis octopus"


@pytest.mark.parametrize("pair", [pair.strip() for pair in PLURALS.split(",")])
def test_plurals(pair: str) -> None:
    plural, expected = pair.split()
    assert singular(plural) == expected
    assert singular(expected) == expected


@pytest.mark.parametrize("word", SINGULARS.split())
def test_what_is_singular_stays(word: str) -> None:
    assert singular(word) == word
