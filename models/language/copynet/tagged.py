"""The arguments of CQ-CopyNet+POS: what a text names, by part of speech (paper, § Training Pipelines)."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import groupby

from models.language.tagging import TaggedWord


def arguments(tokens: Sequence[TaggedWord]) -> tuple[str, ...]:
    """The nouns of a text in order of mention, then its adjectives; each phrase once.

    Nouns that stand together, common or proper, are one phrase; every adjective is a phrase of its own. Objects come
    before attributes because a task class names its attributes last: `pickup_colored(object, color)`. Nothing else is
    known about a phrase, so a command that mentions its arguments in another order, or other things besides, gets
    arguments in a wrong order or too many.
    """
    nouns = [" ".join(word.text for word in run) for part, run in groupby(tokens, _part) if part == "noun"]
    adjectives = [word.text for word in tokens if word.part == "adjective"]
    return tuple(dict.fromkeys([*nouns, *adjectives]))


def _part(word: TaggedWord) -> str | None:
    return word.part
