"""Compositions within compositions: a pattern in the place of a clause of another pattern.

Nobody writes patterns for every way to nest commands; those with three and four clauses follow from those with two.
"""

from __future__ import annotations

import random
import re
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from functools import cache

from models.language.dataset.composition import Hole, Pattern, patterns

OWN = 0.5
"""Part of the inner texts that are in the words of a pattern, where there are such; others are mere lists."""
MARKS = frozenset(".:;?!")
_NUMBER = re.compile(r"\d")
_COMMA = ","


@dataclass(frozen=True, slots=True)
class Nesting:
    """A shape that is another with a shape in the place of one of its clauses."""

    shape: str
    outer: str
    clause: int
    inner: str


NESTINGS = tuple(
    Nesting(*entry)
    for entry in (
        ("and(1, 2, 3, avoid(4))", "and(1, avoid(2))", 1, "and(1, 2, 3)"),
        ("and(1, 2, avoid(3), avoid(4))", "and(1, avoid(2), avoid(3))", 1, "and(1, 2)"),
        ("and(then(1, 2), avoid(3), avoid(4))", "and(1, avoid(2), avoid(3))", 1, "then(1, 2)"),
        ("and(or(1, 2), avoid(3), avoid(4))", "and(1, avoid(2), avoid(3))", 1, "or(1, 2)"),
        ("and(or(1, 2, 3), avoid(4))", "and(1, avoid(2))", 1, "or(1, 2, 3)"),
        ("and(then(or(1, 2), 3), avoid(4))", "and(then(1, 2), avoid(3))", 1, "or(1, 2)"),
        ("and(then(1, and(2, 3)), avoid(4))", "and(then(1, 2), avoid(3))", 2, "and(1, 2)"),
        ("and(then(and(1, 2), 3), avoid(4))", "and(then(1, 2), avoid(3))", 1, "and(1, 2)"),
        ("and(repeat(or(1, 2)), avoid(3))", "and(repeat(1), avoid(2))", 1, "or(1, 2)"),
        ("and(repeat(and(1, 2, 3)), avoid(4))", "and(1, avoid(2))", 1, "repeat(and(1, 2, 3))"),
        ("and(repeat(and(1, 2)), avoid(3), avoid(4))", "and(1, avoid(2), avoid(3))", 1, "repeat(and(1, 2))"),
        ("and(repeat(1), avoid(2), avoid(3))", "and(1, avoid(2), avoid(3))", 1, "repeat(1)"),
        ("then(1, repeat(and(2, 3)))", "then(1, 2)", 2, "repeat(and(1, 2))"),
        ("then(1, repeat(or(2, 3)))", "then(1, repeat(2))", 2, "or(1, 2)"),
        ("then(1, 2, repeat(3))", "then(1, 2, 3)", 3, "repeat(1)"),
        ("then(1, 2, repeat(and(3, 4)))", "then(1, 2, 3)", 3, "repeat(and(1, 2))"),
        ("then(or(1, 2), repeat(3))", "then(1, repeat(2))", 1, "or(1, 2)"),
        ("then(and(1, 2), repeat(3))", "then(1, repeat(2))", 1, "and(1, 2)"),
        ("then(and(1, 2), or(3, 4))", "then(1, or(2, 3))", 1, "and(1, 2)"),
        ("then(or(1, 2), or(3, 4))", "then(1, or(2, 3))", 1, "or(1, 2)"),
        ("then(or(1, 2), and(3, 4))", "then(1, and(2, 3))", 1, "or(1, 2)"),
        ("then(1, or(2, 3), 4)", "then(1, 2, 3)", 2, "or(1, 2)"),
        ("then(or(1, 2), 3, 4)", "then(1, 2, 3)", 1, "or(1, 2)"),
        ("then(1, and(2, 3), 4)", "then(1, 2, 3)", 2, "and(1, 2)"),
        ("then(1, 2, and(3, 4))", "then(1, 2, 3)", 3, "and(1, 2)"),
        ("then(1, and(2, 3, 4))", "then(1, 2)", 2, "and(1, 2, 3)"),
        ("then(1, or(2, 3, 4))", "then(1, 2)", 2, "or(1, 2, 3)"),
        ("or(and(1, 2), 3)", "or(1, 2)", 1, "and(1, 2)"),
        ("or(1, and(2, 3))", "or(1, 2)", 2, "and(1, 2)"),
        ("or(then(1, 2), then(3, 4))", "or(1, then(2, 3))", 1, "then(1, 2)"),
        ("until(avoid(or(1, 2)), 3)", "until(avoid(1), 2)", 1, "or(1, 2)"),
        ("until(avoid(1), and(2, 3))", "until(avoid(1), 2)", 2, "and(1, 2)"),
        ("until(avoid(or(1, 2)), or(3, 4))", "until(avoid(1), or(2, 3))", 1, "or(1, 2)"),
        ("until(avoid(1), or(2, 3, 4))", "until(avoid(1), 2)", 2, "or(1, 2, 3)"),
        ("and(1, until(avoid(2), or(3, 4)))", "and(1, until(avoid(2), 3))", 3, "or(1, 2)"),
        ("and(1, until(avoid(2), and(3, 4)))", "and(1, until(avoid(2), 3))", 3, "and(1, 2)"),
        ("and(1, until(avoid(or(2, 3)), 4))", "and(1, until(avoid(2), 3))", 2, "or(1, 2)"),
        ("and(or(1, 2), until(avoid(3), 4))", "and(1, until(avoid(2), 3))", 1, "or(1, 2)"),
        ("and(repeat(1), until(avoid(2), 3))", "and(1, until(avoid(2), 3))", 1, "repeat(1)"),
        ("and(1, 2, avoid(3))", "and(1, avoid(2))", 1, "and(1, 2)"),
        ("and(then(1, 2), avoid(3))", "and(1, avoid(2))", 1, "then(1, 2)"),
        ("and(or(1, 2), avoid(3))", "and(1, avoid(2))", 1, "or(1, 2)"),
        ("and(then(1, 2, 3), avoid(4))", "and(1, avoid(2))", 1, "then(1, 2, 3)"),
        ("and(then(1, 2), until(avoid(3), 4))", "and(1, until(avoid(2), 3))", 1, "then(1, 2)"),
        ("and(1, 2, until(avoid(3), 4))", "and(1, until(avoid(2), 3))", 1, "and(1, 2)"),
        ("until(avoid(1), or(2, 3))", "until(avoid(1), 2)", 2, "or(1, 2)"),
        ("and(repeat(and(1, 2)), avoid(3))", "and(1, avoid(2))", 1, "repeat(and(1, 2))"),
        ("and(repeat(1), avoid(2))", "and(1, avoid(2))", 1, "repeat(1)"),
        ("and(repeat(and(1, 2)), until(avoid(3), 4))", "and(1, until(avoid(2), 3))", 1, "repeat(and(1, 2))"),
        ("then(1, repeat(2))", "then(1, 2)", 2, "repeat(1)"),
        ("then(1, or(2, 3))", "then(1, 2)", 2, "or(1, 2)"),
        ("then(or(1, 2), 3)", "then(1, 2)", 1, "or(1, 2)"),
        ("then(1, and(2, 3))", "then(1, 2)", 2, "and(1, 2)"),
        ("then(and(1, 2), 3)", "then(1, 2)", 1, "and(1, 2)"),
        ("or(then(1, 2), 3)", "or(1, 2)", 1, "then(1, 2)"),
        ("or(1, then(2, 3))", "or(1, 2)", 2, "then(1, 2)"),
        ("then(1, 2, or(3, 4))", "then(1, 2, 3)", 3, "or(1, 2)"),
        ("and(then(1, or(2, 3)), avoid(4))", "and(then(1, 2), avoid(3))", 2, "or(1, 2)"),
    )
)
"""Each shape once."""


