"""How often a translator is right: exact contextual queries on S and U by task class, and refusals of other text."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass

import torch

from models.language.copynet import CopyNet, log_probabilities, loss
from models.language.dataset import Example
from models.language.items import Item, to_batch
from models.language.translator import Translator
from models.language.vocabulary import Vocabulary


@dataclass(frozen=True, slots=True)
class Tally:
    """Right answers out of all."""

    right: int
    total: int

    @property
    def rate(self) -> float:
        """Part of the answers that are right; 1 of none."""
        return self.right / self.total if self.total else 1.0

    def __str__(self) -> str:
        return f"{self.right}/{self.total} = {self.rate:.2%}"


def by_task(translator: Translator, examples: Iterable[Example]) -> dict[str, Tally]:
    """Per task class, how often the best reading is exactly the example's query; no reading is wrong."""
    outcomes: dict[str, list[bool]] = {}
    for example in examples:
        readings = translator.translate(example.text)
        right = bool(readings) and readings[0].query == example.query
        outcomes.setdefault(example.task, []).append(right)
    return {task: Tally(sum(results), len(results)) for task, results in outcomes.items()}


def refusals(translator: Translator, texts: Iterable[str]) -> Tally:
    """How often a text that no task fits gets no reading."""
    results = [not translator.translate(text) for text in texts]
    return Tally(sum(results), len(results))


@torch.inference_mode()
def greedy(
    network: CopyNet, vocabulary: Vocabulary, items: Sequence[Item], *, hide: bool = False
) -> tuple[float, float]:
    """Mean loss, and the part of the items whose answer is the most probable word at every step.

    That is what greedy decoding would get right, found without decoding. With `hide` every phrase that may be hidden
    is, which shows how the network does on words that it never saw.
    """
    network.eval()
    total, right = 0.0, 0
    order = sorted(items, key=lambda item: len(item.text))
    for start in range(0, len(order), 256):
        chunk = order[start : start + 256]
        hidden = [[word for phrase in item.phrases if hide for word in phrase] for item in chunk]
        source, target = to_batch(chunk, hidden, vocabulary)
        scores = network(source, target)  # [B, T, G + S]
        total += float(loss(scores, source, target)) * len(chunk)
        best = torch.stack(
            [log_probabilities(step, source).argmax(dim=1) for step in scores.unbind(dim=1)], dim=1
        )  # [B, T]
        right += int(((best == target.words) | ~target.mask).all(dim=1).sum())
    return total / len(items), right / len(items)
