"""Clauses and patterns of composed commands, and the texts that are made of them."""

from __future__ import annotations

import random
import re

import pytest

from models.language.composition import lessons
from models.language.composition.lessons import SINGLE, CompositionLessons
from models.language.composition.shapes import read_shape
from models.language.dataset.composition import FURTHER, PIECES, _pattern, leaves, patterns, slot_elements
from models.language.errors import VocabularyError
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
            whole = [hole.leaf for hole in pattern.holes if hole.form not in FURTHER]
            pieces = [hole.leaf for hole in pattern.holes if hole.form in PIECES]
            assert sorted(whole) == sorted(numbers)
            assert sorted(pieces) == sorted(hole.leaf for hole in pattern.holes if hole.form == "subject")


@pytest.mark.parametrize(
    ("do", "pieces"),
    [
        ("pick up {object}", ("{object}", "picked up", "picking up")),
        ("pick {object} up", ("{object}", "picked up", "picking up")),
        ("put {color} {object} in {container}", ("{color} {object}", "put in {container}", "putting in {container}")),
        ("visit {place}", ("{place}", "visited", "visiting")),
        ("go to {place}", ()),
        ("get {object}", ()),
    ],
)
def test_what_is_done_to_a_thing_is_said_of_it(do: str, pieces: tuple[str, ...]) -> None:
    (leaf,) = (leaf for leaf in leaves() if leaf.do == do)
    assert tuple(leaf.pieces.values()) == pieces


def test_every_way_to_say_it_of_a_thing_has_the_slots_of_the_clause() -> None:
    found = [leaf for leaf in leaves() if leaf.pieces]
    assert len(found) > 150
    for leaf in found:
        for form in PIECES:
            said = leaf.pieces["subject"] + leaf.pieces[form]
            assert sorted(re.findall(r"\{(\w+)\}", said)) == sorted(leaf.slots), leaf.do


@pytest.fixture(scope="module")
def course() -> CompositionLessons:
    return CompositionLessons.load(seed=0)


def test_texts_have_their_clauses_where_the_mentions_say(course: CompositionLessons) -> None:
    generator = random.Random(5)
    for shape, arity in course.tasks:
        for _ in range(10):
            item = course.alone(generator) if shape == SINGLE else course.composed(shape, generator)
            assert item.task == shape
            assert len(item.mentions) == arity
            taken: set[int] = set()
            for spans in item.mentions:
                assert 1 <= len(spans) <= 2
                for begin, end in spans:
                    assert 0 <= begin < end <= len(item.text)
                    assert taken.isdisjoint(range(begin, end))
                    taken.update(range(begin, end))


def test_an_echo_says_again_what_was_said_and_is_no_part_of_the_clause(
    course: CompositionLessons, monkeypatch: pytest.MonkeyPatch
) -> None:
    pattern = _pattern("repeat(and(1, 2))", "{1:it} {2:it} {1:echo} {2:echo}")
    monkeypatch.setattr(lessons, "patterns", lambda: {pattern.shape: (pattern,)})
    monkeypatch.setattr(lessons, "nestings", dict)
    monkeypatch.setattr(CompositionLessons, "_beside", lambda *_: [])
    monkeypatch.setattr(lessons, "FRAMED", 0.0)
    monkeypatch.setattr(lessons, "REASON", 0.0)
    item = course.composed(pattern.shape, random.Random(1))
    half = len(item.text) // 2
    assert item.text[:half] == item.text[half:]
    assert [spans[-1][1] for spans in item.mentions][-1] == half


@pytest.mark.parametrize("text", ["{1:echo}, {1:it}, {2:it}", "{1:it}, {2:echo}"])
def test_an_echo_of_nothing_is_refused(text: str) -> None:
    with pytest.raises(VocabularyError):
        _pattern("and(1, 2)", text)


def test_nothing_held_out_is_taught(course: CompositionLessons) -> None:
    refused = {item.text for item in course.refused}
    assert not refused & {item.text for item in course.held_out}
    assert len(refused) > 500
