"""The data files of the datasets, read and checked: vocabularies, wordings and meaning of every task class."""

from __future__ import annotations

import re
from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from enum import StrEnum
from functools import cache
from importlib.resources import files
from string import Formatter
from typing import TypeVar

import yaml
from pydantic import BaseModel, ConfigDict, Field, ValidationError

from models.data import read_yaml
from models.errors import Place
from models.language.errors import VocabularyError
from models.language.tokens import words

_Shape = TypeVar("_Shape", bound=BaseModel)


class Domain(StrEnum):
    """The two domains of the paper (§ Experimental Domains)."""

    MANIPULATION = "manipulation"
    NAVIGATION = "navigation"


class Part(StrEnum):
    """Which vocabulary fills the wordings: V_S, which training draws on, or V_U, which it never sees."""

    SEEN = "seen"
    UNSEEN = "unseen"


@dataclass(frozen=True, slots=True)
class Word:
    """One entry of a vocabulary: the phrase people say, and the symbol of the object or value it means."""

    phrase: str
    symbol: str

    @classmethod
    def of(cls, phrase: str) -> Word:
        """A phrase that means the object or value of its own name: `teddy bear` is `teddy_bear`."""
        return cls(phrase, re.sub(r"\W+", "_", phrase))


@dataclass(frozen=True, slots=True)
class Task:
    """A task class: its arguments by slot, in order, its meaning, and its wordings with slots in braces."""

    name: str
    arguments: tuple[str, ...]
    ltl: str
    wordings: tuple[str, ...]


@dataclass(frozen=True, slots=True)
class Corpus:
    """One domain's data file: the size of T, the vocabularies by part and slot, the task classes in order."""

    domain: Domain
    training: int
    vocabulary: Mapping[Part, Mapping[str, tuple[Word, ...]]]
    tasks: tuple[Task, ...]

    def task(self, name: str) -> Task:
        """The task class of a name; raises KeyError when there is none."""
        for task in self.tasks:
            if task.name == name:
                return task
        raise KeyError(name)


class _Data(BaseModel):
    model_config = ConfigDict(extra="forbid", strict=True, frozen=True)


class _NamedWord(_Data):
    phrase: str
    symbol: str


class _TaskData(_Data):
    arguments: list[str] = Field(min_length=1)
    ltl: str
    wordings: list[str] = Field(min_length=1)


class _CorpusData(_Data):
    domain: str
    training: int = Field(gt=0)
    vocabulary: dict[str, dict[str, list[str | _NamedWord]]]
    tasks: dict[str, _TaskData] = Field(min_length=1)


@cache
def read_corpus(domain: Domain) -> Corpus:
    """The built-in data file of a domain."""
    return parse_corpus((files("models.language.dataset") / f"{domain}.yaml").read_text(encoding="utf-8"))


def parse_corpus(text: str) -> Corpus:
    """Read a domain's data file.

    Raises:
        VocabularyError: not YAML of the expected shape; a phrase that is not in the tokeniser's form; a phrase twice in
            one list; a phrase or word of the unseen vocabulary that the seen one holds; a wording that lacks a slot of
            its task or has another; an LTL text with a slot that is no argument.
    """
    data = load_yaml(text, _CorpusData)
    if data.domain not in set(Domain) or set(data.vocabulary) != set(Part):
        raise _wrong("", "a data file names a known domain and has a seen and an unseen vocabulary")
    vocabulary = {
        part: {slot: tuple(map(_word, entries)) for slot, entries in data.vocabulary[part].items()} for part in Part
    }
    tasks = tuple(
        Task(name, tuple(task.arguments), task.ltl, tuple(task.wordings)) for name, task in data.tasks.items()
    )
    corpus = Corpus(Domain(data.domain), data.training, vocabulary, tasks)
    problems = [*_check_phrases(corpus), *_check_disjoint(corpus), *_check_tasks(corpus)]
    if problems:
        raise VocabularyError(problems[0].detail, places=problems)
    return corpus


def load_yaml(text: str, shape: type[_Shape]) -> _Shape:
    """YAML text as a value of a pydantic model; raises `VocabularyError` with the places that do not fit."""
    try:
        return shape.model_validate(read_yaml(text))
    except yaml.YAMLError as error:
        raise _wrong("", f"the data file is not YAML: {error}") from None
    except ValidationError as error:
        places = [Place("/" + "/".join(map(str, item["loc"])), item["msg"]) for item in error.errors()]
        raise VocabularyError(
            f"the data file is wrong at {places[0].pointer}: {places[0].detail}", places=places
        ) from None


def slots(pattern: str) -> tuple[str, ...]:
    """The names in braces, in order of occurrence, each once."""
    return tuple(dict.fromkeys(name for _, name, _, _ in Formatter().parse(pattern) if name is not None))


def _word(entry: str | _NamedWord) -> Word:
    if isinstance(entry, _NamedWord):
        return Word(entry.phrase, entry.symbol)
    return Word.of(entry)


def _check_phrases(corpus: Corpus) -> Iterable[Place]:
    for part, lists in corpus.vocabulary.items():
        for slot, entries in lists.items():
            pointer = f"/vocabulary/{part}/{slot}"
            if not entries:
                yield Place(pointer, f"the {part} vocabulary of {slot} is empty")
            if len({entry.phrase for entry in entries}) != len(entries):
                yield Place(pointer, f"a phrase stands twice in the {part} vocabulary of {slot}")
            for index, entry in enumerate(entries):
                if " ".join(words(entry.phrase)) != entry.phrase or not entry.phrase:
                    yield Place(f"{pointer}/{index}", f"{entry.phrase!r} is not in lower case, or holds punctuation")


def _check_disjoint(corpus: Corpus) -> Iterable[Place]:
    seen, unseen = (_phrase_words(corpus.vocabulary[part]) for part in Part)
    for word in sorted(seen & unseen):
        yield Place("/vocabulary/unseen", f"{word!r} is in the seen and in the unseen vocabulary")


def _phrase_words(lists: Mapping[str, tuple[Word, ...]]) -> set[str]:
    return {word for entries in lists.values() for entry in entries for word in entry.phrase.split()}


def _check_tasks(corpus: Corpus) -> Iterable[Place]:
    for task in corpus.tasks:
        pointer = f"/tasks/{task.name}"
        missing = [slot for slot in task.arguments if any(slot not in corpus.vocabulary[part] for part in Part)]
        if missing or len(set(task.arguments)) != len(task.arguments):
            yield Place(
                f"{pointer}/arguments", f"the arguments of {task.name} must be distinct, each with a vocabulary"
            )
        for where, pattern in [("ltl", task.ltl), *((f"wordings/{i}", w) for i, w in enumerate(task.wordings))]:
            if _slots_or_none(pattern) != set(task.arguments):
                yield Place(
                    f"{pointer}/{where}", f"{pattern!r} must hold exactly the slots {', '.join(task.arguments)}"
                )


def _slots_or_none(pattern: str) -> set[str] | None:
    try:
        return set(slots(pattern))
    except ValueError:  # a brace that is not closed
        return None


def _wrong(pointer: str, detail: str) -> VocabularyError:
    return VocabularyError(detail, places=[Place(pointer, detail)])
