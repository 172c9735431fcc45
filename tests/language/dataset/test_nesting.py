"""Patterns within patterns have the shape that they say."""

from __future__ import annotations

import random
import re

import pytest

from models.language.composition.shapes import filled, read_shape
from models.language.dataset.composition import FURTHER, patterns
from models.language.dataset.nesting import NESTINGS, Nesting, nested, nestings
from models.language.spans.tags import MAX_ARGUMENTS
from models.queries import Query


def put_together(nesting: Nesting) -> str:
    """The shape, by filling the outer one, with its clauses numbered anew."""
    more = len(set(re.findall(r"\d", nesting.inner))) - 1
    clauses: dict[int, Query] = {}
    for number in {int(found) for found in re.findall(r"\d", nesting.outer)}:
        moved = str(number if number < nesting.clause else number + more)
        inner = re.sub(r"\d", lambda found: str(int(found[0]) + nesting.clause - 1), nesting.inner)
        clauses[number] = read_shape(inner if number == nesting.clause else moved)
    return re.sub(r"clause\((\d)\)", r"\1", str(filled(read_shape(nesting.outer), clauses)))


@pytest.mark.parametrize("nesting", nestings().values(), ids=str)
def test_a_nesting_is_what_its_parts_make(nesting: Nesting) -> None:
    assert put_together(nesting) == nesting.shape
    assert nesting.outer in patterns()
    assert nesting.inner in patterns()


def test_every_shape_is_one_nesting_and_most_have_no_patterns_of_their_own() -> None:
    assert len(nestings()) == len(NESTINGS)
    assert len(set(nestings()) - set(patterns())) == 27


@pytest.mark.parametrize("shape", nestings())
def test_texts_have_every_clause_once(shape: str) -> None:
    generator = random.Random(shape)
    numbers = {int(found) for found in re.findall(r"\d", shape)}
    assert len(numbers) <= MAX_ARGUMENTS
    for _ in range(30):
        pattern = nested(shape, generator)
        assert pattern.shape == shape
        assert sorted(hole.leaf for hole in pattern.holes if hole.form not in FURTHER) == sorted(numbers)


def test_an_inner_text_has_the_form_of_the_clause_that_it_replaces() -> None:
    """ "Until you have been to A and been to B", not "until you have go to A and go to B"."""
    generator = random.Random(1)
    for _ in range(200):
        pattern = nested("until(avoid(1), and(2, 3))", generator)
        forms = {hole.form for hole in pattern.holes if hole.leaf > 1}
        assert len(forms) == 1 or forms == {"do", "it"}
