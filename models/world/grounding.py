"""Phrases of a command to the symbols of an environment: one, several with why, or none.

A phrase is tried in three ways, and the first that finds something decides:

1. it is the name of a symbol, or a synonym of one ("cylinder", "the H&M", "orange");
2. the same, but for a plural ("the cylinders");
3. it describes objects: a head noun (the end of a name or synonym, the class, "one") with attribute values and
   further words of the name in any order ("the small red bucket", "toy that is red", "red").

Kinds narrow all three. Where kinds leave both a value and an object with the name, the part of speech
decides: an adjective is a value, a noun an object.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable
from dataclasses import dataclass
from typing import Literal

from models.world.environment import Environment
from models.world.names import listing, singular, words
from models.world.vocabulary import Symbol, Vocabulary

PartOfSpeech = Literal["noun", "adjective"]
_DETERMINERS = frozenset(words("the a an this that these those my your his her its our their some"))
_FILLERS = _DETERMINERS | frozenset(words("which is are and with of in color colored shaped sized"))
_GENERIC = frozenset({"one", "thing", "object", "item"})
_LONGEST = 20  # words


@dataclass(frozen=True, slots=True)
class Candidate:
    """A symbol that a phrase may mean, and why, for people."""

    symbol: Symbol
    reason: str


@dataclass(frozen=True, slots=True)
class Grounding:
    """What a phrase may mean; the candidates are in the environment's order of symbols."""

    phrase: str
    candidates: tuple[Candidate, ...]


def ground(
    phrase: str,
    environment: Environment,
    *,
    kinds: frozenset[str] | None = None,
    pos: PartOfSpeech | None = None,
) -> Grounding:
    """The symbols, of the given kinds if any, that a phrase may mean."""
    vocabulary = environment.vocabulary
    spoken = spoken_words(phrase)
    if not spoken or len(spoken) > _LONGEST:
        return Grounding(phrase, ())
    symbols = symbols_of(vocabulary, kinds)
    for compare in (_same, _same_singular):
        found = _called(spoken, symbols, vocabulary, compare)
        if found:
            return Grounding(phrase, _decided(found, vocabulary, pos))
    typed = [Candidate(s, _name_reason(s, vocabulary)) for s in symbols if _is_typed_value(spoken, s, vocabulary)]
    return Grounding(phrase, tuple(typed or _described(spoken, symbols, vocabulary)))


def spoken_words(phrase: str) -> tuple[str, ...]:
    """The words of a phrase without leading determiners, unless nothing else is left."""
    all_words = words(phrase[:1_000])
    start = next((i for i, word in enumerate(all_words) if word not in _DETERMINERS), 0)
    return all_words[start:]


def symbols_of(vocabulary: Vocabulary, kinds: frozenset[str] | None) -> tuple[Symbol, ...]:
    """The symbols of some kinds, or all for None."""
    return () if kinds is not None and not kinds else vocabulary.symbols(*(kinds or ()))


def _same(left: Iterable[str], right: Iterable[str]) -> bool:
    return tuple(left) == tuple(right)


def _same_singular(left: Iterable[str], right: Iterable[str]) -> bool:
    return [singular(word) for word in left] == [singular(word) for word in right]


def _called(
    spoken: tuple[str, ...],
    symbols: Iterable[Symbol],
    vocabulary: Vocabulary,
    compare: Callable[[Iterable[str], Iterable[str]], bool],
) -> list[Candidate]:
    """The symbols with this name or synonym. Both count alike: who gives a synonym wants it understood."""
    found: list[Candidate] = []
    for symbol in symbols:
        if compare(spoken_words(symbol.name), spoken):
            found.append(Candidate(symbol, _name_reason(symbol, vocabulary)))
            continue
        synonyms = vocabulary.synonyms.get(symbol, ())
        synonym = next((other for other in synonyms if compare(spoken_words(other), spoken)), None)
        if synonym is not None:
            found.append(Candidate(symbol, f"{synonym} is a synonym of {symbol.name}"))
    return found


def _name_reason(symbol: Symbol, vocabulary: Vocabulary) -> str:
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


def _is_typed_value(spoken: tuple[str, ...], symbol: Symbol, vocabulary: Vocabulary) -> bool:
    """Whether the phrase is a value with its type: "the color red", "red color"."""
    if vocabulary.is_object(symbol):
        return False
    kind, name = words(symbol.kind), words(symbol.name)
    return spoken in ((*kind, *name), (*name, *kind))


def _described(spoken: tuple[str, ...], symbols: Iterable[Symbol], vocabulary: Vocabulary) -> list[Candidate]:
    content = [singular(word) for word in spoken if word not in _FILLERS]
    described = [_describe(content, s, vocabulary) for s in symbols if content and vocabulary.is_object(s)]
    return [candidate for candidate in described if candidate is not None]


def _describe(content: list[str], symbol: Symbol, vocabulary: Vocabulary) -> Candidate | None:
    """The object as a candidate if every word of the phrase says something of it, and one of them more than "small".

    What a word may say: an attribute's value, the class, part of a name that the phrase has the head noun (the last
    word) of, or nothing much ("one").
    """
    values = {
        attribute: value.name
        for attribute, value in vocabulary.static.get(symbol, {}).items()
        if not vocabulary.is_object(value) and _contains(content, _stems(value.name))
    }
    explained = {word for value in values.values() for word in _stems(value)}
    rest = {word for word in content if word not in explained}
    nouns = rest & {_stems(word)[-1] for word in vocabulary.class_words.get(symbol.kind, ()) if _stems(word)}
    rest -= nouns | _GENERIC
    names = [_stems(name) for name in vocabulary.names(symbol)]
    named = any(name and name[-1] in content and rest <= set(name) for name in names)
    if (rest and not named) or not (values or nouns or named):
        return None
    return Candidate(symbol, _description(symbol, values, by_name=named and bool(rest or not (values or nouns))))


def _stems(text: str) -> list[str]:
    return [singular(word) for word in words(text)]


def _contains(spoken: list[str], trait: list[str]) -> bool:
    return any(spoken[start : start + len(trait)] == trait for start in range(len(spoken) - len(trait) + 1))


def _description(symbol: Symbol, values: dict[str, str], *, by_name: bool) -> str:
    kind = symbol.kind.replace("_", " ")
    named = f" named {symbol.name}" if by_name else ""
    if not values:
        return f"a {kind}{named}"
    said = listing((f"{attribute.replace('_', ' ')} is {value}" for attribute, value in values.items()), "and")
    return f"a {kind}{named} whose {said}"
