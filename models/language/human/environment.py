"""The things that the human commands are about: their names in formulas, and in texts."""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import cache
from importlib.resources import files

from models.data import read_yaml
from models.language.tokens import words

DATASETS = ("drone", "cleanup", "pick")
Words = tuple[str, ...]
_CONTRACTION = re.compile(r"\b(\w+n)(?: ['’]?|['’])t\b")  # "don t", "don 't"


@dataclass(frozen=True, slots=True)
class Name:
    """Words `begin` to `end` of a sentence, which name a thing."""

    begin: int
    end: int
    thing: str


@dataclass(frozen=True, slots=True)
class Sentence:
    """Folded words, and which of them name things, left to right."""

    words: Words
    names: tuple[Name, ...]

    def renamed(self, to: Mapping[str, Words]) -> Sentence:
        """The same with other words for the things; the names stand for what they stood for."""
        text: list[str] = []
        names: list[Name] = []
        place = 0
        for name in self.names:
            text += self.words[place : name.begin]
            names.append(Name(len(text), len(text) + len(to[name.thing]), name.thing))
            text += to[name.thing]
            place = name.end
        return Sentence((*text, *self.words[place:]), tuple(names))


@dataclass(frozen=True, slots=True)
class Places:
    """The kinds of things that are places; `says` is how a text names one, `means` the proposition of being there,
    with `{}` for the name and the thing.
    """

    kinds: Sequence[str]
    says: str
    means: str


@dataclass(frozen=True, slots=True)
class Environment:
    """By kind and thing, the names that texts have for it, the usual one first; and which are places, if any."""

    kinds: Mapping[str, Mapping[str, Sequence[Words]]]
    places: Places | None = None

    @property
    def kind_of(self) -> dict[str, str]:
        """The kind of each thing."""
        return {thing: kind for kind, things in self.kinds.items() for thing in things}

    def sentence(self, text: str) -> Sentence:
        """A text with the names in it. Of two names that overlap, the one that begins first or is longer counts."""
        spoken = words(plain(text))
        known = {name: thing for things in self.kinds.values() for thing, names in things.items() for name in names}
        return Sentence(spoken, tuple(Name(*found) for found in occurrences(spoken, known)))

    def in_order(self, sentence: Sentence) -> Sentence:
        """The sentence with its things renamed: the first room that it names is the first of all rooms, and so on.

        Sentences that differ only in the things that they are about become the same (lifting).
        """
        usual: dict[str, Words] = {}
        for kind, things in self.kinds.items():
            named = dict.fromkeys(name.thing for name in sentence.names if name.thing in things)
            usual |= {thing: names[0] for thing, names in zip(named, self.kinds[kind].values(), strict=False)}
        return sentence.renamed(usual)


@cache
def environment(dataset: str) -> Environment:
    """What one of `DATASETS` is about."""
    data = read_yaml((files("models.language.human") / "environments.yaml").read_text(encoding="utf-8"))
    kinds, places = data["things"][dataset], data["places"].get(dataset)
    return Environment(
        {
            kind: {thing: [words(name) for name in names] for thing, names in things.items()}
            for kind, things in kinds.items()
        },
        None if places is None else Places(**places),
    )


def occurrences(spoken: Sequence[str], known: Mapping[Words, str]) -> list[tuple[int, int, str]]:
    """Where one of the phrases stands, begin and end, with what it stands for: leftmost, then longest first."""
    longest = max(map(len, known))
    found = []
    place = 0
    while place < len(spoken):
        ends = range(min(len(spoken), place + longest), place, -1)
        end = next((end for end in ends if tuple(spoken[place:end]) in known), None)
        if end is not None:
            found.append((place, end, known[tuple(spoken[place:end])]))
        place = place + 1 if end is None else end
    return found


def plain(text: str) -> str:
    """A text in lower case with contractions whole ("do n't") and with words that a stroke joins apart."""
    return _CONTRACTION.sub(r"\1't", text.lower().replace("/", " ").replace("-", " ").replace("do n't", "don't"))
