"""Examples: every wording of every task class filled with every choice of a vocabulary (paper, Table I)."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from functools import cache
from itertools import product

from models.language.dataset.corpus import Corpus, Domain, Part, Task, Word, read_corpus
from models.queries import ContextualQuery


@dataclass(frozen=True, slots=True)
class Example:
    """A command, what it asks for, and what it means.

    `grounding[i]` is the symbol (object or attribute value) that argument `i` of the query means in this example. It
    tells homonyms apart: the phrase `bag` is the toy `bag_toy` or the container `bag`.
    """

    domain: Domain
    text: str
    query: ContextualQuery
    ltl: str
    grounding: tuple[str, ...]

    @property
    def task(self) -> str:
        """The task class."""
        return self.query.task

    @property
    def distinct(self) -> bool:
        """Whether no two arguments are the same phrase, as the CQ-LTL algorithm needs (paper, § CQ-LTL Algorithm)."""
        return len(set(self.query.arguments)) == len(self.query.arguments)


@dataclass(frozen=True, slots=True)
class Dataset:
    """The seen examples S and the unseen examples U of one domain, in a fixed order."""

    domain: Domain
    seen: tuple[Example, ...]
    unseen: tuple[Example, ...]


def generate(domain: Domain | str) -> Dataset:
    """S and U of a domain (`"manipulation"` or `"navigation"`), the same on every call."""
    return _generate(Domain(domain))


@cache
def _generate(domain: Domain) -> Dataset:
    corpus = read_corpus(domain)
    return Dataset(domain, tuple(_examples(corpus, Part.SEEN)), tuple(_examples(corpus, Part.UNSEEN)))


def by_task(examples: Iterable[Example]) -> dict[str, list[Example]]:
    """The examples of each task class, both in order of occurrence."""
    groups: dict[str, list[Example]] = {}
    for example in examples:
        groups.setdefault(example.task, []).append(example)
    return groups


def _examples(corpus: Corpus, part: Part) -> Iterator[Example]:
    for task in corpus.tasks:
        choices = product(*(corpus.vocabulary[part][slot] for slot in task.arguments))
        for choice, wording in product(choices, task.wordings):
            yield _example(corpus.domain, task, wording, choice)


def _example(domain: Domain, task: Task, wording: str, choice: tuple[Word, ...]) -> Example:
    phrases = {slot: word.phrase for slot, word in zip(task.arguments, choice, strict=True)}
    symbols = {slot: word.symbol for slot, word in zip(task.arguments, choice, strict=True)}
    return Example(
        domain=domain,
        text=wording.format_map(phrases),
        query=ContextualQuery(task.name, tuple(phrases.values())),
        ltl=task.ltl.format_map(symbols),
        grounding=tuple(symbols.values()),
    )
