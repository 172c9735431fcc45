"""Typing mistakes: one in a word, one in what a command mentions."""

from __future__ import annotations

import random
from dataclasses import replace

from models.errors import Place
from models.language.dataset.examples import Example
from models.language.errors import VocabularyError
from models.language.tokens import tokenize

MIN_LETTERS = 3
"""Shorter words are never misspelt: little of them would be left to know them by."""
NEIGHBOURS = {
    "q": "wa", "w": "qeas", "e": "wrsd", "r": "etdf", "t": "ryfg", "y": "tugh", "u": "yihj", "i": "uojk", "o": "ipkl",
    "p": "ol", "a": "qwsz", "s": "awedxz", "d": "serfcx", "f": "drtgvc", "g": "ftyhbv", "h": "gyujnb", "j": "huikmn",
    "k": "jiolm", "l": "kop", "z": "asx", "x": "zsdc", "c": "xdfv", "v": "cfgb", "b": "vghn", "n": "bhjm", "m": "njk",
}  # fmt: skip
"""The keys around each letter on an English keyboard."""


def misspell(word: str, generator: random.Random) -> str:
    """The word with one mistake, in lower case: a letter too many, one left out, a neighbouring key, or two swapped.

    The first letter stays, and the result differs. A word of fewer than `MIN_LETTERS` letters comes back as it is, as
    does one with no letter of a to z after its first.
    """
    kinds = _mistakes(word.lower())
    return generator.choice(generator.choice(kinds)) if kinds else word


def with_typo(example: Example, generator: random.Random) -> Example:
    """The example with one mistake in one mention of one content word of one argument.

    The query stays what was meant, and the mentions where they were: no mistake makes two words of one.

    Raises:
        VocabularyError: every word that is mentioned is too short for a mistake.
    """
    tokens = tokenize(example.text)
    spoilt = [
        [token for start, end in spans for token in tokens[start:end] if _mistakes(token.text)]
        for spans in example.mentions
    ]
    choices = [mentioned for mentioned in spoilt if mentioned]
    if not choices:
        detail = f"no word of {', '.join(example.query.arguments)} is long enough for a typing mistake"
        raise VocabularyError(detail, places=[Place("", detail)])
    token = generator.choice(generator.choice(choices))
    text = example.text[: token.start] + misspell(token.text, generator) + example.text[token.end :]
    return replace(example, text=text)


def _mistakes(word: str) -> list[list[str]]:
    """Misspelt forms by kind of mistake, kinds that the word allows only."""
    if sum(map(str.isalpha, word)) < MIN_LETTERS:
        return []
    after_first = range(1, len(word))
    letters = [at for at in after_first if word[at] in NEIGHBOURS]
    kinds = [
        {word[:at] + key + word[at:] for at in letters for key in word[at] + NEIGHBOURS[word[at]]},
        {word[:at] + word[at + 1 :] for at in letters},
        {word[:at] + key + word[at + 1 :] for at in letters for key in NEIGHBOURS[word[at]]},
        {word[:at] + word[at + 1] + word[at] + word[at + 2 :] for at in letters if at + 1 in letters},
    ]
    return [sorted(kind - {word}) for kind in kinds if kind - {word}]
