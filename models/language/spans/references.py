"""Names put into the ways in which people refer to things by more than a name."""

from __future__ import annotations

import random
from collections.abc import Mapping, Sequence

from models.language.dataset.references import Reference, adjectives, references
from models.language.spans.names import Names, Phrase
from models.world.degrees import forms

GROUPS: Mapping[str, Sequence[str]] = {
    "thing": ("any", "all", "pronouns", "where", "compare"),
    "place": ("any", "all", "where_place", "compare"),
    "target": ("any", "all", "compare"),
}
"""Groups of patterns by what they are drawn for: a thing, a place, or a thing after which more is said of where to."""
PLACES = frozenset({"location", "first", "second", "third", "place"})


def refer(name: Phrase, kind: str, names: Names, generator: random.Random) -> tuple[Phrase, bool]:
    """A phrase that refers to what has a name, and whether a determiner may stand in front of it.

    Args:
        kind: a key of `GROUPS`.
    """
    group = references()[generator.choice(GROUPS[kind])]
    chosen = generator.choice(group)
    if any(element in ("{ns}", "{adjer}") for element in chosen.elements) and len(name) > 2:
        name = name[-2:]
    return _filled(chosen, name, names, generator), chosen.article


def _filled(chosen: Reference, name: Phrase, names: Names, generator: random.Random) -> Phrase:
    adjective = (generator.choice(adjectives()),)
    more, most = forms(adjective)
    said: list[str] = []
    for element in chosen.elements:
        match element:
            case "{n}":
                said += name
            case "{ns}":
                said += (*name[:-1], plural(name[-1]))
            case "{color}":
                said += names.draw("color", generator)
            case "{thing}":
                said += names.draw("object", generator)
            case "{room}":
                said += names.draw("location", generator)
            case "{adj}":
                said += adjective
            case "{adjer}":
                said += more[-1]
            case "{adjest}":
                said += most[-1]
            case _:
                said.append(element)
    return tuple(said)


def plural(word: str) -> str:
    """More than one of it."""
    if word.endswith("y") and len(word) > 2 and word[-2] not in "aeiou":
        return f"{word[:-1]}ies"
    return f"{word}es" if word.endswith(("s", "x", "ch", "sh", "z")) else f"{word}s"
