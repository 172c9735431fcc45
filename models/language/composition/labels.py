"""Names that end in a letter or a number, "from shelf b to shelf c": who names one thing so names the others alike."""

from __future__ import annotations

import random
from dataclasses import dataclass, field
from typing import Self

TEXTS, NAMES = 0.08, 0.9
"""Part of the texts whose things have labels, and part of the names in them that do."""
STRAY = 0.03
"""Part of the names of other texts that do."""
ALIKE = 0.65
"""Part of the labelled names that are called like the one before: "gate 1 and gate 2"."""
BARE = 0.8
"""Part of the labelled names without an article."""
_LETTERS = "aaabbbccddefghkx"


@dataclass(slots=True)
class Told:
    """What a text has told so far.

    Attributes:
        named: the slots of what it named; such a thing may be a pronoun from then on.
        share: part of its names that are labelled.
        numbers, letters: what its labels are made of.
        called: by slot, the word in front of the last label.
    """

    share: float
    letters: bool
    numbers: bool
    named: set[str] = field(default_factory=set)
    called: dict[str, str] = field(default_factory=dict)

    @classmethod
    def drawn(cls, generator: random.Random) -> Self:
        """For a text that begins."""
        letters, numbers = generator.choice(((True, False), (False, True), (True, False), (False, True), (True, True)))
        return cls(NAMES if generator.random() < TEXTS else STRAY, letters, numbers)

    def labels(self, slot: str, generator: random.Random) -> bool:
        """Whether the next name of a slot ends in a label."""
        return slot != "color" and generator.random() < self.share

    def labelled(self, word: str, slot: str, generator: random.Random) -> tuple[str, str]:
        """A name with a label: of this word, or of that in front of the last label."""
        if slot in self.called and generator.random() < ALIKE:
            word = self.called[slot]
        self.called[slot] = word
        return word, self._label(generator)

    def _label(self, generator: random.Random) -> str:
        number = str(generator.choice((generator.randint(1, 9), 10, 12, 42))) if self.numbers else ""
        letter = generator.choice(_LETTERS) if self.letters else ""
        return letter + number if generator.random() < 0.5 else number + letter
