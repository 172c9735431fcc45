"""Tables, numbers and places of a page."""

from __future__ import annotations

import pytest

from models.language.experiments.markdown import count, filled, number, percent, spread, table


def test_table() -> None:
    assert table(["", "said ", "right, %"], [["a", "x | y", "1"]]).splitlines() == [
        "|  | said | right, % |",
        "| --- | --- | ---: |",
        "| a | x \\| y | 1 |",
    ]


@pytest.mark.parametrize(
    ("rate", "text"),
    [(1.0, "100"), (0.0, "0"), (0.9999, "99.99"), (0.5, "50"), (0.105, "10.5"), (0.3333, "33.33"), (0.1, "10")],
)
def test_percent_is_never_rounded_up_to_all(rate: float, text: str) -> None:
    assert percent(rate) == text


def test_spread() -> None:
    same = {"mean": 0.25, "deviation": 0.0, "low": 0.25, "high": 0.25}
    assert spread(same) == "25"
    assert spread({"mean": 0.7, "deviation": 0.2, "low": 0.5, "high": 0.9}) == "70 ± 20 (50 to 90)"


def test_counts() -> None:
    assert (count([3, 3]), count([3, 4])) == ("3", "3, 4")
    assert (number(3.0), number(10 / 3), number(0)) == ("3", "3.3", "0")


PAGE = "Before\n<!-- table one -->\nold\n<!-- end -->\nbetween\n<!-- table two --><!-- end -->\nafter\n"


def test_places_are_filled_again_and_again() -> None:
    page = filled(PAGE, {"one": "| 1 |", "two": "| 2 |"})
    assert page == (
        "Before\n<!-- table one -->\n\n| 1 |\n\n<!-- end -->\nbetween\n"
        "<!-- table two -->\n\n| 2 |\n\n<!-- end -->\nafter\n"
    )
    assert filled(page, {"one": "| 1 |", "two": "| 2 |"}) == page


def test_every_place_has_a_table_and_every_table_a_place() -> None:
    with pytest.raises(ValueError, match="no table two"):
        filled(PAGE, {"one": ""})
    with pytest.raises(ValueError, match="no place for the table three"):
        filled(PAGE, {"one": "", "two": "", "three": ""})
