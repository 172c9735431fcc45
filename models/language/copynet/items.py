"""What the networks are fitted to: the words of a command with the output words that answer it, in batches."""

from __future__ import annotations

import random
from collections.abc import Collection, Iterator, Sequence
from dataclasses import dataclass

from models.language.copynet.batch import SourceBatch, TargetBatch
from models.language.copynet.formulas import spell_formula
from models.language.copynet.queries import spell_query
from models.language.copynet.vocabulary import Vocabulary
from models.language.copynet.weights import System
from models.language.dataset import Example
from models.language.tokens import words
from models.logic import parse


@dataclass(frozen=True, slots=True)
class Item:
    """A command and its two answers, as words."""

    text: tuple[str, ...]
    query: tuple[str, ...]
    formula: tuple[str, ...]

    @classmethod
    def of(cls, example: Example) -> Item:
        """An example of a dataset."""
        return cls(words(example.text), spell_query(example.query), spell_formula(parse(example.ltl), example.domain))

    def answer(self, system: System) -> tuple[str, ...]:
        """What the network of a system is to answer."""
        return self.query if system is System.CQ else self.formula


def copied_words(items: Sequence[Item], system: System) -> frozenset[str]:
    """The words of answers that are to be copied: those of their texts, but no answer's first: a task or `F`."""
    answers = [(item.text, item.answer(system)) for item in items]
    spoken = {word for text, (_, *rest) in answers for word in rest if word in text}
    return frozenset(spoken - {first for _, (first, *_) in answers})


def hidden_words(text: Sequence[str], rate: float, generator: random.Random) -> frozenset[str]:
    """Draw the words of a text to hide, each with probability `rate`, all its occurrences together."""
    return frozenset(word for word in dict.fromkeys(text) if generator.random() < rate)


def to_batch(
    texts: Sequence[Sequence[str]],
    answers: Sequence[Sequence[str]],
    hidden: Sequence[Collection[str]],
    vocabulary: Vocabulary,
) -> tuple[SourceBatch, TargetBatch]:
    """Texts and answers as tensors; the words in `hidden[i]` are unknown words in text `i`, to be copied."""
    sources = [vocabulary.source(text, hidden=absent) for text, absent in zip(texts, hidden, strict=True)]
    targets = [vocabulary.target(answer, source) for answer, source in zip(answers, sources, strict=True)]
    return SourceBatch.of(sources, vocabulary), TargetBatch.of(targets, vocabulary)


def batches(items: Sequence[Item], size: int, generator: random.Random) -> Iterator[list[Item]]:
    """The items in random order, `size` at a time. Texts of similar length go together, to pad less."""
    order = sorted(generator.sample(items, len(items)), key=lambda item: len(item.text) + generator.random() * 4)
    groups = [order[start : start + size] for start in range(0, len(order), size)]
    generator.shuffle(groups)
    yield from groups
