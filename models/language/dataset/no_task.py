"""Text that no task fits: what teaches a translator to answer nothing instead of forcing a task class."""

from __future__ import annotations

import random
import string
from collections.abc import Collection, Sequence
from dataclasses import dataclass
from functools import cache
from importlib.resources import files

from pydantic import BaseModel, ConfigDict, Field

from models.language.dataset.corpus import Domain, Part, load_yaml, read_corpus, slots
from models.language.dataset.examples import Example, fill
from models.language.dataset.half import HELD_BACK, Half, half
from models.language.dataset.lexicon import open_words
from models.language.dataset.paraphrases import paraphrases
from models.language.dataset.speech import frames, is_imperative, said
from models.language.dataset.split import split
from models.language.tokens import words
from models.language.translation import NEGATIONS

PLACES = ("first", "second", "third")
SPOKEN = {Half.TRAINING: 16, Half.HELD_OUT: 6}
"""How often each frame around a command is used; a frame of single words half as often."""
POLITE = 0.25
"""The part of the texts that get a call or a closing, so that politeness does not tell what fits a task."""

_PICKUPS = frozenset({"pickup", "pickup_colored"})
_TOURS = frozenset({"navigate_one", "navigate_two", "navigate_three"})


class _NoTaskData(BaseModel):
    model_config = ConfigDict(extra="forbid", strict=True, frozen=True)
    sentences: list[str] = Field(min_length=HELD_BACK)
    remarks: list[str] = Field(min_length=HELD_BACK)
    verbs: list[str] = Field(min_length=4 * HELD_BACK)  # a frame may hold two
    frames: list[str] = Field(min_length=HELD_BACK)
    around: list[str] = Field(min_length=HELD_BACK)
    conditions: list[str] = Field(min_length=HELD_BACK)
    with_it: list[str] = Field(min_length=HELD_BACK)
    there: list[str] = Field(min_length=HELD_BACK)
    joins: list[str] = Field(min_length=HELD_BACK)


@dataclass(frozen=True, slots=True)
class NoTask:
    """Texts that no task fits: for training, and others that share no sentence, verb or frame with them."""

    training: tuple[str, ...]
    held_out: tuple[str, ...]


@cache
def no_task(*, seed: int = 0, joined: bool = True, remarks: bool = True) -> NoTask:
    """The texts, the same for the same seed: sentences; frames filled with words; commands that are negated, asked
    about, made another task by a condition or a clause, or joined; commands cut short or said backwards; letters
    without sense. Only words of the seen vocabularies and open words for training are spoken of.

    Without `joined` only those that ask for nothing at all, neither one thing nor several; without `remarks` fewer
    sentences about the places and things of commands.
    """
    training = _texts(Half.TRAINING, seed, joined, remarks)
    read = {words(text) for text in training}  # two commands may be the same when cut short
    return NoTask(
        training, tuple(text for text in _texts(Half.HELD_OUT, seed, joined, remarks) if words(text) not in read)
    )


