"""Words that are one typing mistake away from a word."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from itertools import islice

MIN_LETTERS = 3
"""Shorter words are not known: one mistake makes any of them any other."""
MAX_LETTERS = 60
"""Nor are longer ones, whose comparison could take long."""
MAX_COMPARED = 4_096
"""Of more words that share a half, the others are not compared: no honest environment has so many."""
SHORT = 4
"""Words of so few letters must begin alike: "hall" is not a misspelt "ball"."""


class Spelling:
    """Known words, to look up those at Damerau-Levenshtein distance 1 (optimal string alignment): one letter too many,
    missing, or wrong, or two neighbours swapped. Words with anything but letters in them are left out: "box 12" is no
    misspelling of "box 13".

    One mistake leaves the first or the second half of a word as it was, so words of one length are kept by their
    halves, and only the few that share one are compared.
    """

    def __init__(self, known: Iterable[str]) -> None:
        self._by_length: dict[int, set[str]] = {}
        self._by_half: dict[int, dict[tuple[bool, str], list[str]]] = {}
        for word in known:
            if MIN_LETTERS <= len(word) <= MAX_LETTERS and word.isalpha():
                self._by_length.setdefault(len(word), set()).add(word)

    def near(self, word: str) -> tuple[str, ...]:
        """The known words at distance 1 of a word, in the order of the alphabet."""
        is_compared = word.isalpha() and MIN_LETTERS - 1 <= len(word) <= MAX_LETTERS + 1
        return tuple(sorted(set(self._near(word)))) if is_compared else ()

    def _near(self, word: str) -> Iterator[str]:
        for length in (len(word) - 1, len(word), len(word) + 1):
            if length in self._by_length:
                before, after = _halves(word, length)
                by_half = self._halved(length)
                for key in ((True, before), (False, after)):
                    compared = islice(by_half.get(key, ()), MAX_COMPARED)
                    yield from (known for known in compared if _is_one_mistake(word, known))

    def _halved(self, length: int) -> dict[tuple[bool, str], list[str]]:
        """The words of one length by their halves, made when they are first looked up."""
        if length not in self._by_half:
            found: dict[tuple[bool, str], list[str]] = {}
            for word in sorted(self._by_length[length]):
                before, after = _halves(word, length)
                found.setdefault((True, before), []).append(word)
                found.setdefault((False, after), []).append(word)
            self._by_half[length] = found
        return self._by_half[length]


def _halves(word: str, length: int) -> tuple[str, str]:
    """What a word shares with a known word of that length before and after a mistake in the other half.

    A mistake at or after letter `length // 2` leaves the letters before it, an earlier one the letters after the next,
    counted from the end.
    """
    middle = length // 2
    return word[:middle], word[len(word) - (length - middle - 1) :]


def _is_one_mistake(word: str, known: str) -> bool:
    if word == known or (max(len(word), len(known)) <= SHORT and word[0] != known[0]):
        return False
    at = next((i for i, (a, b) in enumerate(zip(word, known, strict=False)) if a != b), min(len(word), len(known)))
    if len(word) > len(known):
        return word[at + 1 :] == known[at:]
    if len(word) < len(known):
        return word[at:] == known[at + 1 :]
    swapped = word[at : at + 2] == known[at : at + 2][::-1] and word[at + 2 :] == known[at + 2 :]
    return swapped or word[at + 1 :] == known[at + 1 :]
