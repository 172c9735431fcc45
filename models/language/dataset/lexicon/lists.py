"""Open words: a large list of names of things, so that a translator can be trained and tested on words it never saw."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cache
from importlib.resources import files

from pydantic import BaseModel, ConfigDict

from models.language.dataset.corpus import load_yaml
from models.language.dataset.half import Half


@dataclass(frozen=True, slots=True)
class OpenWords:
    """Names that people use, of one word or several, in lower case, each list in alphabetical order."""

    objects: tuple[str, ...]
    colors: tuple[str, ...]
    containers: tuple[str, ...]
    places: tuple[str, ...]


class _Lists(BaseModel):
    model_config = ConfigDict(extra="forbid", strict=True, frozen=True)
    objects: str
    colors: str
    containers: str
    places: str


def open_words(part: Half | str) -> OpenWords:
    """The open words that training may read, or those that are held out.

    No word of them (but "of") is a word of the vocabularies of the datasets, seen or unseen, or of both parts, or both
    of a color and of another list. A name stands in one list only. Colors are our own choice, the other lists are made
    from WordNet by `models.language.dataset.lexicon.rebuild`.
    """
    return _open_words(Half(part))


def names(text: str) -> tuple[str, ...]:
    """The names of a text, between commas."""
    return tuple(name for part in text.split(",") if (name := " ".join(part.split())))


@cache
def _open_words(part: Half) -> OpenWords:
    lists = load_yaml((files("models.language.dataset.lexicon") / f"{part}.yaml").read_text("utf-8"), _Lists)
    return OpenWords(names(lists.objects), names(lists.colors), names(lists.containers), names(lists.places))
