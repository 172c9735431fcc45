"""What a text mentions, before it is compared with anything: there are several ways to see it.

Shapes: S words, D of their vectors, V vectors of what is asked for, R of roles, L tags.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence
from dataclasses import dataclass

import numpy as np

from models.language.matching.config import ON, OUTSIDE
from models.language.matching.heads import Heads
from models.language.matching.nearness import Vectors, free_words
from models.language.spans.decoding import best_sequences, log_totals
from models.language.spans.tags import Span
from models.language.spans.translator import quantified
from models.world import quantifiers

SEQUENCES = 6
"""Ways to see what a text mentions that are looked at."""
NAMED = 0.75
"""Probability that a command is about all that it names in the environment, and nothing else; where all of a kind are
named, one half is for a command about nothing in particular.
"""


@dataclass(frozen=True, slots=True, eq=False)
class Seen:
    """A way to see what a text mentions: the mentions, its probability, and the vectors that follow from it."""

    spans: tuple[Span, ...]
    probability: float
    asked: Vectors  # [V]
    roles: Vectors  # [mentions, R]
    named: bool  # whether that is expected of what the text names in the environment


def ways_to_see(heads: Heads, said: tuple[str, ...], vectors: Vectors, named: Sequence[Span] = ()) -> list[Seen]:
    """The likeliest ways to see what a text with the vectors [S, D] mentions; what is `named` in it is one."""
    emissions = heads.tags(vectors)[None]  # [1, S, L]
    moves, start = (scores[None] for scores in heads.moves())
    (total,) = log_totals(emissions, moves, start)
    expected = _expected(said, named)
    ways: dict[tuple[Span, ...], float] = dict.fromkeys(expected, NAMED / max(1, len(expected)))
    share = 1.0 - sum(ways.values())
    for points, tags in best_sequences(emissions, moves, start, count=SEQUENCES)[0]:
        spans = _distinct(said, _spans(tags))
        ways[spans] = ways.get(spans, 0.0) + share * math.exp(min(0.0, points - total))
    every = list(dict.fromkeys(span for spans in ways for span in spans))
    roles = dict(zip(every, heads.roles(vectors, every), strict=True))
    none = np.zeros((0, heads.config.role), np.float32)
    asked = heads.asked(vectors, [free_words(len(said), spans) for spans in ways])
    return [
        Seen(
            spans,
            share,
            asked[row],
            np.stack([roles[span] for span in spans]) if spans else none,
            spans in expected,
        )
        for row, (spans, share) in enumerate(ways.items())
    ]


def _spans(tags: Sequence[int]) -> list[Span]:
    """The mentions that tags say, left to right."""
    spans: list[Span] = []
    for place, tag in enumerate(tags):
        if tag == ON and spans:
            spans[-1] = (spans[-1][0], place + 1)
        elif tag != OUTSIDE:
            spans.append((place, place + 1))
    return spans


def _expected(said: Sequence[str], named: Sequence[Span]) -> list[tuple[Span, ...]]:
    """The ways to see a text that names something: it is about that, or, where only "all the lights" are named, about
    no thing in particular: "turn off all the lights" may be a task of its own.
    """
    if not named:
        return []
    wide = (quantified(said, span, named) for span in named)
    of_all = all(
        quantifiers.quantified(" ".join(said[slice(*span)])).quantifier is quantifiers.Quantifier.ALL for span in wide
    )
    return [_distinct(said, named), ()] if of_all else [_distinct(said, named)]


def _distinct(said: Sequence[str], spans: Iterable[Span]) -> tuple[Span, ...]:
    """What is mentioned twice in the same words counts once."""
    first: dict[tuple[str, ...], Span] = {}
    for span in spans:
        first.setdefault(tuple(said[slice(*span)]), span)
    return tuple(first.values())
