"""Clauses and patterns of composed commands, and the texts that are made of them."""

from __future__ import annotations

import random
import re

from models.language.composition.lessons import SINGLE, CompositionLessons
from models.language.composition.shapes import read_shape
from models.language.dataset.composition import leaves, patterns, slot_elements
from models.language.spans.tags import MAX_ARGUMENTS


def test_every_form_of_a_clause_has_the_same_slots() -> None:
    for leaf in leaves():
        for text in leaf.forms.values():
            assert sorted(re.findall(r"\{(\w+)\}", text)) == sorted(leaf.slots), leaf.do
        assert leaf.target is None or leaf.slots == (leaf.target,)
    assert slot_elements("go to {place}, now") == ("go", "to", ("place",), ",", "now")


def test_patterns_have_every_clause_of_their_shape_once() -> None:
    for shape, group in patterns().items():
        numbers = {int(task.arguments[0]) for _, task in read_shape(shape).tasks}
        assert len(numbers) <= MAX_ARGUMENTS
        assert len({pattern.elements for pattern in group}) == len(group)
        for pattern in group:
            assert sorted(hole.leaf for hole in pattern.holes) == sorted(numbers)


def test_texts_have_their_clauses_where_the_mentions_say() -> None:
    course = CompositionLessons.load(seed=0)
    generator = random.Random(5)
    for shape, arity in course.tasks:
        for _ in range(10):
            item = course.alone(generator) if shape == SINGLE else course.composed(shape, generator)
            assert item.task == shape
            assert len(item.mentions) == arity
            taken: set[int] = set()
            for ((begin, end),) in item.mentions:
                assert 0 <= begin < end <= len(item.text)
                assert taken.isdisjoint(range(begin, end))
                taken.update(range(begin, end))


def test_nothing_held_out_is_taught() -> None:
    course = CompositionLessons.load(seed=0)
    refused = {item.text for item in course.refused}
    assert not refused & {item.text for item in course.held_out}
    assert len(refused) > 500
