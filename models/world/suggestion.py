"""What a phrase that names nothing is probably a misspelling of."""

from __future__ import annotations

from collections.abc import Iterator
from itertools import islice

from models.world.environment import Environment
from models.world.grounding import spoken_words, symbols_of
from models.world.names import closest, words
from models.world.vocabulary import Symbol, Vocabulary

_ENOUGH = 0.7  # of SequenceMatcher.ratio: one letter in three letters is too much, one in four is not
_MOST = 3
_LONGEST = 100  # characters of a phrase compared
_MOST_NAMES = 20_000


def suggest(phrase: str, environment: Environment, *, kinds: frozenset[str] | None = None) -> tuple[str, ...]:
    """Up to three names or synonyms, of symbols of the given kinds if any, that the phrase is probably a misspelling
    of: closest first, equally close ones in the environment's order, each symbol once; empty if none is close.

    Case, punctuation and leading determiners do not matter, and attribute values before the last word ("small red
    cylindr") may be left out.
    """
    vocabulary = environment.vocabulary
    said = spoken_words(phrase)
    wanted = [" ".join(said)[:_LONGEST], " ".join(_without_values(said, vocabulary))[:_LONGEST]]
    best: dict[Symbol, tuple[float, int, str]] = {}
    named = list(islice(_names(symbols_of(vocabulary, kinds), vocabulary), _MOST_NAMES))
    plain = [" ".join(spoken_words(name)) for _, name in named]
    for text in dict.fromkeys(filter(None, wanted)):
        for ratio, index in closest(text, plain, cutoff=_ENOUGH):
            symbol, name = named[index]
            if plain[index] != text and ratio > best.get(symbol, (0.0, 0, ""))[0]:  # the same is no misspelling
                best[symbol] = (ratio, -index, name)
    ranked = sorted(best.values(), reverse=True)
    return tuple(dict.fromkeys(name for _, _, name in ranked))[:_MOST]


def _without_values(said: tuple[str, ...], vocabulary: Vocabulary) -> tuple[str, ...]:
    values = {words(symbol.name) for symbol in vocabulary.values}
    return (*(word for word in said[:-1] if (word,) not in values), *said[-1:])


def _names(symbols: tuple[Symbol, ...], vocabulary: Vocabulary) -> Iterator[tuple[Symbol, str]]:
    """All names before all synonyms, so that a limit leaves out synonyms first."""
    yield from ((symbol, symbol.name) for symbol in symbols)
    yield from ((symbol, synonym) for symbol in symbols for synonym in vocabulary.synonyms.get(symbol, ()))
