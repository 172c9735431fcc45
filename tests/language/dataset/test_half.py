"""Lists in two parts."""

from __future__ import annotations

import pytest
from hypothesis import given
from hypothesis import strategies as st

from models.language.dataset import Half
from models.language.dataset.half import half


def test_every_fifth() -> None:
    assert half("abcdefghijkl", Half.HELD_OUT) == ("e", "j")
    assert half("abcdefghijkl", Half.TRAINING) == tuple("abcdfghikl")


@given(st.lists(st.integers()))
def test_every_entry_is_in_one_part(entries: list[int]) -> None:
    indices = list(enumerate(entries))
    parts = [half(indices, part) for part in Half]
    assert sorted((*parts[0], *parts[1])) == indices
    assert len(parts[1]) == len(entries) // 5


def test_names() -> None:
    assert [Half("training"), Half("held_out")] == list(Half)
    with pytest.raises(ValueError, match="other"):
        Half("other")
