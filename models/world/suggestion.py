"""What a phrase that names nothing is probably a misspelling of."""

from __future__ import annotations

import numpy as np

from models.world.environment import Environment
from models.world.names import closest, words
from models.world.phrase_index import spoken_words
from models.world.vocabulary import Symbol, Vocabulary

_ENOUGH = 0.7  # of SequenceMatcher.ratio: one letter in three letters is too much, one in four is not
_MOST = 3
_LONGEST = 100  # characters of a phrase compared
_MOST_COMPARED = 100  # names that could be close; in large environments only the most promising are looked at


def suggest(phrase: str, environment: Environment, *, kinds: frozenset[str] | None = None) -> tuple[str, ...]:
    """Up to three names or synonyms, of symbols of the given kinds if any, that the phrase is probably a misspelling
    of: closest first, equally close ones in the environment's order, each symbol once; empty if none is close.

    Case, punctuation and leading determiners do not matter, and attribute values before the last word ("small red
    cylindr") may be left out.
    """
    vocabulary = environment.vocabulary
    said = spoken_words(phrase)
    wanted = [" ".join(said)[:_LONGEST], " ".join(_without_values(said, vocabulary))[:_LONGEST]]
    named = vocabulary.phrases.named
    best: dict[Symbol, tuple[float, int, str]] = {}
    for text in dict.fromkeys(filter(None, wanted)):
        places = _promising(text, vocabulary, kinds)
        plain = [" ".join(named[place][2]) for place in places]
        for ratio, index in closest(text, plain, cutoff=_ENOUGH):
            symbol, name, _ = named[places[index]]
            if plain[index] != text and ratio > best.get(symbol, (0.0, 0, ""))[0]:  # the same is no misspelling
                best[symbol] = (ratio, -places[index], name)
    ranked = sorted(best.values(), reverse=True)
    return tuple(dict.fromkeys(name for _, _, name in ranked))[:_MOST]


def _promising(text: str, vocabulary: Vocabulary, kinds: frozenset[str] | None) -> list[int]:
    """The places in `PhraseIndex.named` of names that may be close enough to a text, in order."""
    bounds = vocabulary.phrases.letters.bounds(text)
    found = np.flatnonzero(bounds >= _ENOUGH)
    found = found[np.argsort(-bounds[found], kind="stable")]
    of_kind = (place for place in found.tolist() if kinds is None or vocabulary.phrases.named[place][0].kind in kinds)
    return sorted(place for place, _ in zip(of_kind, range(_MOST_COMPARED), strict=False))


def _without_values(said: tuple[str, ...], vocabulary: Vocabulary) -> tuple[str, ...]:
    values = {words(symbol.name) for symbol in vocabulary.values}
    return (*(word for word in said[:-1] if (word,) not in values), *said[-1:])
