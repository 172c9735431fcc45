"""The tokeniser: what is a word, what is dropped, where words stand, what is too long."""

from __future__ import annotations

import pytest
from hypothesis import given
from hypothesis import strategies as st

from models.language import TextTooLongError
from models.language.tokens import MAX_CHARACTERS, MAX_WORDS, find, is_mark, marked_words, tokenize, words


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("Pickup the sphere", ["pickup", "the", "sphere"]),
        ("  PICK\tup,\nthe “Sphere”!!! ", ["pick", "up", "the", "sphere"]),
        ("box,then (the) bedroom.", ["box", "then", "the", "bedroom"]),
        ("the yo-yo at O'Hare, H&M no. 3.5", ["the", "yo-yo", "at", "o'hare", "h&m", "no", "3.5"]),
        ("dash – and — ellipsis… end", ["dash", "and", "ellipsis", "end"]),
        ("take the 🏀", ["take", "the", "🏀"]),
        (
            "kitchen/hall or the ball|bag. open www.example.com/index",
            ["kitchen", "hall", "or", "the", "ball", "bag", "open", "www.example.com/index"],
        ),
        ("a\x00b\u200bc\ud800d", ["a", "b", "c", "d"]),
        ("Cafe\u0301 CAFÉ", ["café", "café"]),
        ("?!... -- '' \"\"", []),
        ("", []),
    ],
)
def test_words(text: str, expected: list[str]) -> None:
    assert list(words(text)) == expected


@given(st.text(max_size=300))
def test_tokens_stand_where_they_say_and_hold_no_marks(text: str) -> None:
    tokens = tokenize(text)
    assert [token.start for token in tokens] == sorted(token.start for token in tokens)
    for token in tokens:
        assert 0 <= token.start < token.end <= len(text)
        assert token.text == "".join(words(text[token.start : token.end]))
        assert token.text.isprintable()
        assert not set(token.text) & set(' ,()"')


@given(st.lists(st.text(alphabet="abz", min_size=1, max_size=6), max_size=12))
def test_case_and_punctuation_change_nothing(spoken: list[str]) -> None:
    assert words(" ".join(spoken)) == words(", ".join(word.upper() for word in spoken) + "!") == tuple(spoken)


def test_find() -> None:
    text = ["put", "the", "box", "in", "the", "living", "room"]
    assert find(["the"], text) == 1
    assert find(["living", "room"], text) == 5
    assert find(["the", "room"], text) is None
    assert find([], text) is None
    assert find(text, ["put"]) is None


@pytest.mark.parametrize("text", ["a" * (MAX_CHARACTERS + 1), "go " * (MAX_WORDS + 1), "word " * 10_000])
def test_too_long(text: str) -> None:
    with pytest.raises(TextTooLongError) as caught:
        tokenize(text)
    assert caught.value.slug == "text-too-long"
    assert [place.pointer for place in caught.value.places] == [""]


def test_the_longest_allowed() -> None:
    assert len(tokenize("go " * MAX_WORDS)) == MAX_WORDS
    assert len(tokenize("a" * MAX_CHARACTERS)) == 1


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("Zoo, yes. Gallery, never!", "zoo , yes . gallery , never !"),
        ("go to H&M (2nd floor); wait: at 3 a.m.", "go to h&m 2nd floor ; wait : at 3 a.m ."),
        ("the yo-yo", "the yo-yo"),
        ("zoo -> bank=>cafe → lab", "zoo -> bank -> cafe -> lab"),
        ("kitchen <-> hall + zoo & H&M", "kitchen <-> hall + zoo + h&m"),
        ("kitchen/hall w/o stopping, 24/7 | bank", "kitchen / hall w/o stopping , 24/7 / bank"),
        ("...", ". . ."),
        ("", ""),
    ],
)
def test_marks_stand_between_the_words(text: str, expected: str) -> None:
    assert marked_words(text) == tuple(expected.split())
    assert tuple(word for word in marked_words(text) if not is_mark(word)) == words(text)
