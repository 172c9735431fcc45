"""What a text names in an environment: the ranges of words that are names or descriptions of its objects."""

from __future__ import annotations

from models.world.description import described, named
from models.world.environment import Environment
from models.world.phrase_index import DETERMINERS, Words

LONGEST = 6
"""Most words of a range."""
_EDGES = (
    "in",
    "into",
    "on",
    "onto",
    "at",
    "to",
    "from",
    "of",
    "off",
    "with",
    "by",
    "for",
    "is",
    "are",
    "which",
    "that",
    "and",
    "or",
    "then",
    "but",
)
NO_EDGE = DETERMINERS.union(_EDGES)
"""Words with which no phrase begins, and none ends that is not itself a name, such as "shelf a"."""


def mentions(said: Words, environment: Environment) -> tuple[tuple[int, int], ...]:
    """Half-open ranges of folded words that name objects as they are spelled, left to right: from each word on the
    longest, and none within another. Attribute values alone name none.
    """
    found: list[tuple[int, int]] = []
    begin = 0
    while begin < len(said):
        end = _end(said, begin, environment)
        if end is None:
            begin += 1
        else:
            found.append((begin, end))
            begin = end
    return tuple(found)


def _end(said: Words, begin: int, environment: Environment) -> int | None:
    if said[begin] in NO_EDGE:
        return None
    for end in range(min(begin + LONGEST, len(said)), begin, -1):
        phrase = said[begin:end]
        if _names(phrase, environment) if phrase[-1] not in NO_EDGE else _is_name(phrase, environment):
            return end
    return None


def _is_name(phrase: Words, environment: Environment) -> bool:
    """Whether it is an object's name to the letter."""
    return any(environment.vocabulary.is_object(symbol) for symbol in environment.vocabulary.phrases.called(phrase))


def _names(phrase: Words, environment: Environment) -> bool:
    vocabulary = environment.vocabulary
    symbols = named(phrase, vocabulary, None) or described(phrase, environment, None)
    return any(vocabulary.is_object(candidate.symbol) for candidate in symbols)
