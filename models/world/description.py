"""What words say of an object, and the objects of which a phrase is a description."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass

from models.world.environment import Environment
from models.world.names import listing, singular, words
from models.world.phrase_index import DETERMINERS, WHATEVER, Traits, Words
from models.world.vocabulary import Symbol, Vocabulary

Kinds = frozenset[str]
FILLERS = DETERMINERS | frozenset(words("which is are and with of in color colored shaped sized"))
GENERIC = frozenset({"one", "thing", "object", "item", WHATEVER})


@dataclass(frozen=True, slots=True)
class Candidate:
    """A symbol that a phrase may mean, and why, for people; `misspelt` is what was taken for a typing mistake."""

    symbol: Symbol
    reason: str
    misspelt: str | None = None


def named(spoken: Words, vocabulary: Vocabulary, kinds: Kinds | None) -> list[Candidate]:
    """The symbols with this name or synonym. Both count alike: who gives a synonym wants it understood."""
    phrases = vocabulary.phrases
    for called in (phrases.called(spoken), phrases.called_singular(spoken)):
        symbols = of_kinds(called, kinds)
        if symbols:
            return [Candidate(symbol, _name_reason(symbol, called[symbol], vocabulary)) for symbol in symbols]
    return []


def described(spoken: Words, environment: Environment, kinds: Kinds | None) -> list[Candidate]:
    """The values that the words name with their type, else the objects of which they are a description."""
    vocabulary, situation = environment.vocabulary, environment.situation
    phrases = vocabulary.phrases
    typed = of_kinds(phrases.typed_values(spoken), kinds)
    if typed:
        return [Candidate(symbol, _name_reason(symbol, symbol.name, vocabulary)) for symbol in typed]
    content = [singular(word) for word in spoken if word not in FILLERS]
    wanted = [word for word in content if word not in GENERIC]
    symbols = of_kinds(phrases.described(wanted, content, situation.valued), kinds)
    found = [_describe(content, symbol, phrases.traits(symbol, situation.values(symbol))) for symbol in symbols]
    return [candidate for candidate in found if candidate is not None]


def anything(environment: Environment, kinds: Kinds | None) -> list[Candidate]:
    """Every object of the kinds."""
    return [Candidate(symbol, with_article(symbol.kind)) for symbol in of_kinds(environment.vocabulary.objects, kinds)]


def of_kinds(symbols: Iterable[Symbol], kinds: Kinds | None) -> list[Symbol]:
    """The symbols of the kinds, or all."""
    return [symbol for symbol in symbols if kinds is None or symbol.kind in kinds]


def _name_reason(symbol: Symbol, called: str, vocabulary: Vocabulary) -> str:
    if called != symbol.name:
        return f"{called} is a synonym of {symbol.name}"
    kind = _spoken(symbol.kind)
    return (
        f"{with_article(symbol.kind)} named {symbol.name}"
        if vocabulary.is_object(symbol)
        else f"the {kind} {symbol.name}"
    )


def _describe(content: list[str], symbol: Symbol, traits: Traits) -> Candidate | None:
    """The object as a candidate if every word of the phrase says something of it, and one of them more than "one".

    What a word may say: an attribute's value, the class, part of a name that the phrase has the head noun (the last
    word) of, or nothing much ("one").
    """
    said = [(attribute, value, stems) for attribute, value, stems in traits.values if _contains(content, stems)]
    rest = set(content).difference(*(stems for _, _, stems in said))
    nouns = rest & traits.nouns
    rest -= nouns | GENERIC
    plain = bool(said or nouns)
    by_name = not (plain and not rest) and any(rest <= name for word in content for name in traits.names.get(word, ()))
    if not by_name and (rest or not plain):
        return None
    return Candidate(symbol, _description(symbol, [(attribute, value) for attribute, value, _ in said], by_name))


def _contains(content: list[str], stems: Words) -> bool:
    return any(tuple(content[start : start + len(stems)]) == stems for start in range(len(content) - len(stems) + 1))


def _description(symbol: Symbol, values: list[tuple[str, str]], by_name: bool) -> str:
    called = f" named {symbol.name}" if by_name else ""
    if not values:
        return f"{with_article(symbol.kind)}{called}"
    said = listing(dict.fromkeys(f"{_spoken(attribute)} is {value}" for attribute, value in values), "and")
    return f"{with_article(symbol.kind)}{called} whose {said}"


def with_article(kind: str) -> str:
    """A kind with its article, by the letter that it begins with: "an appliance"."""
    spoken = _spoken(kind)
    return f"an {spoken}" if spoken[:1].lower() in "aeiou" else f"a {spoken}"


def _spoken(name: str) -> str:
    return name.replace("_", " ")
