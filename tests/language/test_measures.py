"""How often and how long, on cases worked out by hand."""

from __future__ import annotations

import pytest

from models.language.measures import measure
from models.queries import parse_query


@pytest.mark.parametrize(
    ("text", "found"),
    [
        ("Visit the museum twice!", "twice"),
        ("go to the zoo three times", "three times"),
        ("go to the zoo 2 more times", "2 more times"),
        ("stay at the zoo for ten minutes", "for ten minutes"),
        ("be at the zoo in 5 minutes", "in 5 minutes"),
        ("be at the zoo within an hour", "within an hour"),
        ("keep away from the zoo at all times", None),
        ("sometimes go to the zoo", None),
        ("if you have a minute, go to the zoo", None),
        ("go to the zoo", None),
    ],
)
def test_measures(text: str, found: str | None) -> None:
    assert measure(text, parse_query("navigate_one(zoo)")) == found


def test_a_name_is_no_measure() -> None:
    query = parse_query("then(navigate_one(zoo), navigate_one(cafe in two minutes))")
    assert measure("go to the zoo, then the cafe in two minutes", query) is None
    assert measure("go to the zoo twice, then the cafe in two minutes", query) == "twice"