@cache
def nestings() -> dict[str, Nesting]:
    """The nestings by shape."""
    return {nesting.shape: nesting for nesting in NESTINGS}


def nested(shape: str, generator: random.Random) -> Pattern:
    """A pattern of a shape that is a nesting, drawn."""
    nesting = nestings()[shape]
    outer, hole = generator.choice(_outer(nesting.outer, nesting.clause))
    inner = _inner(nesting.inner, hole, generator)
    more = len({element.leaf for element in inner if isinstance(element, Hole)}) - 1
    elements: list[str | Hole] = []
    for element in outer.elements:
        if element == hole:
            elements += [_moved(part, hole.leaf - 1) for part in inner]
        elif isinstance(element, Hole) and element.leaf > hole.leaf:
            elements.append(_moved(element, more))
        else:
            elements.append(element)
    return Pattern(shape, tuple(elements))


@cache
def _outer(shape: str, clause: int) -> tuple[tuple[Pattern, Hole], ...]:
    """The patterns of a shape in which a clause is in one piece, and its hole."""
    found = ((pattern, [hole for hole in pattern.holes if hole.leaf == clause]) for pattern in patterns()[shape])
    return tuple((pattern, holes[0]) for pattern, holes in found if len(holes) == 1)


def _moved(element: str | Hole, by: int) -> str | Hole:
    return Hole(element.leaf + by, element.form) if isinstance(element, Hole) else element


def _inner(shape: str, hole: Hole, generator: random.Random) -> Sequence[str | Hole]:
    """The words and holes of a shape in the form of a clause."""
    fitting = _fitting(shape) if hole.form == "do" else ()
    listed = shape.startswith(("and(", "or("))
    if fitting and (not listed or generator.random() < OWN):
        return generator.choice(fitting).elements
    if listed or hole.form != "do":
        return tuple(_listed(shape, hole, generator))
    return generator.choice(patterns()[shape]).elements


@cache
def _fitting(shape: str) -> tuple[Pattern, ...]:
    """The patterns that may stand where an imperative does: they begin with one, and are one sentence."""
    return tuple(
        pattern
        for pattern in patterns()[shape]
        if pattern.elements[0] == Hole(1, "do")
        and not MARKS.intersection(e for e in pattern.elements if isinstance(e, str))
    )


def _listed(shape: str, hole: Hole, generator: random.Random) -> Iterator[str | Hole]:
    """Clauses of one form with "and", "or" or "then" between them; after an imperative others may be mere names."""
    count = len(_NUMBER.findall(shape))
    operator = shape.partition("(")[0] if shape.startswith(("and(", "or(")) else "then"
    both = {"and": "both", "or": "either"}.get(operator)
    bare = hole.form == "do" and generator.random() < 0.6
    commas = generator.random() < 0.5
    if both and count == 2 and generator.random() < 0.25:
        yield both
        bare = False
    for number in range(1, count + 1):
        if number > 1:
            if number < count and commas:
                yield _COMMA
            elif operator == "then":
                yield from generator.choice([("and", "then"), (",", "then"), ("and", "afterwards"), ("then",)])
            else:
                yield from ((_COMMA, operator) if count > 2 and commas and generator.random() < 0.5 else (operator,))
        yield Hole(number, "it" if bare and number > 1 else hole.form)
