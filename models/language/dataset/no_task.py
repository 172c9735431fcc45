"""Text that no task fits: what teaches a translator to answer nothing instead of forcing a task class."""

from __future__ import annotations

import random
import string
from dataclasses import dataclass
from functools import cache
from importlib.resources import files

from pydantic import BaseModel, ConfigDict, Field

from models.language.dataset.corpus import Domain, Part, load_yaml, read_corpus, slots
from models.language.dataset.split import split
from models.language.tokens import words

HELD_BACK = 5
"""Every fifth sentence, verb and frame is kept from training, to measure abstention on what was never read."""
PLACES = ("first", "second", "third")


class _NoTaskData(BaseModel):
    model_config = ConfigDict(extra="forbid", strict=True, frozen=True)
    sentences: list[str] = Field(min_length=HELD_BACK)
    verbs: list[str] = Field(min_length=HELD_BACK)
    frames: list[str] = Field(min_length=HELD_BACK)


@dataclass(frozen=True, slots=True)
class NoTask:
    """Texts that no task fits: for training, and others that share no sentence, verb or frame with them."""

    training: tuple[str, ...]
    held_out: tuple[str, ...]


@cache
def no_task(*, seed: int = 0, fills: int = 8) -> NoTask:
    """The texts, the same for the same seed: sentences; frames filled `fills` times each; commands cut short or said
    backwards; letters without sense. Only words of the seen vocabularies fill the frames.
    """
    data = load_yaml((files("models.language.dataset") / "no_task.yaml").read_text(encoding="utf-8"), _NoTaskData)
    training = _texts(data, False, seed, fills)
    read = {words(text) for text in training}  # two commands may be the same when cut short
    return NoTask(training, tuple(text for text in _texts(data, True, seed, fills) if words(text) not in read))


def _texts(data: _NoTaskData, held_out: bool, seed: int, fills: int) -> tuple[str, ...]:
    generator = random.Random(f"no task/{seed}/{held_out}")
    verbs = _half(data.verbs, held_out)
    texts = list(_half(data.sentences, held_out))
    for frame in _half(data.frames, held_out):
        texts.extend(_fill(frame, verbs, generator) for _ in range(fills))
    count = len(texts) // 6
    texts.extend(_spoiled_commands(generator, count, held_out, seed))
    texts.extend(_gibberish(generator) for _ in range(count))
    return tuple(dict.fromkeys(texts))


def _half(entries: list[str], held_out: bool) -> list[str]:
    return [entry for index, entry in enumerate(entries) if (index % HELD_BACK == HELD_BACK - 1) is held_out]


def _fill(frame: str, verbs: list[str], generator: random.Random) -> str:
    """The frame with its slots filled; slots of one sort (`place`, `place2`) get different words."""
    filled: dict[str, str] = {}
    for slot in slots(frame):
        sort = slot.rstrip(string.digits)
        choices = [word for word in _choices(sort, verbs) if word not in filled.values()]
        filled[slot] = generator.choice(choices)
    return frame.format_map(filled)


def _choices(sort: str, verbs: list[str]) -> list[str]:
    if sort == "verb":
        return verbs
    if sort == "place":
        lists = read_corpus(Domain.NAVIGATION).vocabulary[Part.SEEN]
        return [word.phrase for slot in PLACES for word in lists[slot]]
    return [word.phrase for word in read_corpus(Domain.MANIPULATION).vocabulary[Part.SEEN][sort]]


def _spoiled_commands(generator: random.Random, count: int, held_out: bool, seed: int) -> list[str]:
    """Commands of T cut before their last argument, or with their words in reverse order."""
    examples = [
        example
        for domain in Domain
        for example in (split(domain, seed=seed).validation if held_out else split(domain, seed=seed).training)
        if len(example.query.arguments) > 1 and example.task != "pickup_colored"  # cut short it would be a pickup
    ]
    texts = []
    for index, example in enumerate(generator.sample(examples, count)):
        if index % 2:
            texts.append(" ".join(reversed(example.text.split())))
        else:
            last = max(example.text.rfind(phrase) for phrase in example.query.arguments)
            texts.append(example.text[:last].strip())
    return texts


def _gibberish(generator: random.Random) -> str:
    lengths = [generator.randint(2, 9) for _ in range(generator.randint(1, 5))]
    return " ".join("".join(generator.choices(string.ascii_lowercase, k=length)) for length in lengths)
