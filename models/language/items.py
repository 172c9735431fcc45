"""What the network is fitted to: texts as words with the output words that answer them."""

from __future__ import annotations

import random
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from math import ceil

from models.language.batch import SourceBatch, TargetBatch
from models.language.dataset import Example
from models.language.output import spell
from models.language.tokens import words
from models.language.vocabulary import Vocabulary


@dataclass(frozen=True, slots=True)
class Item:
    """A text and its answer as words; `phrases` are groups of words of the text that may be hidden together."""

    text: tuple[str, ...]
    answer: tuple[str, ...]
    phrases: tuple[tuple[str, ...], ...]

    @property
    def is_refusal(self) -> bool:
        """Whether no task fits the text."""
        return self.answer == spell(None)


def command(example: Example) -> Item:
    """An example of a dataset; what may be hidden are the arguments of its query."""
    phrases = tuple(words(phrase) for phrase in example.query.arguments)
    return Item(words(example.text), spell(example.query), phrases)


def refusal(text: str) -> Item:
    """A text that no task fits; any word of it may be hidden."""
    spoken = words(text)
    return Item(spoken, spell(None), tuple((word,) for word in dict.fromkeys(spoken)))


def vocabulary_of(items: Sequence[Item]) -> Vocabulary:
    """Every word of the items; what the answers hold can be generated."""
    return Vocabulary.build((item.text for item in items), (item.answer for item in items))


def hidden_words(item: Item, rate: float, generator: random.Random) -> frozenset[str]:
    """Draw the words to hide: each phrase of the item with probability `rate`."""
    return frozenset(word for phrase in item.phrases if generator.random() < rate for word in phrase)


def to_batch(
    items: Sequence[Item], hidden: Sequence[Iterable[str]], vocabulary: Vocabulary
) -> tuple[SourceBatch, TargetBatch]:
    """Items as tensors; the words in `hidden[i]` are unknown words in item `i`, to be copied and not generated."""
    sources = [
        vocabulary.source(item.text, hidden=frozenset(absent)) for item, absent in zip(items, hidden, strict=True)
    ]
    targets = [vocabulary.target(item.answer, source) for item, source in zip(items, sources, strict=True)]
    return SourceBatch.of(sources, vocabulary), TargetBatch.of(targets, vocabulary)


def at_least(count: int, group: Sequence[Example]) -> list[Example]:
    """The examples of a task class, repeated as often as it takes to have at least `count`."""
    return list(group) * max(1, ceil(count / len(group)))


def batches(items: Sequence[Item], size: int, generator: random.Random) -> Iterator[list[Item]]:
    """The items in random order, `size` at a time. Texts of similar length go together, to pad less."""
    order = sorted(generator.sample(items, len(items)), key=lambda item: len(item.text) + generator.random() * 4)
    groups = [order[start : start + size] for start in range(0, len(order), size)]
    generator.shuffle(groups)
    yield from groups
