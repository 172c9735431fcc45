"""The parts of a formula, each with its own reading, so that a reader can see which part says what."""

from __future__ import annotations

from dataclasses import dataclass

from models.logic import Atom, Constant, Formula, Unary, atoms, children
from models.world.environment import Environment
from models.world.explanation import Speaker, cut

MAX_PARTS = 100
"""Most parts of an outline, those of the outer levels first."""
MAX_PART_DEPTH = 6
"""Most levels of parts."""
MAX_PART_READING = 1_000
"""Most characters of the reading of one part."""


@dataclass(frozen=True, slots=True)
class Part:
    """A part of a formula, what it says, and its own parts; none of a literal, and beyond the limits."""

    formula: Formula
    explanation: str
    parts: tuple[Part, ...]


def outline(formula: Formula, environment: Environment | None = None) -> tuple[Part, ...]:
    """The parts that the outermost binary operator of a formula joins, whatever unary ones stand before it, and their
    parts in turn. Each is read as `explain` would read it by itself, but that two atoms which are read alike anywhere
    in the whole formula are told apart in its parts, too.
    """
    speaker = Speaker(atoms(formula), environment)
    levels: list[list[tuple[int, Formula]]] = [[(0, part) for part in _joined_in(formula)[:MAX_PARTS]]]
    left = MAX_PARTS - len(levels[0])
    while left and levels[-1] and len(levels) < MAX_PART_DEPTH:
        below = [(place, part) for place, (_, above) in enumerate(levels[-1]) for part in _joined_in(above)][:left]
        left -= len(below)
        levels.append(below)
    made: list[tuple[int, Part]] = []
    for level in reversed(levels):
        inner: dict[int, list[Part]] = {}
        for parent, part in made:
            inner.setdefault(parent, []).append(part)
        made = [
            (parent, Part(part, cut(speaker.say(part).text, MAX_PART_READING), tuple(inner.get(place, ()))))
            for place, (parent, part) in enumerate(level)
        ]
    return tuple(part for _, part in made)


def _joined_in(formula: Formula) -> tuple[Formula, ...]:
    while isinstance(formula, Unary):
        formula = formula.operand
    return () if isinstance(formula, (Atom, Constant)) else children(formula)
