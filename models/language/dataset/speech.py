"""What people say around a command: "hey robot, could you please ...?", "..., thanks", "my", "that" for "the"."""

from __future__ import annotations

import random
import re
from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import cache
from importlib.resources import files

from pydantic import BaseModel, ConfigDict, Field

from models.language.dataset.corpus import load_yaml
from models.language.dataset.examples import Example, Span
from models.language.dataset.half import HELD_BACK, Half, half
from models.language.tokens import tokenize, words

_ONCE = frozenset({"please", "thanks", "thank", "robot", "me", "now"})
"""Words that nobody says twice in one command."""
_I = re.compile(r"I\b")
_AN = re.compile(r"(?!uni|use|uku|ute|eu|one)[aeiou]|hour|heir")
"""Beginnings of words that take "an"."""


class _Speech(BaseModel):
    model_config = ConfigDict(extra="forbid", strict=True, frozen=True)
    calls: list[str] = Field(min_length=HELD_BACK)
    requests: list[str] = Field(min_length=HELD_BACK)
    closings: list[str] = Field(min_length=HELD_BACK)
    determiners: list[str] = Field(min_length=HELD_BACK)
    imperatives: list[str] = Field(min_length=1)


@dataclass(frozen=True, slots=True)
class Frames:
    """What stands around a command, `{}` in each: calls and closings fit all, requests those that begin with a verb."""

    calls: tuple[str, ...]
    requests: tuple[str, ...]
    closings: tuple[str, ...]


def frames(part: Half | str) -> Frames:
    """The frames that training may read, or those that are held out."""
    return _frames(Half(part))


@cache
def _frames(part: Half) -> Frames:
    data = _read()
    return Frames(half(data.calls, part), half(data.requests, part), half(data.closings, part))


def framed(example: Example, generator: random.Random, *, part: Half | str) -> Example:
    """The example in a request, with a closing, or after a call; at least one of them, at random, and what fits.

    A text that holds "please" gets no second one. Query and meaning stay, the mentions are where the words are now.
    """
    kinds = [frames(part).requests] if is_imperative(example.text) else []
    kinds += [frames(part).closings, frames(part).calls]
    chosen = [kind for kind in kinds if generator.random() < 0.5] or [generator.choice(kinds)]
    for kind in chosen:
        said_once = _ONCE.intersection(words(example.text))
        fitting = [frame for frame in kind if said_once.isdisjoint(_once(frame))] if said_once else kind
        example = _inside(generator.choice(fitting), example)
    return example


def redetermined(example: Example, generator: random.Random, *, part: Half | str) -> Example:
    """The example with another word for each "the" that stands right before what is mentioned first: a, my, that, none.

    "Go to my bakery, then the library". What is mentioned again keeps its "the": by then it is known.
    """
    choices = half(_read().determiners, Half(part))
    firsts = sorted(min(spans) for spans in example.mentions)
    for start, _ in reversed(firsts):  # from the right, so that what is still to do stays where it is
        example = _with_determiner(example, start, generator.choice(choices))
    return example


def said(frame: str, *texts: str) -> str:
    """The texts in the places `{}` of a frame, as one sentence: small letters within, one mark at the end."""
    pieces, mark = frame.split("{}"), ""
    sentence = pieces[0]
    for text, piece in zip(texts, pieces[1:], strict=True):
        bare = text.rstrip(" .!?")
        mark = text[len(bare) :].strip()
        sentence += (bare[0].lower() + bare[1:] if sentence and not _I.match(bare) else bare) + piece
    return sentence if sentence.endswith("?") else sentence + mark


def is_imperative(text: str) -> bool:
    """Whether a text begins with a verb that tells to do something."""
    return words(text)[0] in _imperatives()


def _inside(frame: str, example: Example) -> Example:
    count = _before(frame)
    return _shifted(example, said(frame, example.text), lambda at: at + count)


@cache
def _before(frame: str) -> int:
    return len(words(frame.split("{}")[0]))


def _with_determiner(example: Example, start: int, determiner: str) -> Example:
    tokens = tokenize(example.text)
    if start == 0 or tokens[start - 1].text != "the":
        return example
    the = tokens[start - 1]
    if determiner == "a" and _AN.match(tokens[start].text):
        determiner = "an"
    if the.start == 0:
        determiner = determiner.capitalize()
    text = example.text[: the.start] + (f"{determiner} " if determiner else "") + example.text[tokens[start].start :]
    return _shifted(example, text, lambda at: at if determiner or at < start else at - 1)


def _shifted(example: Example, text: str, moved: Callable[[int], int]) -> Example:
    def move(span: Span) -> Span:
        return moved(span[0]), moved(span[1] - 1) + 1

    return replace(example, text=text, mentions=tuple(tuple(map(move, spans)) for spans in example.mentions))


@cache
def _once(frame: str) -> frozenset[str]:
    return _ONCE.intersection(words(frame))


@cache
def _imperatives() -> frozenset[str]:
    return frozenset(_read().imperatives)


@cache
def _read() -> _Speech:
    return load_yaml((files("models.language.dataset") / "speech.yaml").read_text(encoding="utf-8"), _Speech)