def _texts(part: Half, seed: int, joined: bool, remarks: bool) -> tuple[str, ...]:
    data, generator = _read(), random.Random(f"no task/{seed}/{part}")
    verbs = half(data.verbs, part)
    asked = half(data.frames, part)
    texts = [*half(data.sentences, part), *(half(data.remarks, part) if remarks else ())]
    if joined:
        texts.extend(_filled(frame, verbs, generator) for frame in asked for _ in range(SPOKEN[part] // 2))
        acts = [frame for frame in asked if "{verb}" in frame]
        texts.extend(_filled(generator.choice(acts), verbs, generator, verb) for verb in verbs for _ in range(2))
    texts.extend(_spoken(data, part, generator, joined))
    count = len(texts) // 12
    polite = (*frames(part).calls, *frames(part).closings)
    texts = [said(generator.choice(polite), text) if generator.random() < POLITE else text for text in texts]
    if joined:
        texts.extend(_spoiled_commands(generator, count, part, seed))
    texts.extend(_gibberish(generator) for _ in range(count))
    return tuple(dict.fromkeys(texts))


def _filled(frame: str, verbs: Sequence[str], generator: random.Random, verb: str | None = None) -> str:
    """The frame with its slots filled; slots of one sort (`place`, `place2`) get different words."""
    filled = {} if verb is None else {"verb": verb}
    for slot in (slot for slot in slots(frame) if slot not in filled):
        sort = slot.rstrip(string.digits)
        choices = verbs if sort == "verb" else generator.choice(_names(sort))
        filled[slot] = _another(choices, filled.values(), generator)
    return frame.format_map(filled)


def _another(choices: Sequence[str], taken: Collection[str], generator: random.Random) -> str:
    while (choice := generator.choice(choices)) in taken:
        pass
    return choice


def _spoken(data: _NoTaskData, part: Half, generator: random.Random, joined: bool) -> list[str]:
    """Commands inside what makes no task of them."""
    around = data.around if joined else [frame for frame in data.around if NEGATIONS.isdisjoint(words(frame))]
    groups = [(around, _tasks())]
    if joined:
        groups += [(data.conditions, _tasks()), (data.with_it, _PICKUPS), (data.there, _TOURS)]
    texts = [
        said(frame, _command(generator, wanted).text)
        for entries, wanted in groups
        for frame in half(entries, part)
        for _ in range(SPOKEN[part])
    ]
    for frame in half(data.joins, part) * 2 if joined else ():
        texts.extend(said(frame, *_two_commands(generator)) for _ in range(SPOKEN[part]))
    return texts


def _two_commands(generator: random.Random) -> tuple[str, str]:
    """Of different things, and not two tours, which may be one longer tour."""
    first = _command(generator, _tasks())
    while True:
        second = _command(generator, _tasks() - _TOURS if first.task in _TOURS else _tasks())
        if set(first.query.arguments).isdisjoint(second.query.arguments):
            return first.text, second.text


def _command(generator: random.Random, tasks: frozenset[str]) -> Example:
    """A command of one of some task classes, in a wording of S or a paraphrase that training reads."""
    domain, task, wordings = generator.choice([entry for entry in _wordings() if entry[1] in tasks])
    arguments = read_corpus(domain).task(task).arguments
    phrases: dict[str, str] = {}
    for slot in arguments:
        choices = generator.choice(_names("place" if slot in PLACES else slot))
        phrases[slot] = _another(choices, phrases.values(), generator)
    return fill(domain, task, generator.choice(wordings), phrases)


@cache
def _wordings() -> tuple[tuple[Domain, str, tuple[str, ...]], ...]:
    """The wordings of every task class that begin with a verb and are no request yet."""
    return tuple(
        (domain, task.name, tuple(filter(_is_bare, (*task.wordings, *paraphrases(domain, Half.TRAINING)[task.name]))))
        for domain in Domain
        for task in read_corpus(domain).tasks
    )


@cache
def _tasks() -> frozenset[str]:
    return frozenset(task.name for domain in Domain for task in read_corpus(domain).tasks)


def _is_bare(wording: str) -> bool:
    return is_imperative(wording) and "please" not in wording


@cache
def _names(sort: str) -> tuple[tuple[str, ...], tuple[str, ...]]:
    """The words of a sort that S speaks of, and the open words for training."""
    opened = open_words(Half.TRAINING)
    if sort == "place":
        lists = read_corpus(Domain.NAVIGATION).vocabulary[Part.SEEN]
        return tuple(word.phrase for slot in PLACES for word in lists[slot]), opened.places
    lists = read_corpus(Domain.MANIPULATION).vocabulary[Part.SEEN]
    names = {
        "object": opened.objects,
        "color": opened.colors,
        "container": opened.containers,
        "location": opened.places,
    }
    return tuple(word.phrase for word in lists[sort]), names[sort]


def _spoiled_commands(generator: random.Random, count: int, part: Half, seed: int) -> list[str]:
    """Commands of T cut before their last argument, or with their words in reverse order."""
    parts = [split(domain, seed=seed) for domain in Domain]
    examples = [
        example
        for drawn in parts
        for example in (drawn.training if part is Half.TRAINING else drawn.validation)
        if len(example.query.arguments) > 1 and example.task != "pickup_colored"  # cut short it would be a pickup
    ]
    texts = []
    for index, example in enumerate(generator.sample(examples, min(count, len(examples)))):
        if index % 2:
            texts.append(" ".join(reversed(example.text.split())))
        else:
            last = max(example.text.rfind(phrase) for phrase in example.query.arguments)
            texts.append(example.text[:last].strip())
    return texts


def _gibberish(generator: random.Random) -> str:
    lengths = [generator.randint(2, 9) for _ in range(generator.randint(1, 5))]
    return " ".join("".join(generator.choices(string.ascii_lowercase, k=length)) for length in lengths)


@cache
def _read() -> _NoTaskData:
    return load_yaml((files("models.language.dataset") / "no_task.yaml").read_text(encoding="utf-8"), _NoTaskData)
