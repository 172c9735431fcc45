"""Words that compare: "the smaller one", "the biggest box", on attributes whose values are ordered."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass
from functools import cached_property

from models.world.names import words

Words = tuple[str, ...]
DISTANCE = ""
"""In the place of an attribute type: how far a thing is from the robot, on a map."""
_FAR = {"near": -1, "close": -1, "far": 1}
_VOWELS = "aeiou"
_IRREGULAR: Mapping[str, tuple[tuple[str, ...], tuple[str, ...]]] = {
    "good": (("better",), ("best",)),
    "well": (("better",), ("best",)),
    "bad": (("worse",), ("worst",)),
    "far": (("farther", "further"), ("farthest", "furthest")),
    "old": (("older", "elder"), ("oldest", "eldest")),
    "little": (("littler",), ("littlest",)),
}


@dataclass(frozen=True, slots=True)
class Degree:
    """What a word that compares asks for: values of an attribute type, towards the last (1) or the first (-1) of them,
    and whether the extreme is meant ("smallest") or whatever goes beyond another ("smaller").
    """

    kind: str
    direction: int
    superlative: bool


@dataclass(frozen=True)
class Scale:
    """An attribute type whose values are listed from the least to the most.

    `less` and `more` are further adjectives for the first and the last value: "little" and "big" for a size.
    """

    kind: str
    values: tuple[str, ...]
    less: tuple[str, ...] = ()
    more: tuple[str, ...] = ()

    @cached_property
    def ranks(self) -> Mapping[str, int]:
        """The place of each value."""
        return {value: rank for rank, value in enumerate(self.values)}

    @cached_property
    def degrees(self) -> Mapping[Words, Degree]:
        """What each comparative and superlative says; the adjective of a value right in the middle has none."""
        return _degrees(self.kind, self._adjectives())

    def also_called(self, value: str) -> tuple[str, ...]:
        """Further adjectives for a value."""
        last = self.more if value == self.values[-1] else ()
        return (*self.less, *last) if value == self.values[0] else last

    def _adjectives(self) -> Iterator[tuple[Words, int]]:
        for adjective in self.less:
            yield words(adjective), -1
        for adjective in self.more:
            yield words(adjective), 1
        for rank, value in enumerate(self.values):
            beyond = 2 * rank - (len(self.values) - 1)
            if beyond:
                yield words(value), 1 if beyond > 0 else -1


def distances() -> Mapping[Words, Degree]:
    """What "nearest", "closer" and the like say."""
    return _degrees(DISTANCE, (((adjective,), direction) for adjective, direction in _FAR.items()))


def _degrees(kind: str, adjectives: Iterable[tuple[Words, int]]) -> dict[Words, Degree]:
    """The comparatives and superlatives of adjectives, each with the end of the scale that it is for."""
    found: dict[Words, Degree] = {}
    for adjective, direction in adjectives:
        comparatives, superlatives = forms(adjective)
        for said in comparatives:
            found.setdefault(said, Degree(kind, direction, superlative=False))
        for said in superlatives:
            found.setdefault(said, Degree(kind, direction, superlative=True))
        found.setdefault(("less", *adjective), Degree(kind, -direction, superlative=False))
        found.setdefault(("least", *adjective), Degree(kind, -direction, superlative=True))
    return found


def forms(adjective: Words) -> tuple[list[Words], list[Words]]:
    """The comparatives and the superlatives of an English adjective: `small` -> `smaller`, `more small`; `smallest`,
    `most small`. Both are given for any adjective: nothing is lost by what nobody says.
    """
    comparatives, superlatives = [("more", *adjective)], [("most", *adjective)]
    if len(adjective) == 1 and adjective[0]:
        word = adjective[0]
        stem = _stem(word)
        irregular = _IRREGULAR.get(word, ((f"{stem}er",), (f"{stem}est",)))
        comparatives += [(form,) for form in irregular[0]]
        superlatives += [(form,) for form in irregular[1]]
    return comparatives, superlatives


def _stem(word: str) -> str:
    """What `-er` and `-est` are put on: `big` -> `bigg`, `heavy` -> `heavi`, `large` -> `larg`."""
    if word.endswith("e"):
        return word[:-1]
    if len(word) > 2 and word.endswith("y") and word[-2] not in _VOWELS:
        return f"{word[:-1]}i"
    short = len(word) > 2 and word[-3] not in _VOWELS and word[-2] in _VOWELS and word[-1] not in f"{_VOWELS}wxy"
    return word + word[-1] if short and sum(letter in _VOWELS for letter in word) == 1 else word
