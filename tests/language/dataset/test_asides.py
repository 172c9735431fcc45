"""What is said beside a command: parted like all that is written, and without what would change a command."""

from __future__ import annotations

import random

import pytest

from models.language.dataset.asides import asides, drawn, remark
from models.language.tokens import words
from models.language.translation import NEGATIONS

LISTS = ("asides", "reasons_before", "reasons_after", "purposes")


@pytest.mark.parametrize("name", LISTS)
def test_a_fifth_is_held_out(name: str) -> None:
    training, held_out = getattr(asides("training"), name), getattr(asides("held_out"), name)
    assert not set(training) & set(held_out)
    assert len(held_out) == (len(training) + len(held_out)) // 5
    assert len(training) > 180


def test_softeners_change_nothing() -> None:
    for part in ("training", "held_out"):
        for said in asides(part).asides:
            assert not {"then", "or", "until", *NEGATIONS} & set(words(said)), said


def test_slots_are_filled() -> None:
    said = drawn(["i left {object} in {place}, so"], lambda slot: ("the", slot), random.Random(0))
    assert said == ["i", "left", "the", "object", "in", "the", "place", ",", "so"]


def test_a_remark_leads_to_no_command() -> None:
    generator = random.Random(0)
    for _ in range(200):
        said = remark(lambda slot: ("the", slot), generator)
        assert said
        assert said[-1] not in ("so", ",", "please")
