"""Where utterances mention their arguments, with marks and without."""

from __future__ import annotations

import pytest
from hypothesis import given
from hypothesis import strategies as st

from models.language import ExampleArgumentNotFoundError, ExampleMarkError, Utterance
from models.queries import ContextualQuery, parse_task


@pytest.mark.parametrize(
    ("text", "query", "said", "mentions"),
    [
        ("Stow the ball in the box!", "stow(ball, box)", "stow(ball, box)", (((2, 3),), ((5, 6),))),
        ("stow the {1} in the {2}", "stow(ball, box)", "stow(ball, box)", (((2, 3),), ((5, 6),))),
        ("in the {2}, stow {1}", "stow(ball, box)", "stow(ball, box)", (((4, 5),), ((2, 3),))),
        # a mark may name another thing; its determiner is not part of the phrase
        ("stow {1: the small cube} in {2}", "stow(ball, box)", "stow(small cube, box)", (((1, 3),), ((4, 5),))),
        ("{1} here, {1} there", "go(lab)", "go(lab)", (((0, 1), (2, 3)),)),
        ("{1:lab} here, {1:lab} there", "go(x)", "go(lab)", (((0, 1), (2, 3)),)),
        # what is the same word without marks
        ("box the {1: box}", "pack(box)", "pack(box)", (((2, 3),),)),
        ("box the box", "pack(box)", "pack(box)", (((0, 1), (2, 3)),)),
        ("to the box office with the box", "bring(box, box office)", "bring(box, box office)", (((6, 7),), ((2, 4),))),
        ("go home", "home()", "home()", ()),
    ],
)
def test_finds_the_mentions(text: str, query: str, said: str, mentions: object) -> None:
    utterance = Utterance.of(text, parse_task(query))
    assert (str(utterance.query), utterance.mentions) == (said, mentions)


@pytest.mark.parametrize(
    ("text", "detail"),
    [
        ("stow {1} in {3}", "names no argument: stow has 2"),
        ("stow {0} in {2}", "names no argument"),
        ("stow {1: } in {2}", "holds no word"),
        ("stow {1: cup} in {2}, the {1: mug}", "in other words than an earlier one"),
        ("stow {1} in {2", "marks are written"),
        ("stow {1} in {two}", "marks are written"),
        ("stow {1} in {2}}", "marks are written"),
    ],
)
def test_a_wrong_mark_is_refused(text: str, detail: str) -> None:
    with pytest.raises(ExampleMarkError, match=detail):
        Utterance.of(text, parse_task("stow(ball, box)"))


def test_every_argument_is_marked_or_none() -> None:
    with pytest.raises(ExampleArgumentNotFoundError, match=r"no mark \{2\}"):
        Utterance.of("stow {1} in the box", parse_task("stow(ball, box)"))


NAMES = st.lists(st.sampled_from(["red", "cup", "mug", "saucer"]), min_size=1, max_size=3).map(" ".join)


@given(NAMES, NAMES)
def test_a_mark_and_the_words_in_its_place_say_the_same(first: str, second: str) -> None:
    query = ContextualQuery("put", ("x", "y"))
    marked = Utterance.of(f"next to the {{2: {second}}} put the {{1: {first}}}", query)
    assert marked.words == tuple(f"next to the {second} put the {first}".split())
    assert marked.query.arguments == (first, second)
    for phrase, ((begin, end),) in zip(marked.query.arguments, marked.mentions, strict=True):
        assert marked.words[begin:end] == tuple(phrase.split())
