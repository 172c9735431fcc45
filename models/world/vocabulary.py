"""What formulas and phrases may speak of in one environment: symbols and propositional functions."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field

from models.world.domain import Function


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
    _by_name: Mapping[str, tuple[Symbol, ...]] = field(init=False, repr=False)

    def __post_init__(self) -> None:
        by_name: dict[str, tuple[Symbol, ...]] = {}
        for symbol in self.symbols():
            by_name[symbol.name] = (*by_name.get(symbol.name, ()), symbol)
        object.__setattr__(self, "_by_name", by_name)

    def symbols(self, *kinds: str) -> tuple[Symbol, ...]:
        """The symbols of the given kinds, or all."""
        every = (*self.objects, *self.values)
        return tuple(symbol for symbol in every if symbol.kind in kinds) if kinds else every

    def named(self, name: str) -> tuple[Symbol, ...]:
        """The symbols with exactly this name: none, one, or a homonym's several."""
        return self._by_name.get(name, ())
