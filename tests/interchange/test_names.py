"""Identifiers and labels."""

from __future__ import annotations

from hypothesis import given
from hypothesis import strategies as st

from models.interchange.names import Identifiers, action_names, label_names, mangled, number_text
from models.logic import Atom, Name
from models.world.names import IDENTIFIER


def test_mangling() -> None:
    wanted = {
        "north": "north",
        "take(red cube, box)": "take_red_cube_box",
        'pick("\u00e9tag\u00e8re")': "pick_etagere",
        "7up": "_7up",
        "H&M (2nd floor)": "H_M_2nd_floor",
        "\u53a8\u623f": "_",
        "": "_",
    }
    assert {name: mangled(name) for name in wanted} == wanted


def test_reserved_and_repeated_names_get_numbers() -> None:
    names = Identifiers()
    assert [names.new(name) for name in ("module", "a b", "a_b", "a_b_2", "F")] == [
        "module_2", "a_b", "a_b_2", "a_b_2_2", "F_2",
    ]  # fmt: skip


def test_standing_still_has_a_name_of_its_own() -> None:
    assert action_names(["go", "stay"]) == ["go", "stay", "stay_2"]


def test_labels() -> None:
    found = label_names(
        [Atom("in", (Name("red cube"), Name("box"))), Atom("init"), Atom("in_red_cube", (Name("box"),))]
    )
    assert list(found.values()) == ["in_red_cube_box", "init_2", "in_red_cube_box_2"]
    assert list(label_names([Atom("mark_0")], reserved=["mark_0"]).values()) == ["mark_0_2"]


@given(st.lists(st.text(max_size=200), max_size=20))
def test_identifiers_are_identifiers_and_all_different(texts: list[str]) -> None:
    names = Identifiers()
    found = [names.new(text) for text in texts]
    assert len(set(found)) == len(found)
    assert all(IDENTIFIER.match(name) for name in found)


@given(st.floats(allow_nan=False, allow_infinity=False))
def test_numbers_are_read_back_exactly(value: float) -> None:
    assert float(number_text(value)) == value
