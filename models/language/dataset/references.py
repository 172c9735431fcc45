"""How people refer to things by more than a name: "any red toy", "the cup in the kitchen", "the smaller of the two"."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from functools import cache
from importlib.resources import files

from pydantic import BaseModel, ConfigDict, Field

from models.language.dataset.corpus import load_yaml
from models.language.dataset.half import Half, half

_ARTICLE = "the "


@dataclass(frozen=True, slots=True)
class Reference:
    """A pattern of words and slots; with `article`, a determiner may stand in front of it."""

    elements: tuple[str, ...]
    article: bool

    @classmethod
    def of(cls, text: str) -> Reference:
        """From its text."""
        return cls(tuple(text.removeprefix(_ARTICLE).split()), text.startswith(_ARTICLE))


class _Data(BaseModel):
    model_config = ConfigDict(extra="forbid", strict=True, frozen=True)
    any: list[str] = Field(min_length=1)
    all: list[str] = Field(min_length=1)
    pronouns: list[str] = Field(min_length=1)
    where: list[str] = Field(min_length=1)
    where_place: list[str] = Field(min_length=1)
    compare: list[str] = Field(min_length=1)
    adjectives: list[str] = Field(min_length=1)


@cache
def references() -> Mapping[str, tuple[Reference, ...]]:
    """The patterns that training draws, by group; every fifth of a group is kept from it."""
    data = _read().model_dump()
    del data["adjectives"]
    return {group: tuple(Reference.of(text) for text in half(texts, Half.TRAINING)) for group, texts in data.items()}


@cache
def adjectives() -> tuple[str, ...]:
    """Words that can be compared."""
    return tuple(_read().adjectives)


@cache
def _read() -> _Data:
    return load_yaml((files("models.language.dataset") / "references.yaml").read_text(encoding="utf-8"), _Data)
