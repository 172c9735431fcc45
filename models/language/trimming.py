"""Arguments without the words that belong to no name: "guard the gallery" where there is a gallery.

A name may be longer than what a translator has seen, so it may take in too much: a verb that it does not know, an
adverb, a misspelt article. Where that means nothing, and a name that the environment has is left once such words are
taken away, that name is meant.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import replace

from models.language.tokens import words
from models.language.translation import Translation
from models.queries import Composition, Query
from models.world import Environment, mentions
from models.world.mentions import NO_EDGE
from models.world.phrase_index import DETERMINERS

LESS = 0.5
"""Factor for a translation that was trimmed."""


def trimmed(translations: Iterable[Translation], environment: Environment, saying: frozenset[str]) -> list[Translation]:
    """The translations of which an argument could be trimmed, likeliest first.

    Args:
        saying: words that say what to do and not with what; they may follow a name ("the zoo sometime today").
    """
    found: dict[Query, float] = {}
    for translation in translations:
        query = _query(translation.query, environment, saying)
        if query != translation.query:
            found[query] = found.get(query, 0.0) + LESS * translation.confidence
    ranked = sorted(found, key=lambda query: (-found[query], str(query)))
    return [Translation(query, min(1.0, found[query])) for query in ranked]


def _query(query: Query, environment: Environment, saying: frozenset[str]) -> Query:
    if isinstance(query, Composition):
        return replace(query, operands=tuple(_query(operand, environment, saying) for operand in query.operands))
    return replace(query, arguments=tuple(_argument(phrase, environment, saying) for phrase in query.arguments))


def _argument(phrase: str, environment: Environment, saying: frozenset[str]) -> str:
    """The one name in a phrase, if all around it may go; else the phrase."""
    said = words(phrase)
    named = mentions(said, environment)
    if len(named) != 1 or named == ((0, len(said)),):
        return phrase
    ((begin, end),) = named
    before, after = said[:begin], said[end:]
    verb = before[:-1]
    if before and (not _is_article(before[-1]) or len(verb) > 1 or not NO_EDGE.isdisjoint(verb)):
        return phrase  # "the statue in the park" is not the park
    return " ".join(said[begin:end]) if saying.issuperset(after) else phrase


def _is_article(word: str) -> bool:
    """Whether a word tells that a name begins, even if its letters are out of order ("teh")."""
    return word in DETERMINERS or sorted(word) == sorted("the")
