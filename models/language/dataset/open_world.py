"""The set W: commands about things that are in no vocabulary, with a world that holds them."""

from __future__ import annotations

import math
import random
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import lru_cache
from typing import Any

from models.errors import Place
from models.language.dataset.corpus import Domain, Task, Word, read_corpus
from models.language.dataset.examples import Example, fill
from models.language.dataset.grounding import environment_of
from models.language.dataset.half import Half
from models.language.dataset.lexicon import OpenWords, open_words
from models.language.errors import VocabularyError

NAMES = {"object": 120, "color": 30, "container": 30, "location": 60, "first": 160, "second": 60, "third": 60}
"""How many names a world has for each slot; `navigate_one` has no other slot than `first`, so that one has more."""


@dataclass(frozen=True, slots=True)
class OpenWorld:
    """Commands, and the data of an environment (for `models.world.load_environment`) with all that they speak about."""

    examples: tuple[Example, ...]
    environment: dict[str, Any]


def open_world(domain: Domain | str, *, seed: int, size: int = 1000) -> OpenWorld:
    """`size` commands: the wordings of S and U filled with held-out open words, the same for the same seed.

    Every seed draws its own names. The task classes have equal shares, the first ones one more where that does not
    come out even; so have the wordings of a class. No two commands have the same text, and none says one thing of two:
    the slots of a command are filled with different names, and no name is both a color and an object.

    Raises:
        VocabularyError: a task class has fewer commands than its share.
    """
    return _open_world(Domain(domain), seed, size)


@lru_cache(maxsize=16)
def _open_world(domain: Domain, seed: int, size: int) -> OpenWorld:
    generator = random.Random(f"open world/{domain}/{seed}")
    vocabulary = _vocabulary(domain, generator)
    tasks = read_corpus(domain).tasks
    counts = [size // len(tasks) + (index < size % len(tasks)) for index in range(len(tasks))]
    examples = [
        example
        for task, count in zip(tasks, counts, strict=True)
        for example in _examples(domain, task, vocabulary, generator, count)
    ]
    words = {slot: [Word.of(name) for name in names] for slot, names in vocabulary.items()}
    return OpenWorld(tuple(examples), environment_of(domain, words, name=f"{domain}_open_{seed}"))


def _vocabulary(domain: Domain, generator: random.Random) -> dict[str, list[str]]:
    """Names by slot; the stops of a tour have names of their own, as in the data files."""
    drawn: dict[str, list[str]] = {}
    for slot in dict.fromkeys(slot for task in read_corpus(domain).tasks for slot in task.arguments):
        taken = {name for names in drawn.values() for name in names}
        left = [name for name in _list(open_words(Half.HELD_OUT), slot) if name not in taken]
        drawn[slot] = generator.sample(left, NAMES[slot])
    return drawn


def _list(words: OpenWords, slot: str) -> tuple[str, ...]:
    lists = {"object": words.objects, "color": words.colors, "container": words.containers}
    return lists.get(slot, words.places)


def _examples(
    domain: Domain, task: Task, vocabulary: Mapping[str, Sequence[str]], generator: random.Random, count: int
) -> list[Example]:
    possible = len(task.wordings) * math.prod(len(vocabulary[slot]) for slot in task.arguments)
    if count > possible:
        detail = f"a world has at most {possible} commands of {task.name}, not {count}"
        raise VocabularyError(detail, places=[Place("", detail)])
    examples: dict[str, Example] = {}
    while len(examples) < count:
        wording = task.wordings[len(examples) % len(task.wordings)]
        example = fill(
            domain, task.name, wording, {slot: generator.choice(vocabulary[slot]) for slot in task.arguments}
        )
        examples.setdefault(example.text, example)
    return list(examples.values())
