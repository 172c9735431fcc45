"""Arguments that took in words which belong to no name."""

from __future__ import annotations

import pytest

from models.language import Translation
from models.language.trimming import LESS, trimmed
from models.queries import parse_query
from models.world import builtin_environments, load_environment

CITY = load_environment(dict(builtin_environments())["navigation"])
SAYING = frozenset({"sometime", "guard", "go"})


def cut(*queries: tuple[str, float]) -> list[tuple[str, float]]:
    said = [Translation(parse_query(query), confidence) for query, confidence in queries]
    return [(str(found.query), found.confidence) for found in trimmed(said, CITY, SAYING)]


@pytest.mark.parametrize(
    ("phrase", "name"),
    [
        ("guard the zoo", "zoo"),
        ("teh zoo", "zoo"),
        ("the zoo", "zoo"),
        ("zoo sometime", "zoo"),
        ("crossing my zoo", "zoo"),
    ],
)
def test_what_may_go(phrase: str, name: str) -> None:
    assert cut((f"navigate_one({phrase})", 0.8)) == [(f"navigate_one({name})", pytest.approx(0.8 * LESS))]


@pytest.mark.parametrize(
    "phrase", ["zoo", "wooden zoo", "statue in the zoo", "zoo lid", "zoo and the bakery", "unicorn"]
)
def test_what_must_stay(phrase: str) -> None:
    assert cut((f"navigate_one({phrase})", 0.8)) == []


def test_compositions_are_trimmed_part_by_part() -> None:
    said = ("and(navigate_one(guard the zoo), navigate_one(bakery))", 0.4)
    assert cut(said) == [("and(navigate_one(zoo), navigate_one(bakery))", pytest.approx(0.4 * LESS))]


def test_what_becomes_the_same_adds_up() -> None:
    said = cut(("navigate_one(guard the zoo)", 0.4), ("navigate_one(teh zoo)", 0.2), ("navigate_one(zoo lid)", 0.1))
    assert said == [("navigate_one(zoo)", pytest.approx(0.6 * LESS))]
