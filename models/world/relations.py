"""Relations between objects as phrases say them: "the toy *in* the box", "the room *north of* the kitchen".

What relates two objects comes from the domain:

- an attribute whose value is an object, said by its name ("in", "stands in"); it may lead on, as what is in a box that
  is in the kitchen is in the kitchen; and "the A of Y" is what attribute A of Y holds ("north of the kitchen");
- a propositional function of two arguments, said by what stands between them in its reading or display patterns
  ("{r} is near {p}"), or by its name.

Where a word such as "in", "at" or "on" relates things of these kinds in neither way, it is a place in general: what any
such word's function says of them, else what any attribute holds. "With" is that the other way round.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator, Mapping, Sequence, Set
from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING

from models.world.grid import DIRECTIONS
from models.world.names import words
from models.world.phrase_index import WHATEVER

if TYPE_CHECKING:
    from models.world.domain import Function
    from models.world.situation import Situation
    from models.world.vocabulary import Symbol, Vocabulary

Words = tuple[str, ...]
_Fact = tuple[str, tuple["Symbol", "Symbol"]]  # a propositional function and its arguments
_HOLE = re.compile(r"\{([^{}]*)\}")
_PLACES, _NEAR, _HOLDS = (
    frozenset(words(said) for said in listed.split(","))
    for listed in (
        "in,at,on,inside,inside of,within,from,out of,off,on top of",
        "near,next to,close to,beside,by",
        "with,containing,that contains,that has,that holds",
    )
)
_LINKS = frozenset(words("is are the a an that which to lying standing sitting located stored kept placed"))
"""Words around the one that relates: "the box that is in", "the room to the north of"."""
_OF_TWO_HOLES = 5  # pieces of a pattern


@dataclass(frozen=True, slots=True)
class Split:
    """A phrase taken apart at a relation: the `figure` is sought, by how it stands to the `ground`."""

    figure: Words
    relation: Words
    ground: Words


@dataclass(frozen=True, slots=True)
class _Reading:
    """A function of two arguments, and at which of them the figure stands."""

    function: Function
    figure: int

    def of(self, figure: Symbol, ground: Symbol) -> _Fact:
        return self.function.name, (ground, figure) if self.figure else (figure, ground)

    def takes(self, figure: Symbol, ground: Symbol) -> bool:
        kinds = [parameter.kinds for parameter in self.function.parameters]
        return figure.kind in kinds[self.figure] and ground.kind in kinds[1 - self.figure]


class Relations:
    """The relations of one vocabulary."""

    def __init__(self, vocabulary: Vocabulary) -> None:
        self._vocabulary = vocabulary

    def splits(self, said: Words) -> Iterator[Split]:
        """The ways to take a phrase apart, the earliest relation first, of several there the longest."""
        for length in range(2, min(self._longest, len(said) - 1) + 1):
            relation = said[:length]
            if relation[-1] == "of" and relation in self._sayings and relation not in _PLACES:  # "the owner of the dog"
                yield Split((WHATEVER,), relation, said[length:])
        for place in range(1, len(said) - 1):
            for length in range(min(self._longest, len(said) - 1 - place), 0, -1):
                relation = said[place : place + length]
                if relation in self._sayings and (figure := _unlinked(said[:place])):
                    yield Split(figure, relation, said[place + length :])

    def mentioned(self, said: Words) -> bool:
        """Whether some words relate things."""
        lengths = range(1, self._longest + 1)
        return any(said[place : place + length] in self._sayings for place in range(len(said)) for length in lengths)

    def test(self, relation: Words, situation: Situation) -> Callable[[Symbol, Symbol], bool]:
        """Whether a figure stands in a relation to a ground, in a situation."""

        def related(figure: Symbol, ground: Symbol) -> bool:
            if figure == ground:
                return False
            if relation in _HOLDS:
                return self._located(ground, figure, situation)
            attribute = self._attributes.get(relation[:-1]) if relation[-1] == "of" else None
            if attribute is not None and situation.related(ground).get(attribute) == figure:
                return True
            said = self._said(relation, figure, ground, situation)
            if said is not None:
                return said
            return relation in _PLACES and self._located(figure, ground, situation)

        return related

    @cached_property
    def _attributes(self) -> Mapping[Words, str]:
        """The attributes that may hold objects, by what they are called."""
        vocabulary = self._vocabulary
        found = {}
        for facts in vocabulary.static.values():
            for attribute, value in facts.items():
                if vocabulary.is_object(value):
                    found[words(attribute)] = attribute
        for attributes in vocabulary.state_kinds.values():
            for attribute, kinds in attributes.items():
                if not vocabulary.class_words.keys().isdisjoint(kinds):
                    found[words(attribute)] = attribute
        return {said: attribute for said, attribute in found.items() if said}

    @cached_property
    def _readings(self) -> Mapping[Words, list[_Reading]]:
        """The functions of two objects, by what is said between their arguments."""
        found: dict[Words, list[_Reading]] = {}
        for function in self._vocabulary.functions.values():
            if len(function.parameters) == 2:
                for said, figure in {(words(function.name), 0), *_between(function)}:
                    if said:
                        found.setdefault(said, []).append(_Reading(function, figure))
        return found

    @cached_property
    def _sayings(self) -> frozenset[Words]:
        attributes = {said for said, attribute in self._attributes.items() if attribute not in DIRECTIONS}
        placed = {(*said, *place) for said in attributes for place in _PLACES}
        of = {(*said, "of") for said in self._attributes}
        return frozenset({*attributes, *placed, *of, *self._readings, *_PLACES, *_NEAR, *_HOLDS})

    @cached_property
    def _longest(self) -> int:
        return max(map(len, self._sayings))

    def _said(self, relation: Words, figure: Symbol, ground: Symbol, situation: Situation) -> bool | None:
        """What the attribute and the functions of that very name say; None when there are none for such things."""
        facts = self._facts({relation}, figure, ground)
        if relation in _NEAR:  # either is near the other
            facts += [*self._facts(_NEAR, figure, ground), *self._facts(_NEAR, ground, figure)]
        attribute = self._attributes.get(relation) or self._verb(relation)
        holds = attribute is not None and attribute not in DIRECTIONS and self._may_hold(figure, attribute, ground)
        if not facts and not holds:
            return None
        return (holds and self._leads(figure, ground, situation, attribute)) or _any(facts, situation)

    def _located(self, figure: Symbol, ground: Symbol, situation: Situation) -> bool:
        """Whether the figure is at the ground, however that is said."""
        facts = self._facts(_PLACES, figure, ground)
        return _any(facts, situation) if facts else self._leads(figure, ground, situation)

    def _leads(self, figure: Symbol, ground: Symbol, situation: Situation, attribute: str | None = None) -> bool:
        """Whether attributes, but for the directions of a map, lead from the figure to the ground in some steps, the
        first of them by a certain one if any.

        Not through the robot, or whatever else is always there: what it carries is not where it is.
        """
        seen, left = {figure, *self._vocabulary.constants}, [figure]
        while left:
            thing = left.pop()
            for name, held in situation.related(thing).items():
                if name not in DIRECTIONS and (thing != figure or attribute in (None, name)):
                    if held == ground:
                        return True
                    if held not in seen:
                        seen.add(held)
                        left.append(held)
        return False

    def _facts(self, relations: Set[Words], figure: Symbol, ground: Symbol) -> list[_Fact]:
        """What the functions said so would say of two objects that they take."""
        readings = (reading for relation in relations for reading in self._readings.get(relation, ()))
        return [reading.of(figure, ground) for reading in readings if reading.takes(figure, ground)]

    def _verb(self, relation: Words) -> str | None:
        """The attribute of "stands in"."""
        ends = (length for length in range(1, len(relation)) if relation[-length:] in _PLACES)
        return next((found for length in ends if (found := self._attributes.get(relation[:-length]))), None)

    def _may_hold(self, figure: Symbol, attribute: str, ground: Symbol) -> bool:
        held = self._vocabulary.static.get(figure, {}).get(attribute)
        kinds = self._vocabulary.state_kinds.get(figure.kind, {}).get(attribute, ())
        return ground.kind in kinds or (held is not None and held.kind == ground.kind)


def _any(facts: Sequence[_Fact], situation: Situation) -> bool:
    return any(situation.holds(function, *symbols) for function, symbols in facts)


def _between(function: Function) -> Iterator[tuple[Words, int]]:
    """What is said between the two arguments of a function, and which of them comes first."""
    for pattern in (function.says, *function.display):
        before, first, said, second, after = _pieces(pattern)
        if not before and not after and {first, second} == {parameter.name for parameter in function.parameters}:
            spoken = tuple(word for word in words(said) if word not in _LINKS)
            yield spoken, 0 if first == function.parameters[0].name else 1


def _pieces(pattern: str) -> tuple[str, ...]:
    """The text before, between and after the two holes of a pattern, and their names; empty for other patterns."""
    pieces = tuple(piece.strip() for piece in _HOLE.split(pattern))
    return pieces if len(pieces) == _OF_TWO_HOLES else ("",) * _OF_TWO_HOLES


def _unlinked(said: Words) -> Words:
    """Words without those at their end that only lead on to the relation."""
    end = len(said)
    while end and said[end - 1] in _LINKS:
        end -= 1
    return said[:end]
