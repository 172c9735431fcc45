from __future__ import annotations

from itertools import pairwise

from hypothesis import given
from hypothesis import strategies as st

from models.language.spans.tags import MAX_ARGUMENTS, TAGS, Span, forbidden_moves, mentions_of, tags_of


def test_tags_of_a_command_with_two_mentions_of_the_container() -> None:
    # put the tape measure in the box then take the box away
    tags = tags_of(11, [[(2, 4)], [(6, 7), (10, 11)]])
    assert tags == (0, 0, 1, 2, 0, 0, 3, 0, 0, 0, 3)
    assert mentions_of(tags, 2) == (((2, 4),), ((6, 7), (10, 11)))


@st.composite
def layouts(draw: st.DrawFn) -> tuple[int, tuple[tuple[Span, ...], ...]]:
    """A text's length and mentions that do not overlap, some of them side by side."""
    pieces = draw(st.lists(st.tuples(st.integers(0, MAX_ARGUMENTS), st.integers(1, 3)), min_size=1, max_size=8))
    mentions: list[list[Span]] = [[] for _ in range(MAX_ARGUMENTS)]
    at = 0
    for kind, length in pieces:
        if kind < MAX_ARGUMENTS:
            mentions[kind].append((at, at + length))
        at += length
    return at, tuple(map(tuple, mentions))


@given(layouts())
def test_mentions_come_back_and_their_tags_are_allowed(layout: tuple[int, tuple[tuple[Span, ...], ...]]) -> None:
    count, mentions = layout
    tags = tags_of(count, mentions)
    assert mentions_of(tags, MAX_ARGUMENTS) == mentions
    moves, start = forbidden_moves(MAX_ARGUMENTS)
    assert start[tags[0]] == 0
    assert all(moves[one][two] == 0 for one, two in pairwise(tags))


def test_a_mention_cannot_go_on_before_it_began_nor_in_a_task_without_the_argument() -> None:
    moves, start = forbidden_moves(1)
    allowed = {(one, two) for one in range(TAGS) for two in range(TAGS) if moves[one][two] == 0}
    assert allowed == {(0, 0), (0, 1), (1, 0), (1, 1), (1, 2), (2, 0), (2, 1), (2, 2)}
    assert [tag for tag in range(TAGS) if start[tag] == 0] == [0, 1]
