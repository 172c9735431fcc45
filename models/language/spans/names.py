"""Names for training: what people call things, and what nobody ever called one."""

from __future__ import annotations

import random
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import cache

from models.language.dataset import Domain, Part, open_words, read_corpus

Phrase = tuple[str, ...]
_COLORS = "color"
_ONSETS = ("b", "bl", "br", "c", "cr", "d", "dr", "f", "fl", "g", "gl", "h", "k", "l", "m", "n", "p", "pl", "qu", "r")
_MORE_ONSETS = ("s", "sk", "sn", "st", "t", "tr", "v", "w", "wh", "z", "zh", "")
_VOWELS = ("a", "e", "i", "o", "u", "oo", "ee", "ai", "y")
_CODAS = ("", "b", "ck", "d", "g", "l", "m", "n", "nd", "ng", "p", "r", "rk", "s", "st", "t", "x", "zz")


@dataclass(frozen=True, slots=True)
class Names:
    """Phrases by the slot that they fill: those of T's vocabulary, and open words beside it.

    `spoken` are words of wordings that names may hold as well: a pass to be shown, a stand to put things on.
    """

    seen: Mapping[str, Sequence[Phrase]]
    open: Mapping[str, Sequence[Phrase]]
    spoken: Sequence[str] = ()

    @property
    def words(self) -> frozenset[str]:
        """Every word of the lists."""
        lists = (*self.seen.values(), *self.open.values())
        return frozenset(word for phrases in lists for phrase in phrases for word in phrase)

    def draw(self, slot: str, generator: random.Random, *, apart: bool = False) -> Phrase:
        """A phrase for a slot: as the lists have it, or two of them joined, or numbered, or made up.

        A colour ends in one of a list, "moss green", unless it stands `apart` from the name of the thing: "the mug that
        is blork" has a colour, "the blork mug" is more likely a kind of mug.
        """
        if slot == _COLORS:
            return self._color(generator, apart)
        kind = generator.random()
        if kind < 0.25:
            return generator.choice(self.seen[slot])
        if kind < 0.7:
            return generator.choice(self.open[slot])
        if kind < 0.85:
            joined = (*self._one(slot, generator), *self._one(slot, generator))
            if self.spoken and generator.random() < 0.2:
                joined = (generator.choice(self.open[slot])[0], generator.choice(self.spoken))
            return joined if len(joined) <= 4 else joined[:2]
        if kind < 0.9:
            return (*generator.choice(self.open[slot]), str(generator.randint(1, 99)))
        return tuple(invented(generator) for _ in range(generator.choice((1, 1, 1, 2))))

    def _color(self, generator: random.Random, apart: bool) -> Phrase:
        kind = generator.random()
        if apart and kind < 0.3:
            return tuple(self._one("object", generator)[0] for _ in range(generator.choice((1, 2, 2))))
        known = generator.choice(self.seen[_COLORS] if generator.random() < 0.3 else self.open[_COLORS])
        return (self._one("object", generator)[0], known[-1]) if kind > 0.9 else known

    def _one(self, slot: str, generator: random.Random) -> Phrase:
        return generator.choice(self.open[slot]) if generator.random() < 0.8 else (invented(generator),)


def invented(generator: random.Random) -> str:
    """A word that does not exist, of two or three syllables."""
    syllables = (
        generator.choice(_ONSETS + _MORE_ONSETS) + generator.choice(_VOWELS) + generator.choice(_CODAS)
        for _ in range(generator.choice((1, 2, 2, 3)))
    )
    return "".join(syllables)


@cache
def names() -> Names:
    """V_S of both domains, and the training part of the open words."""
    words = open_words("training")
    lists = {"object": words.objects, "color": words.colors, "container": words.containers, "location": words.places}
    lists |= dict.fromkeys(("first", "second", "third"), words.places)
    seen = {
        slot: [tuple(word.phrase.split()) for word in entries]
        for domain in Domain
        for slot, entries in read_corpus(domain).vocabulary[Part.SEEN].items()
    }
    return Names(seen, {slot: [tuple(phrase.split()) for phrase in phrases] for slot, phrases in lists.items()})
