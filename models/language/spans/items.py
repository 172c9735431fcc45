"""What the network is fitted to: folded words, the task they ask for, and where they mention its arguments."""

from __future__ import annotations

import random
from collections.abc import Callable, Iterator, Sequence, Set
from dataclasses import dataclass, replace

import torch
from torch import Tensor

from models.language.dataset import Example
from models.language.encoder import WordReader
from models.language.spans.config import SpanConfig
from models.language.spans.network import SpanNet, TextBatch, log_likelihood
from models.language.spans.tags import Span, tags_of
from models.language.teaching.utterance import DETERMINERS
from models.language.tokens import words


@dataclass(frozen=True, slots=True)
class Item:
    """A text and its reading; `task` is None when no task fits it.

    `frame` is how many words before and after the command itself are only there to be polite.
    """

    text: tuple[str, ...]
    task: str | None = None
    mentions: tuple[tuple[Span, ...], ...] = ()
    frame: tuple[int, int] = (0, 0)

    @classmethod
    def command(cls, example: Example) -> Item:
        """An example of a dataset."""
        return cls(words(example.text), example.task, example.mentions)

    @property
    def mentioned(self) -> frozenset[int]:
        """The places of the words that name arguments."""
        return frozenset(place for spans in self.mentions for begin, end in spans for place in range(begin, end))

    def around(self, inner: Item) -> Item:
        """The same, known to be a frame around `inner`."""
        before = min(self.mentions)[0][0] - min(inner.mentions)[0][0]
        return replace(self, frame=(before, len(self.text) - len(inner.text) - before))

    def within(self, before: Sequence[str], after: Sequence[str]) -> Item:
        """The same in a frame of words."""
        shift = len(before)
        moved = tuple(tuple((begin + shift, end + shift) for begin, end in spans) for spans in self.mentions)
        start, stop = self.frame
        return Item((*before, *self.text, *after), self.task, moved, (start + shift, stop + len(after)))

    def hidden(self, rate: float, frame_rate: float, generator: random.Random) -> list[bool]:
        """Which words lose their embedding: each with probability `rate`, and the whole frame with `frame_rate`."""
        before, after = self.frame
        inside = range(before, len(self.text) - after)
        hide_frame = generator.random() < frame_rate
        return [(hide_frame and place not in inside) or generator.random() < rate for place in range(len(self.text))]

    def renamed(self, phrases: Sequence[Sequence[str]], *, alone: Set[int] = frozenset()) -> Item:
        """The same command of other things: argument `i` is named by `phrases[i]`; those that stand `alone` have no
        determiner in front.
        """
        begins = {begin: (end, argument) for argument, spans in enumerate(self.mentions) for begin, end in spans}
        text: list[str] = []
        mentions: list[list[Span]] = [[] for _ in self.mentions]
        place = 0
        while place < len(self.text):
            if place in begins:
                end, argument = begins[place]
                if argument in alone and text and text[-1] in DETERMINERS:
                    text.pop()
                mentions[argument].append((len(text), len(text) + len(phrases[argument])))
                text += phrases[argument]
                place = end
            else:
                text.append(self.text[place])
                place += 1
        return replace(self, text=tuple(text), mentions=tuple(map(tuple, mentions)))

    def respelled(self, place: int, word: str) -> Item:
        """The same with another word at a place."""
        return replace(self, text=(*self.text[:place], word, *self.text[place + 1 :]))


def batches(items: Sequence[Item], size: int, generator: random.Random) -> Iterator[list[Item]]:
    """The items in random order, `size` at a time. Texts of similar length go together, to pad less."""
    order = sorted(generator.sample(items, len(items)), key=lambda item: len(item.text) + generator.random() * 4)
    groups = [order[start : start + size] for start in range(0, len(order), size)]
    generator.shuffle(groups)
    yield from groups


def likelihood(
    network: SpanNet,
    items: Sequence[Item],
    encoder: WordReader,
    *,
    hidden: Sequence[Sequence[bool]] | None = None,
    temperature: float = 1.0,
) -> Tensor:
    """The log-probabilities [B] of the items' readings; `hidden` as in `TextBatch.of`."""
    return likelihoods(network, items, encoder, hidden=hidden)(temperature)


def likelihoods(
    network: SpanNet, items: Sequence[Item], encoder: WordReader, *, hidden: Sequence[Sequence[bool]] | None = None
) -> Callable[[float], Tensor]:
    """As `likelihood`, by temperature: the texts are read once for all temperatures."""
    config = network.config
    numbers = {word: number for number, word in enumerate(config.words, start=1)}
    batch = TextBatch.of([item.text for item in items], numbers, encoder, hidden=hidden).to(network.device)
    tasks, tags = _answers(items, config, batch.numbers.shape[1])
    scores = network(batch)
    return lambda temperature: log_likelihood(network, scores, batch, tasks, tags, temperature=temperature)


def _answers(items: Sequence[Item], config: SpanConfig, width: int) -> tuple[Tensor, Tensor]:
    """The right tasks [B] and tags [B, S]."""
    order = {task: number for number, (task, _) in enumerate(config.tasks)}
    tags = torch.zeros(len(items), width, dtype=torch.int64)
    for row, item in enumerate(items):
        tags[row, : len(item.text)] = torch.tensor(tags_of(len(item.text), item.mentions))
    tasks = [config.no_task if item.task is None else order[item.task] for item in items]
    return torch.tensor(tasks), tags
