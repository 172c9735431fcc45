"""What is JSON enough to be looked at, against Python's own parser where that is strict."""

from __future__ import annotations

import json

import pytest
from hypothesis import given
from hypothesis import strategies as st

from service.http.schemas import Problem
from service.http.strict_json import Flawed, read_json

TEXTS = st.text(st.characters(exclude_characters="\x00", exclude_categories=["Cs"]))
VALUES = st.recursive(
    st.none() | st.booleans() | st.integers(-(10**9), 10**9) | st.floats(allow_nan=False, allow_infinity=False) | TEXTS,
    lambda inner: st.lists(inner, max_size=3) | st.dictionaries(TEXTS, inner, max_size=3),
    max_leaves=12,
)


def depth(value: object) -> int:
    if isinstance(value, dict):
        value = list(value.values())
    return 1 + max(map(depth, value), default=0) if isinstance(value, list) else 0


def flaw(body: bytes, most: int) -> Problem | None:
    try:
        read_json(body, most)
    except Flawed as flawed:
        return flawed.problem
    return None


def slug(body: bytes, most: int = 64) -> str | None:
    found = flaw(body, most)
    return None if found is None else found.type.rpartition(":")[2]


@given(VALUES, st.booleans())
def test_what_json_writes_is_taken(value: object, ascii_only: bool) -> None:
    body = json.dumps(value, ensure_ascii=ascii_only).encode()
    assert read_json(body, 64) == value


@given(VALUES, st.integers(0, 4))
def test_depth_is_that_of_the_value(value: object, most: int) -> None:
    assert slug(json.dumps(value).encode(), most) == ("body-too-deep" if depth(value) > most else None)


@pytest.mark.parametrize(
    ("body", "expected"),
    [
        (b'{"a": 1, "b": {"a": 2}}', None),
        (b'{"a": 1, "a": 1}', "malformed-json"),
        (b'[{"b": {"a": 1, "\\u0061": 2}}]', "malformed-json"),
        (b"[NaN]", "malformed-json"),
        (b'{"a": -Infinity}', "malformed-json"),
        (b"9" * 10_000, "malformed-json"),
        (b'"NaN"', None),
        (b"\xff\xfe", "malformed-json"),
        ("[1]".encode("utf-16"), "malformed-json"),
        (b"\xef\xbb\xbf[1]", "malformed-json"),
        (b'"\x00"', "malformed-json"),
        (b'"\xed\xa0\x80"', "malformed-json"),
        (b"[" * 64 + b"]" * 64, None),
        (b"[" * 65 + b"]" * 65, "body-too-deep"),
        (b"[" * 400_000 + b"]" * 400_000, "body-too-deep"),
        (b'{"a":' * 65 + b"1" + b"}" * 65, "body-too-deep"),
        (b'"' + b"[{" * 1_000 + b'"', None),
        (b"[" + b"{}," * 1_000 + b"{}]", None),
        (rb'"\u0000"', "validation"),
        (rb'"\ud83d\ude00"', None),
        (rb'"\ud83d"', "validation"),
        (rb'"\ude00\ud83d"', "validation"),
        (rb'"\\u0000"', None),
    ],
)
def test_bodies(body: bytes, expected: str | None) -> None:
    assert slug(body) == expected


def test_the_place_of_a_character_that_is_none() -> None:
    found = flaw(rb'{"a/b": ["x", {"c~": "\uDFFF"}], "z": "\u0000"}', 64)
    assert found is not None
    assert [place.pointer for place in found.errors] == ["/a~1b/1/c~0"]
    assert "U+DFFF" in found.detail


def test_a_name_that_is_no_text() -> None:
    found = flaw(rb'{"a": {"\u0000": 1}}', 64)
    assert found is not None
    assert [place.pointer for place in found.errors] == ["/a"]
