"""How people put several commands into one: clauses, and patterns that join them."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass
from functools import cache
from importlib.resources import files
from typing import Literal, TypeVar

from pydantic import BaseModel, ConfigDict, Field

from models.errors import Place
from models.language.dataset.corpus import load_yaml
from models.language.errors import VocabularyError
from models.language.tokens import marked_words

Form = Literal["do", "doing", "done", "state", "it", "subject", "passive", "gerund", "echo"]
"""How a clause is said: "go to the zoo", "going to the zoo", "been to the zoo", "you are at the zoo", "the zoo"; or in
two pieces, a subject and what is done to it: "the ball" (must be) "picked up", "the ball" (needs) "picking up". An
`echo` says again what was said of it before, and counts for nothing.
"""
PIECES: tuple[Form, Form] = ("passive", "gerund")
"""The forms of what is done to a subject, which stands before them."""
FURTHER: tuple[Form, ...] = (*PIECES, "echo")
"""The forms that come beside the one in which a clause is first said."""
T = TypeVar("T")
_HOLE = re.compile(r"\{(\d):(do|doing|done|state|it|subject|passive|gerund|echo)\}")
_PASSIVE = re.compile(
    r"(\w+(?: (?:up|out|off|away|down|over))?(?= (?:\{color\} )?\{object\})|\w+(?= \{place\}$))"  # "picked up"
    r" ((?:\{color\} )?\{\w+\})(.*)"  # "the ball", and the rest
)
_ACTIVE = frozenset({"had", "got", "having", "getting", "been", "being"})
"""Verbs of which nothing is said in the passive."""
_SLOT = re.compile(r"\{(\w+)\}")


class Leaf(BaseModel):
    """What one clause may say, in its forms; slots are `place`, `object`, `object2`, `container` and `color`.

    `target`: the slot after which a bare noun phrase may follow ("go to the zoo, then the bank"). `task`: the class
    of the paper that says the same, where there is one.
    """

    model_config = ConfigDict(extra="forbid", strict=True, frozen=True)
    do: str
    doing: str
    done: str
    state: str | None = None
    target: Literal["place", "object"] | None = None
    task: str | None = None

    @property
    def forms(self) -> Mapping[Form, str]:
        """Its text by form, of those that are one piece, without `it`."""
        said: dict[Form, str | None] = {"do": self.do, "doing": self.doing, "done": self.done, "state": self.state}
        return {form: text for form, text in said.items() if text is not None}

    @property
    def pieces(self) -> Mapping[Form, str]:
        """What it is said in where its object is the subject: that, and what is done to it. Empty where nobody does."""
        done, doing = _PASSIVE.fullmatch(self.done), _PASSIVE.fullmatch(self.doing)
        if done is None or doing is None or done[1].split()[0] in _ACTIVE:
            return {}
        return {"subject": done[2], "passive": done[1] + done[3], "gerund": doing[1] + doing[3]}

    @property
    def slots(self) -> tuple[str, ...]:
        """The names of its slots, left to right in the imperative."""
        return tuple(_SLOT.findall(self.do))


@dataclass(frozen=True, slots=True)
class Hole:
    """The place of a clause in a pattern; clauses are numbered from 1."""

    leaf: int
    form: Form


@dataclass(frozen=True, slots=True)
class Pattern:
    """A way to say a composition of a shape such as `then(1, or(2, 3))`: words, marks and holes."""

    shape: str
    elements: tuple[str | Hole, ...]

    @property
    def holes(self) -> tuple[Hole, ...]:
        """Its holes, left to right."""
        return tuple(element for element in self.elements if isinstance(element, Hole))


class _Shape(BaseModel):
    model_config = ConfigDict(extra="forbid", strict=True, frozen=True)
    shape: str
    says: list[str] = Field(min_length=1)


class _Data(BaseModel):
    model_config = ConfigDict(extra="forbid", strict=True, frozen=True)
    leaves: list[Leaf] = Field(min_length=1)
    patterns: list[_Shape] = Field(min_length=1)


@cache
def leaves() -> tuple[Leaf, ...]:
    """All clauses."""
    return tuple(_read().leaves)


@cache
def patterns() -> Mapping[str, tuple[Pattern, ...]]:
    """The patterns by shape; raises VocabularyError where a pattern does not have every clause of its shape once."""
    return {entry.shape: tuple(_pattern(entry.shape, text) for text in entry.says) for entry in _read().patterns}


def slot_elements(text: str) -> tuple[str | tuple[str], ...]:
    """The words of a clause's text, and its slots as tuples of one name."""
    return tuple(_split(text, _SLOT, lambda found: (found[1],)))


def _pattern(shape: str, text: str) -> Pattern:
    elements = tuple(_split(text, _HOLE, lambda found: Hole(int(found[1]), found[2])))  # type: ignore[arg-type]
    pattern = Pattern(shape, elements)
    said = sorted(hole.leaf for hole in pattern.holes if hole.form not in FURTHER)
    if said != sorted({int(number) for number in re.findall(r"\d", shape)}) or not _whole(pattern):
        detail = f"the pattern {text!r} does not have every clause of {shape} once"
        raise VocabularyError(detail, places=[Place("/patterns", detail)])
    return pattern


def _whole(pattern: Pattern) -> bool:
    """Whether what is done to a subject stands behind each one and nowhere else, and no echo before what it echoes."""
    open_subjects: set[int] = set()
    heard: set[int] = set()
    for hole in pattern.holes:
        if hole.form == "echo" and hole.leaf not in heard:
            return False
        heard.add(hole.leaf)
        if hole.form == "subject":
            open_subjects.add(hole.leaf)
        elif hole.form in PIECES:
            if hole.leaf not in open_subjects:
                return False
            open_subjects.remove(hole.leaf)
    return not open_subjects


def _split(text: str, hole: re.Pattern[str], made: Callable[[re.Match[str]], T]) -> Iterator[str | T]:
    """The words and marks of a text, and what is made of each of its holes."""
    at = 0
    for found in hole.finditer(text):
        yield from marked_words(text[at : found.start()])
        yield made(found)
        at = found.end()
    yield from marked_words(text[at:])


@cache
def _read() -> _Data:
    return load_yaml((files("models.language.dataset") / "composition.yaml").read_text(encoding="utf-8"), _Data)
