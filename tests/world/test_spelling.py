"""Words one mistake apart, against a distance computed from its definition."""

from functools import cache

import pytest
from hypothesis import example, given
from hypothesis import strategies as st

from models.world.spelling import MAX_LETTERS, Spelling


def distance(left: str, right: str) -> int:
    """Optimal string alignment: insertions, deletions, substitutions and swaps of neighbours, by its recurrence."""

    @cache
    def between(i: int, j: int) -> int:
        if i == 0 or j == 0:
            return i + j
        ways = [between(i - 1, j) + 1, between(i, j - 1) + 1, between(i - 1, j - 1) + (left[i - 1] != right[j - 1])]
        if i > 1 and j > 1 and left[i - 2 : i] == right[j - 1] + right[j - 2]:
            ways.append(between(i - 2, j - 2) + 1)
        return min(ways)

    return between(len(left), len(right))


WORDS = st.text(alphabet="abc", min_size=1, max_size=8)


@given(st.lists(WORDS, max_size=60), WORDS)
@example(["abc"], "ab")
@example(["abcab"], "bacab")
@example(["aaaaa"], "aaaaaa")
def test_near_words_are_those_at_distance_one(known, word):
    near = Spelling(known).near(word)
    expected = {
        other
        for other in known
        if len(other) >= 3
        and len(word) >= 2
        and distance(word, other) == 1
        and (max(len(word), len(other)) > 4 or word[0] == other[0])
    }
    assert near == tuple(sorted(expected))


@pytest.mark.parametrize(
    ("word", "near"),
    [
        ("cylindr", ("cylinder",)),
        ("cylinnder", ("cylinder",)),
        ("cylimder", ("cylinder",)),
        ("cylidner", ("cylinder",)),
        ("ylinder", ("cylinder",)),
        ("cilindr", ()),
        ("cylinder", ()),
        ("bx", ("box",)),
        ("bok", ("book", "box")),
        ("fox", ()),  # a short word begins as it should
        ("hall", ()),
        ("room12", ()),  # a number is not misspelt
        ("room13", ()),
        ("", ()),
        ("b", ()),
    ],
)
def test_examples(word, near):
    assert Spelling(["cylinder", "box", "ball", "book", "room11", "of"]).near(word) == near


def test_the_longest_words():
    longest = "a" * MAX_LETTERS
    assert Spelling([longest]).near(longest + "a") == (longest,)
    assert Spelling([longest + "a"]).near(longest) == ()
