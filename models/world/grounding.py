"""Phrases of a command to the symbols of an environment: one, several with why, or none.

A phrase is tried in four ways, and the first that finds something decides:

1. it is the name of a symbol, or a synonym of one ("cylinder", "the H&M", "orange");
2. the same, but for a plural ("the cylinders");
3. it describes objects: a head noun (the end of a name or synonym, the class, "one") with attribute values and
   further words of the name in any order ("the small red bucket", "toy that is red", "red");
4. one word is misspelt by one letter, or a space is wrong, and the phrase so corrected is one of the above ("sphree").

Kinds narrow all four. What means something of another kind as it stands is no misspelling: with a cart and a card at
hand, "card" is never read as "cart". Where kinds leave both a value and an object with the name, the part of speech
decides: an adjective is a value, a noun an object.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable
from dataclasses import dataclass, replace
from typing import Literal

from models.world.environment import Environment
from models.world.names import listing, singular, words
from models.world.phrase_index import DETERMINERS, Traits, Words, spoken_words
from models.world.vocabulary import Symbol, Vocabulary

PartOfSpeech = Literal["noun", "adjective"]
Kinds = frozenset[str]
_FILLERS = DETERMINERS | frozenset(words("which is are and with of in color colored shaped sized"))
_GENERIC = frozenset({"one", "thing", "object", "item"})
_LONGEST = 20  # words
Read = Callable[[Words, Vocabulary, Kinds | None], list["Candidate"]]
"""A way to take words by their letters."""


@dataclass(frozen=True, slots=True)
class Candidate:
    """A symbol that a phrase may mean, and why, for people; `misspelt` is what was taken for a typing mistake."""

    symbol: Symbol
    reason: str
    misspelt: str | None = None


@dataclass(frozen=True, slots=True)
class Grounding:
    """What a phrase may mean; the candidates are in the environment's order of symbols."""

    phrase: str
    candidates: tuple[Candidate, ...]


def ground(
    phrase: str,
    environment: Environment,
    *,
    kinds: Kinds | None = None,
    pos: PartOfSpeech | None = None,
) -> Grounding:
    """The symbols, of the given kinds if any, that a phrase may mean; none of a phrase of more than 20 words."""
    vocabulary = environment.vocabulary
    spoken = spoken_words(phrase)
    if not spoken or len(spoken) > _LONGEST:
        return Grounding(phrase, ())
    for read in (_named, _described):
        if found := read(spoken, vocabulary, kinds):
            return Grounding(phrase, _decided(found, vocabulary, pos))
    if kinds is not None and any(read(spoken, vocabulary, None) for read in (_named, _described)):
        return Grounding(phrase, ())
    for read in (_named, _described):
        if found := _corrected(read, spoken, vocabulary, kinds):
            return Grounding(phrase, _decided(found, vocabulary, pos))
    return Grounding(phrase, ())


def _named(spoken: Words, vocabulary: Vocabulary, kinds: Kinds | None) -> list[Candidate]:
    """The symbols with this name or synonym. Both count alike: who gives a synonym wants it understood."""
    phrases = vocabulary.phrases
    for called in (phrases.called(spoken), phrases.called_singular(spoken)):
        symbols = _of_kinds(called, kinds)
        if symbols:
            return [Candidate(symbol, _name_reason(symbol, called[symbol], vocabulary)) for symbol in symbols]
    return []


def _corrected(read: Read, spoken: Words, vocabulary: Vocabulary, kinds: Kinds | None) -> list[Candidate]:
    """What the words mean with one typing mistake put right, in every way that makes sense."""
    found: dict[Symbol, Candidate] = {}
    for correction in vocabulary.phrases.corrections(spoken):
        if correction.wrong not in _FILLERS | _GENERIC:
            for candidate in read(correction.spoken, vocabulary, kinds):
                reason = f'{candidate.reason}, reading "{correction.wrong}" as "{correction.meant}"'
                found.setdefault(candidate.symbol, replace(candidate, reason=reason, misspelt=correction.wrong))
    if len(found) < 2:
        return list(found.values())
    return [found[symbol] for symbol in vocabulary.symbols() if symbol in found]


def _of_kinds(symbols: Iterable[Symbol], kinds: Kinds | None) -> list[Symbol]:
    return [symbol for symbol in symbols if kinds is None or symbol.kind in kinds]


def _name_reason(symbol: Symbol, called: str, vocabulary: Vocabulary) -> str:
    if called != symbol.name:
        return f"{called} is a synonym of {symbol.name}"
    kind = symbol.kind.replace("_", " ")
    return f"a {kind} named {symbol.name}" if vocabulary.is_object(symbol) else f"the {kind} {symbol.name}"


def _decided(found: list[Candidate], vocabulary: Vocabulary, pos: PartOfSpeech | None) -> tuple[Candidate, ...]:
    values = [candidate for candidate in found if not vocabulary.is_object(candidate.symbol)]
    objects = [candidate for candidate in found if vocabulary.is_object(candidate.symbol)]
    if pos == "adjective" and values:
        return tuple(values)
    if pos == "noun" and objects:
        return tuple(objects)
    return (*objects, *values)


def _described(spoken: Words, vocabulary: Vocabulary, kinds: Kinds | None) -> list[Candidate]:
    """The values that the words name with their type, else the objects of which they are a description."""
    typed = _of_kinds(vocabulary.phrases.typed_values(spoken), kinds)
    if typed:
        return [Candidate(symbol, _name_reason(symbol, symbol.name, vocabulary)) for symbol in typed]
    content = [singular(word) for word in spoken if word not in _FILLERS]
    phrases = vocabulary.phrases
    symbols = _of_kinds(phrases.described([word for word in content if word not in _GENERIC], content), kinds)
    described = [_describe(content, symbol, phrases.traits(symbol)) for symbol in symbols]
    return [candidate for candidate in described if candidate is not None]


def _describe(content: list[str], symbol: Symbol, traits: Traits) -> Candidate | None:
    """The object as a candidate if every word of the phrase says something of it, and one of them more than "one".

    What a word may say: an attribute's value, the class, part of a name that the phrase has the head noun (the last
    word) of, or nothing much ("one").
    """
    said = [(attribute, value, stems) for attribute, value, stems in traits.values if _contains(content, stems)]
    rest = set(content).difference(*(stems for _, _, stems in said))
    nouns = rest & traits.nouns
    rest -= nouns | _GENERIC
    plain = bool(said or nouns)
    by_name = not (plain and not rest) and any(rest <= name for word in content for name in traits.names.get(word, ()))
    if not by_name and (rest or not plain):
        return None
    return Candidate(symbol, _description(symbol, [(attribute, value) for attribute, value, _ in said], by_name))


def _contains(content: list[str], stems: Words) -> bool:
    return any(tuple(content[start : start + len(stems)]) == stems for start in range(len(content) - len(stems) + 1))


def _description(symbol: Symbol, values: list[tuple[str, str]], by_name: bool) -> str:
    kind = symbol.kind.replace("_", " ")
    named = f" named {symbol.name}" if by_name else ""
    if not values:
        return f"a {kind}{named}"
    said = listing((f"{attribute.replace('_', ' ')} is {value}" for attribute, value in values), "and")
    return f"a {kind}{named} whose {said}"
