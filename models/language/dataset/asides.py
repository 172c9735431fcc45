"""What people say beside a command that changes nothing of it: softeners, reasons, and what they want at a place."""

from __future__ import annotations

import random
from collections.abc import Callable, Sequence
from functools import cache
from importlib.resources import files

from pydantic import BaseModel, ConfigDict, Field

from models.language.dataset.composition import slot_elements
from models.language.dataset.corpus import load_yaml
from models.language.dataset.half import HELD_BACK, Half, half

Phrase = Callable[[str], Sequence[str]]
"""A noun phrase for a slot."""

_LEADING = frozenset({"so", "please", "let's", ",", ";"})
"""What leads from a reason to a command."""


class Asides(BaseModel):
    """Lists of phrases, with slots `{object}` and `{place}` for noun phrases.

    `asides` stand between clauses or at the end, `reasons_before` lead to a command, `reasons_after` follow it, and
    `purposes` stand behind a place.
    """

    model_config = ConfigDict(extra="forbid", strict=True, frozen=True)
    asides: list[str] = Field(min_length=HELD_BACK)
    reasons_before: list[str] = Field(min_length=HELD_BACK)
    reasons_after: list[str] = Field(min_length=HELD_BACK)
    purposes: list[str] = Field(min_length=HELD_BACK)


@cache
def asides(part: Half | str) -> Asides:
    """The phrases that training may read, or those that are held out."""
    found = load_yaml((files("models.language.dataset") / "asides.yaml").read_text(encoding="utf-8"), Asides)
    return Asides(**{name: list(half(entries, Half(part))) for name, entries in found})


def drawn(phrases: Sequence[str], phrase: Phrase, generator: random.Random) -> list[str]:
    """The words and marks of one of the phrases, with names in its slots."""
    said: list[str] = []
    for element in slot_elements(generator.choice(phrases)):
        said += [element] if isinstance(element, str) else phrase(element[0])
    return said


def remark(phrase: Phrase, generator: random.Random) -> list[str]:
    """A reason without a command, which asks for nothing."""
    found = asides("training")
    said = drawn([*found.reasons_before, *found.reasons_after], phrase, generator)
    while said and said[-1] in _LEADING:
        said.pop()
    return said
