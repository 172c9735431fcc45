"""Names parted in two so that no word stands in both parts: six tenths for training, the rest held out."""

from __future__ import annotations

import zlib
from collections.abc import Collection, Iterable, Mapping, Sequence

from models.language.dataset.half import Half

TRAINING = 0.6
"""The share of the names that training gets."""
SWEEPS = 50
"""Most passes over the words; each takes a word to the part where more names can be kept."""

Names = Mapping[str, Sequence[str]]
"""Names by list."""


def content_words(name: str, functions: Collection[str]) -> tuple[str, ...]:
    """The words of a name, parted at spaces and hyphens, less those such as "of"."""
    return tuple(word for word in name.replace("-", " ").split() if word not in functions)


def part_names(
    lists: Names, *, functions: Collection[str] = (), fixed: Mapping[str, Half] | None = None
) -> dict[Half, dict[str, tuple[str, ...]]]:
    """The names by part and list, in alphabetical order; a name whose words fall in both parts is dropped.

    Every word starts in a part that its letters decide, or in the one it is fixed to. Then words move one at a time,
    as long as that keeps more names or brings a list closer to the shares of the parts. Always the same for the same
    names.
    """
    parting = _Parting(lists, functions, fixed or {})
    for _ in range(SWEEPS):
        improved = [parting.improve(word) for word in parting.free]
        if not any(improved):
            break
    return {
        half: {key: tuple(n for n in sorted(set(names)) if parting.part(n) is half) for key, names in lists.items()}
        for half in Half
    }


class _Parting:
    """The part of every word so far, and the names that have each."""

    def __init__(self, lists: Names, functions: Collection[str], fixed: Mapping[str, Half]) -> None:
        self._words = {name: content_words(name, functions) for names in lists.values() for name in names}
        self._named: dict[str, list[tuple[str, str]]] = {}
        for key, names in lists.items():
            for name in sorted(set(names)):
                for word in self._words[name]:
                    self._named.setdefault(word, []).append((key, name))
        self._parts = {word: fixed.get(word, _start(word)) for word in self._named}
        self.free = sorted(set(self._named) - set(fixed), key=lambda word: (-len(self._named[word]), word))
        self._counts = {(key, half): 0 for key in lists for half in Half}
        self._count(((key, name) for key, names in lists.items() for name in set(names)), 1)

    def part(self, name: str) -> Half | None:
        """The part of all words of a name; None when they differ."""
        parts = {self._parts[word] for word in self._words[name]}
        return parts.pop() if len(parts) == 1 else None

    def improve(self, word: str) -> bool:
        """Take a word to the other part if that is better; whether it was."""
        before = self._value()
        self._move(word)
        if self._value() > before:
            return True
        self._move(word)
        return False

    def _move(self, word: str) -> None:
        self._count(self._named[word], -1)
        self._parts[word] = Half.HELD_OUT if self._parts[word] is Half.TRAINING else Half.TRAINING
        self._count(self._named[word], 1)

    def _count(self, names: Iterable[tuple[str, str]], change: int) -> None:
        for key, name in names:
            half = self.part(name)
            if half is not None:
                self._counts[key, half] += change

    def _value(self) -> float:
        """Names kept, less how many a list has too many of in one part."""
        value = 0.0
        for key in {key for key, _ in self._counts}:
            training, held_out = self._counts[key, Half.TRAINING], self._counts[key, Half.HELD_OUT]
            value += training + held_out - abs(training - TRAINING * (training + held_out))
        return round(value, 6)  # the sum is the same in any order


def _start(word: str) -> Half:
    return Half.TRAINING if zlib.crc32(word.encode()) % 1000 < 1000 * TRAINING else Half.HELD_OUT
