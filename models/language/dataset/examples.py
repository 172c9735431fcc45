"""Examples: wordings of task classes filled with phrases; S and U, every wording with every choice (paper, Table I)."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass
from functools import cache, lru_cache
from itertools import product
from string import Formatter

from models.errors import Place
from models.language.dataset.corpus import Corpus, Domain, Part, Task, Word, read_corpus
from models.language.errors import VocabularyError
from models.language.tokens import words
from models.queries import ContextualQuery

Span = tuple[int, int]
"""A half-open range of the words of a text, as `models.language.tokens.words` counts them."""

_AFTER = (" ", ",", "?", "!", ";", ":", ". ")
"""What may stand right after a slot: what the tokeniser ends a word at."""


@dataclass(frozen=True, slots=True)
class Example:
    """A command, what it asks for, and what it means.

    `grounding[i]` is the symbol (object or attribute value) that argument `i` of the query means in this example. It
    tells homonyms apart: the phrase `bag` is the toy `bag_toy` or the container `bag`. `mentions[i]` are the places of
    the text that mention argument `i`, left to right. They are those of the wording's slots and not found by search, so
    that "the orange orange" has two.
    """

    domain: Domain
    text: str
    query: ContextualQuery
    ltl: str
    grounding: tuple[str, ...]
    mentions: tuple[tuple[Span, ...], ...]

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


def fill(domain: Domain | str, task: str, wording: str, phrases: Mapping[str, str | Word]) -> Example:
    """The example that a wording of a task class says of some phrases, by slot.

    A phrase means the symbol of its own name, a `Word` the one that it names.

    Raises:
        KeyError: the domain has no such task class.
        VocabularyError: the slots of the wording or the phrases are not those of the task; a slot stands inside a word;
            a phrase is not in the tokeniser's form.
    """
    domain = Domain(domain)
    chosen = {slot: phrase if isinstance(phrase, Word) else Word.of(phrase) for slot, phrase in phrases.items()}
    for word in chosen.values():
        if not word.phrase or " ".join(words(word.phrase)) != word.phrase:
            raise _wrong(f"{word.phrase!r} is not in lower case, or holds punctuation")
    return _fill(domain, read_corpus(domain).task(task), wording, chosen)


def _examples(corpus: Corpus, part: Part) -> Iterator[Example]:
    for task in corpus.tasks:
        choices = product(*(corpus.vocabulary[part][slot] for slot in task.arguments))
        for choice, wording in product(choices, task.wordings):
            yield _fill(corpus.domain, task, wording, dict(zip(task.arguments, choice, strict=True)))


def _fill(domain: Domain, task: Task, wording: str, chosen: Mapping[str, Word]) -> Example:
    pieces = _pieces(wording)
    if not {slot for _, _, slot in pieces if slot is not None} == set(chosen) == set(task.arguments):
        raise _wrong(f"{wording!r} and its phrases must have exactly the slots {', '.join(task.arguments)}")
    text, at = "", 0
    mentions: dict[str, list[Span]] = {slot: [] for slot in task.arguments}
    for literal, count, slot in pieces:
        text, at = text + literal, at + count
        if slot is not None:
            phrase = chosen[slot].phrase
            start, at = at, at + len(phrase.split())
            mentions[slot].append((start, at))
            text += phrase
    symbols = {slot: chosen[slot].symbol for slot in task.arguments}
    return Example(
        domain=domain,
        text=text,
        query=ContextualQuery(task.name, tuple(chosen[slot].phrase for slot in task.arguments)),
        ltl=task.ltl.format_map(symbols),
        grounding=tuple(symbols.values()),
        mentions=tuple(tuple(spans) for spans in mentions.values()),
    )


@lru_cache(maxsize=4096)
def _pieces(wording: str) -> tuple[tuple[str, int, str | None], ...]:
    """The text before each slot with its number of words, and the slot; the last text has None."""
    try:
        parsed = [(literal, slot) for literal, slot, _, _ in Formatter().parse(wording)]
    except ValueError as error:
        raise _wrong(f"{wording!r}: {error}") from None
    for index, (literal, slot) in enumerate(parsed):
        after = parsed[index + 1][0] if index + 1 < len(parsed) else " "
        if slot is not None and not (literal.endswith(" ") or index == 0 == len(literal)):
            raise _wrong(f"{wording!r}: no space stands before the slot {slot}")
        if slot is not None and not (after.startswith(_AFTER) or after == "."):
            raise _wrong(f"{wording!r}: the slot {slot} ends inside a word")
    return tuple((literal, len(words(literal)), slot) for literal, slot in parsed)


def _wrong(detail: str) -> VocabularyError:
    return VocabularyError(detail, places=[Place("", detail)])
