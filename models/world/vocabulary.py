"""What formulas and phrases may speak of in one environment: symbols and propositional functions."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field
from functools import cached_property

from models.world.degrees import Degree, Scale, distances
from models.world.domain import Function
from models.world.grid import DIRECTIONS
from models.world.names import words
from models.world.phrase_index import PhraseIndex
from models.world.relations import Relations


@dataclass(frozen=True, slots=True)
class Symbol:
    """An object (its kind is its class) or an attribute value (its kind is the attribute type)."""

    kind: str
    name: str


@dataclass(frozen=True, eq=False)
class Vocabulary:
    """Symbols in a fixed order (objects, then values), their names, and the propositional functions."""

    objects: tuple[Symbol, ...]
    values: tuple[Symbol, ...]
    functions: Mapping[str, Function]
    synonyms: Mapping[Symbol, tuple[str, ...]]
    static: Mapping[Symbol, Mapping[str, Symbol]]  # an object's unchanging attributes; absent where it has none
    class_words: Mapping[str, tuple[str, ...]]
    state_kinds: Mapping[str, Mapping[str, tuple[str, ...]]] = field(default_factory=dict)
    """Per class the state attributes and the kinds of what they hold."""
    scales: Mapping[str, Scale] = field(default_factory=dict)
    """The attribute types whose values are ordered."""
    constants: tuple[Symbol, ...] = ()
    """The objects that every environment of the domain has."""

    @cached_property
    def phrases(self) -> PhraseIndex:
        """The symbols by what they are called and what can be said of them."""
        return PhraseIndex(self)

    @cached_property
    def relations(self) -> Relations:
        """How objects may stand to each other, as phrases say it."""
        return Relations(self)

    def comparing(self, said: tuple[str, ...]) -> Iterator[tuple[int, int, tuple[Degree, ...]]]:
        """The comparatives and superlatives among some words: place, how many words, and what each may ask for."""
        degrees = self._degrees
        for place in range(len(said)) if degrees else ():
            for length in range(min(self._longest_degree, len(said) - place), 0, -1):
                if (word := said[place : place + length]) in degrees:
                    yield place, length, degrees[word]

    @cached_property
    def _degrees(self) -> dict[tuple[str, ...], tuple[Degree, ...]]:
        found: dict[tuple[str, ...], tuple[Degree, ...]] = {}
        mapped = any(not DIRECTIONS.keys().isdisjoint(attributes) for attributes in self.static.values())
        for degrees in (*(scale.degrees for scale in self.scales.values()), distances() if mapped else {}):
            for said, degree in degrees.items():
                found[said] = (*found.get(said, ()), degree)
        return found

    @cached_property
    def _longest_degree(self) -> int:
        return max(map(len, self._degrees))

    @cached_property
    def _by_name(self) -> dict[str, tuple[Symbol, ...]]:
        by_name: dict[str, tuple[Symbol, ...]] = {}
        for symbol in self.symbols():
            by_name[symbol.name] = (*by_name.get(symbol.name, ()), symbol)
        return by_name

    @cached_property
    def _by_words(self) -> dict[tuple[str, ...], dict[Symbol, None]]:
        by_words: dict[tuple[str, ...], dict[Symbol, None]] = {}
        for symbol in self.symbols():
            for name in self.names(symbol):
                by_words.setdefault(words(name), {})[symbol] = None
        return by_words

    def symbols(self, *kinds: str) -> tuple[Symbol, ...]:
        """The symbols of the given kinds, or all."""
        every = (*self.objects, *self.values)
        return tuple(symbol for symbol in every if symbol.kind in kinds) if kinds else every

    def named(self, name: str) -> tuple[Symbol, ...]:
        """The symbols with exactly this name: none, one, or a homonym's several."""
        return self._by_name.get(name, ())

    def is_object(self, symbol: Symbol) -> bool:
        """Whether a symbol is an object, not an attribute value."""
        return symbol.kind in self.class_words

    def names(self, symbol: Symbol) -> tuple[str, ...]:
        """A symbol's name and synonyms."""
        return (symbol.name, *self.synonyms.get(symbol, ()))

    def adjectives(self, value: Symbol) -> tuple[str, ...]:
        """A value's names, and what else its scale calls it: "big" for the last of the sizes."""
        scale = self.scales.get(value.kind)
        return self.names(value) if scale is None else (*self.names(value), *scale.also_called(value.name))

    def loosely_named(self, name: str) -> tuple[Symbol, ...]:
        """The symbols with this name or synonym up to case, spaces and punctuation."""
        wanted = words(name)
        return tuple(self._by_words.get(wanted, ())) if wanted else ()
