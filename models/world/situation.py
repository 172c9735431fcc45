"""How things stand in one state of an environment: what phrases such as "the toy in the kitchen" go by."""

from __future__ import annotations

from collections.abc import Mapping
from functools import cached_property
from threading import Lock
from typing import TYPE_CHECKING

from models.logic.formula import Atom, Name
from models.world.errors import WorldError
from models.world.grid import DIRECTIONS
from models.world.names import singular, words
from models.world.oomdp import OomdpWorld

if TYPE_CHECKING:
    from models.world.vocabulary import Symbol, Vocabulary
    from models.world.world import World

_EVALUATING = Lock()  # the memory of a world's evaluator is not for several threads at once
_NOTHING: Mapping[str, Symbol] = {}


class Situation:
    """The attributes of all objects in one state, those that never change and those that do."""

    def __init__(self, vocabulary: Vocabulary, world: World, index: int) -> None:
        self._vocabulary = vocabulary
        self._world = world
        self._index = index

    def related(self, symbol: Symbol) -> Mapping[str, Symbol]:
        """The objects that an object's attributes hold, by attribute."""
        return self._related.get(symbol, _NOTHING)

    def values(self, symbol: Symbol) -> Mapping[str, Symbol]:
        """The attribute values that an object has in this state and may not have in another, by attribute."""
        return self._values.get(symbol, _NOTHING)

    def valued(self, stem: str) -> Mapping[Symbol, None]:
        """The objects that have a value in this state whose name has the word, in the singular."""
        return self._by_word.get(stem, {})

    def holds(self, function: str, *symbols: Symbol) -> bool:
        """Whether a propositional function is true of some symbols; false where it is too much work to tell."""
        if not isinstance(self._world, OomdpWorld):
            return False
        atom = Atom(function, tuple(Name(self._distinct(symbol)) for symbol in symbols))
        with _EVALUATING:
            try:
                return self._world.holds(atom, self._index)
            except WorldError:
                return False

    def distance(self, symbol: Symbol) -> int | None:
        """How many moves on the map an object is from the robot; None for what is on no map, or cannot be reached."""
        place = self._place(symbol)
        return None if place is None else self._distances.get(place)

    def _place(self, symbol: Symbol) -> Symbol | None:
        """The cell of a map that an object is, or is in."""
        seen = [symbol]
        for thing in seen:
            related = self.related(thing)
            if not DIRECTIONS.keys().isdisjoint(related):
                return thing
            seen += [held for held in related.values() if held not in seen]
        return None

    @cached_property
    def _distances(self) -> Mapping[Symbol, int]:
        """The moves to each cell from where the robot is: the one constant of the domain that is on the map."""
        starts = {place for constant in self._vocabulary.constants if (place := self._place(constant)) is not None}
        if len(starts) != 1:
            return {}
        found = dict.fromkeys(starts, 0)
        queue = [*starts]
        for cell in queue:
            for direction, other in self.related(cell).items():
                if direction in DIRECTIONS and other not in found:
                    found[other] = found[cell] + 1
                    queue.append(other)
        return found

    @cached_property
    def _state(self) -> Mapping[Symbol, Mapping[str, Symbol]]:
        """What each object's state attributes hold."""
        vocabulary = self._vocabulary
        objects = {symbol.name: symbol for symbol in vocabulary.objects}
        found: dict[Symbol, dict[str, Symbol]] = {}
        for name, attributes in self._world.decode(self._index).items():
            if (owner := objects.get(name)) is None:
                continue  # the state of an explicit environment
            for attribute, value in attributes.items():
                kinds = vocabulary.state_kinds[owner.kind][attribute]
                held = next((symbol for symbol in vocabulary.named(value) if symbol.kind in kinds), None)
                if held is not None:
                    found.setdefault(owner, {})[attribute] = held
        return found

    @cached_property
    def _related(self) -> Mapping[Symbol, Mapping[str, Symbol]]:
        is_object = self._vocabulary.is_object
        found: dict[Symbol, dict[str, Symbol]] = {}
        for facts in (self._vocabulary.static, self._state):
            for owner, attributes in facts.items():
                for attribute, value in attributes.items():
                    if is_object(value):
                        found.setdefault(owner, {})[attribute] = value
        return found

    @cached_property
    def _values(self) -> Mapping[Symbol, Mapping[str, Symbol]]:
        is_object = self._vocabulary.is_object
        valued = {
            owner: {attribute: value for attribute, value in attributes.items() if not is_object(value)}
            for owner, attributes in self._state.items()
        }
        return {owner: attributes for owner, attributes in valued.items() if attributes}

    @cached_property
    def _by_word(self) -> Mapping[str, Mapping[Symbol, None]]:
        found: dict[str, dict[Symbol, None]] = {}
        for owner, attributes in self._values.items():
            for value in attributes.values():
                for name in self._vocabulary.adjectives(value):
                    for word in words(name):
                        found.setdefault(singular(word), {})[owner] = None
        return found

    def _distinct(self, symbol: Symbol) -> str:
        """The name, with its kind where something else has it too."""
        return symbol.name if len(self._vocabulary.named(symbol.name)) == 1 else f"{symbol.kind}.{symbol.name}"
