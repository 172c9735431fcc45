"""An environment's names, arranged so that a phrase finds its symbols without a look at all of them."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping
from dataclasses import dataclass, replace
from functools import cached_property, lru_cache
from itertools import chain
from typing import TYPE_CHECKING

from models.world.letters import LetterCounts
from models.world.names import singular, words
from models.world.spelling import Spelling

if TYPE_CHECKING:
    from models.world.vocabulary import Symbol, Vocabulary

DETERMINERS = frozenset(words("the teh a an this that these those my your his her its our their some"))
""" "teh" is how "the" comes out in haste."""
WHATEVER = "*"
"""Stands for "thing" in "anything": a word that nobody can say, so that no name is taken for it."""
MAX_CORRECTED = 8
"""Most words of a phrase that is searched for a typing mistake."""
Words = tuple[str, ...]


@dataclass(frozen=True, slots=True)
class Traits:
    """What words may say of one object, all in the singular.

    `values` are its attributes' values, as attribute, value and the value's words; `nouns` the last words of what its
    class is called; `names` the words of each of its names and synonyms, by their last word, the head noun.
    """

    values: tuple[tuple[str, str, Words], ...]
    nouns: frozenset[str]
    names: Mapping[str, tuple[frozenset[str], ...]]


@dataclass(frozen=True, slots=True)
class Correction:
    """A phrase with a typing mistake put right: what was `wrong` in it, and what was `meant`."""

    spoken: Words
    wrong: str
    meant: str


class PhraseIndex:
    """The symbols of a vocabulary by what they are called and by what can be said of them.

    Every lookup gives symbols in the vocabulary's order. Each part is made when it is first asked for.
    """

    def __init__(self, vocabulary: Vocabulary) -> None:
        self._vocabulary = vocabulary
        self._traits: dict[Symbol, Traits] = {}
        self.corrections = lru_cache(maxsize=256)(self._corrections)  # several readings of a command share phrases

    def called(self, spoken: Words) -> Mapping[Symbol, str]:
        """The symbols with these words for a name or synonym, each with the first name that is so."""
        return self._called.get(spoken, {})

    def called_singular(self, spoken: Words) -> Mapping[Symbol, str]:
        """As `called`, for plurals and singulars alike."""
        return self._called_singular.get(_singulars(spoken), {})

    def typed_values(self, spoken: Words) -> Iterable[Symbol]:
        """The attribute values of which the words are name and type: "color red", "red color"."""
        return self._typed.get(spoken, ())

    def described(
        self, stems: Iterable[str], more: Iterable[str], valued: Callable[[str], Mapping[Symbol, None]]
    ) -> Iterable[Symbol]:
        """The objects of which each of the stems can say something; without stems, at least one of `more`.

        `valued` gives the objects of which a stem says something now, besides what it says of them at any time.
        """
        found = sorted(({**self._by_trait.get(stem, {}), **valued(stem)} for stem in set(stems)), key=len)
        if found:
            first, *others = found
            return (symbol for symbol in first if all(symbol in other for other in others))
        some = {symbol for stem in more for symbol in self._by_trait.get(stem, ())}
        return [symbol for symbol in self._vocabulary.objects if symbol in some] if some else ()

    def traits(self, symbol: Symbol, values: Mapping[str, Symbol]) -> Traits:
        """What words may say of an object that has some values now, besides those that never change."""
        if symbol not in self._traits:
            self._traits[symbol] = self._traits_of(symbol)
        traits = self._traits[symbol]
        return replace(traits, values=(*traits.values, *self._said(values))) if values else traits

    def _corrections(self, spoken: Words) -> tuple[Correction, ...]:
        """The phrases that these words may be with one typing mistake; none of a phrase of very many words.

        A mistake is in one word of three or more letters, or in the spaces: "cofee shop", "coffeeshop", "cof fee shop".
        """
        if len(spoken) > MAX_CORRECTED:
            return ()
        found = []
        joined = "".join(spoken)
        for near in (joined, *self._joined_spelling.near(joined)):
            for name in self._joined.get(near, ()):
                if name != spoken:
                    found.append(Correction(name, " ".join(spoken), " ".join(name)))
        for position, word in enumerate(spoken):
            for near in dict.fromkeys((*self._spelling.near(word), *self._spelling.near(singular(word)))):
                if near != word:
                    corrected = (*spoken[:position], near, *spoken[position + 1 :])
                    found.append(Correction(corrected, word, near))
        return tuple(found)

    @cached_property
    def named(self) -> tuple[tuple[Symbol, str, Words], ...]:
        """Every symbol with each of its names and synonyms, as it is written and as words."""
        symbols = self._vocabulary.symbols()
        names = ((symbol, name) for symbol in symbols for name in self._vocabulary.names(symbol))
        return tuple((symbol, name, spoken) for symbol, name in names if (spoken := spoken_words(name)))

    @cached_property
    def letters(self) -> LetterCounts:
        """The letters of each of `named`, its words joined by single spaces."""
        return LetterCounts([" ".join(spoken) for _, _, spoken in self.named])

    @cached_property
    def _called(self) -> dict[Words, dict[Symbol, str]]:
        found: dict[Words, dict[Symbol, str]] = {}
        for symbol, name, spoken in self.named:
            found.setdefault(spoken, {}).setdefault(symbol, name)
        return found

    @cached_property
    def _called_singular(self) -> dict[Words, dict[Symbol, str]]:
        found: dict[Words, dict[Symbol, str]] = {}
        for symbol, name, spoken in self.named:
            found.setdefault(_singulars(spoken), {}).setdefault(symbol, name)
        return found

    @cached_property
    def _typed(self) -> dict[Words, list[Symbol]]:
        found: dict[Words, list[Symbol]] = {}
        for symbol in self._vocabulary.values:
            kind, name = words(symbol.kind), words(symbol.name)
            for spoken in {(*kind, *name), (*name, *kind)}:
                found.setdefault(spoken, []).append(symbol)
        return found

    @cached_property
    def _by_trait(self) -> dict[str, dict[Symbol, None]]:
        found: dict[str, dict[Symbol, None]] = {}
        nouns = {kind: self._nouns(kind) for kind in self._vocabulary.class_words}
        names: dict[Symbol, set[str]] = {symbol: set() for symbol in self._vocabulary.symbols()}
        for symbol, _, spoken in self.named:
            names[symbol].update(map(singular, spoken))
        for symbol in self._vocabulary.objects:
            for stem in names[symbol].union(nouns[symbol.kind], *(stems for _, _, stems in self._values(symbol))):
                found.setdefault(stem, {})[symbol] = None
        return found

    @cached_property
    def _joined(self) -> dict[str, list[Words]]:
        """Names without their spaces. Those with digits are left out: "cell 1 12" is not "cell 11 2"."""
        found: dict[str, list[Words]] = {}
        for spoken in self._called:
            if (joined := "".join(spoken)).isalpha():
                found.setdefault(joined, []).append(spoken)
        return found

    @cached_property
    def _joined_spelling(self) -> Spelling:
        return Spelling(self._joined)

    @cached_property
    def _spelling(self) -> Spelling:
        nouns = (words(noun) for nouns in self._vocabulary.class_words.values() for noun in nouns)
        degrees = (said for scale in self._vocabulary.scales.values() for said in scale.degrees if len(said) == 1)
        return Spelling(word for spoken in chain(self._called, nouns, degrees) for word in spoken)

    def _traits_of(self, symbol: Symbol) -> Traits:
        names: dict[str, list[frozenset[str]]] = {}
        for name in self._vocabulary.names(symbol):
            if stems := _singulars(spoken_words(name)):
                names.setdefault(stems[-1], []).append(frozenset(stems))
        by_head = {head: tuple(found) for head, found in names.items()}
        return Traits(tuple(self._values(symbol)), self._nouns(symbol.kind), by_head)

    def _values(self, symbol: Symbol) -> Iterator[tuple[str, str, Words]]:
        yield from self._said(self._vocabulary.static.get(symbol, {}))

    def _said(self, attributes: Mapping[str, Symbol]) -> Iterator[tuple[str, str, Words]]:
        for attribute, value in attributes.items():
            if not self._vocabulary.is_object(value):
                for name in self._vocabulary.adjectives(value):
                    yield attribute, value.name, _singulars(words(name))

    def _nouns(self, kind: str) -> frozenset[str]:
        called = (words(word) for word in self._vocabulary.class_words.get(kind, ()))
        return frozenset(singular(spoken[-1]) for spoken in called if spoken)


def spoken_words(phrase: str) -> Words:
    """The words of a phrase without leading determiners, unless nothing else is left."""
    said = words(phrase[:1_000])
    if not said or said[0] not in DETERMINERS:
        return said
    return said[next((place for place, word in enumerate(said) if word not in DETERMINERS), 0) :]


def _singulars(spoken: Words) -> Words:
    return tuple(map(singular, spoken))
