"""Tags of words: outside, or the beginning or the rest of a mention of an argument."""

from __future__ import annotations

from collections.abc import Iterable, Sequence

OUTSIDE = 0
MAX_ARGUMENTS = 4
"""Arguments of a task class that every network has tags for, and the most clauses of a composed command."""
MOST_ARGUMENTS = 16
"""The most arguments of a task class, as of a contextual query."""
TAGS = 1 + 2 * MAX_ARGUMENTS
"""The tags of `MAX_ARGUMENTS`: `OUTSIDE`, then two for each argument position."""
FORBIDDEN = -1e4
"""The score of what must not be: finite, so that sums of it have gradients."""
Span = tuple[int, int]
"""A half-open range of the words of a text."""


def begins(argument: int) -> int:
    """The tag of the first word of a mention of an argument, counted from 0."""
    return 1 + 2 * argument


def goes_on(argument: int) -> int:
    """The tag of the other words of a mention."""
    return 2 + 2 * argument


def tags_of(count: int, mentions: Sequence[Sequence[Span]]) -> tuple[int, ...]:
    """The tags of a text of `count` words, of which `mentions[i]` name argument `i`."""
    tags = [OUTSIDE] * count
    for argument, spans in enumerate(mentions):
        for begin, end in spans:
            tags[begin:end] = [begins(argument), *[goes_on(argument)] * (end - begin - 1)]
    return tuple(tags)


def mentions_of(tags: Sequence[int], arity: int) -> tuple[tuple[Span, ...], ...]:
    """The mentions of each argument, left to right; the inverse of `tags_of`."""
    mentions: list[list[Span]] = [[] for _ in range(arity)]
    for place, tag in enumerate(tags):
        if tag == OUTSIDE:
            continue
        argument, rest = divmod(tag - 1, 2)
        if rest:
            mentions[argument][-1] = (mentions[argument][-1][0], place + 1)
        else:
            mentions[argument].append((place, place + 1))
    return tuple(map(tuple, mentions))


def tag_count(arities: Iterable[int]) -> int:
    """L, the tags of a network for task classes with these numbers of arguments."""
    return 1 + 2 * max(MAX_ARGUMENTS, *arities)


def forbidden_moves(arity: int, tags: int = TAGS) -> tuple[list[list[float]], list[float]]:
    """Scores [L, L] of pairs of neighbouring tags and [L] of the first tag: 0, or `FORBIDDEN`; L is `tags`.

    A mention goes on only after it began, and a task has no tags beyond its arguments.
    """
    usable = [tag <= 2 * arity for tag in range(tags)]
    moves = [
        [0.0 if usable[before] and usable[after] and _may_follow(before, after) else FORBIDDEN for after in range(tags)]
        for before in range(tags)
    ]
    return moves, [0.0 if usable[tag] and (tag == OUTSIDE or tag % 2) else FORBIDDEN for tag in range(tags)]


def _may_follow(before: int, after: int) -> bool:
    return after == OUTSIDE or after % 2 == 1 or before in (after - 1, after)
