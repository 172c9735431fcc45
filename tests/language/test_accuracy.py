"""Counting right answers, checked with a translator whose answers are known."""

from __future__ import annotations

import pytest
import torch

from models.language import Translation, accuracy
from models.language.accuracy import Tally
from models.language.copynet import loss
from models.language.dataset import generate
from models.language.items import command, refusal, to_batch, vocabulary_of
from models.language.weights import build_network
from models.queries import ContextualQuery


class _Parrot:
    """Says that everything is a pickup of the last word, and nothing of texts with a question mark."""

    def translate(self, text: str, *, candidates: int = 1) -> tuple[Translation, ...]:
        if "?" in text:
            return ()
        return (Translation(ContextualQuery("pickup", (text.split()[-1],)), 1.0),)


def test_by_task() -> None:
    tallies = accuracy.by_task(_Parrot(), generate("manipulation").unseen)
    # right where the wording ends with the object: as often for each of the 6 objects
    ending = [w for w in generate("manipulation").unseen if w.task == "pickup" and w.text.endswith("hammer")]
    assert tallies["pickup"] == Tally(6 * len(ending), 108)
    assert {task: tally.right for task, tally in tallies.items() if task != "pickup"} == {
        "move_to": 0,
        "pickup_colored": 0,
        "ship": 0,
    }


def test_refusals() -> None:
    assert accuracy.refusals(_Parrot(), ["who?", "me", "where?"]) == Tally(2, 3)


def test_tally() -> None:
    assert str(Tally(3, 4)) == "3/4 = 75.00%"
    assert Tally(0, 0).rate == 1.0


def test_greedy() -> None:
    """Loss and exact answers of a mixed batch equal those of one text at a time, word by word."""
    items = [command(example) for example in generate("navigation").unseen[::60]] + [refusal("what is it")]
    vocabulary = vocabulary_of(items)
    torch.manual_seed(1)
    network = build_network(vocabulary, embedding=8, encoder=8, decoder=8).eval()
    optimizer = torch.optim.Adam(network.parameters(), lr=0.02)
    for _ in range(25):  # until some answers are right and others are not
        source, target = to_batch(items, [()] * len(items), vocabulary)
        optimizer.zero_grad()
        loss(network(source, target), source, target).backward()
        optimizer.step()
    singles = [accuracy.greedy(network, vocabulary, [item]) for item in items]
    together = accuracy.greedy(network, vocabulary, items)
    assert together[0] == pytest.approx(sum(value for value, _ in singles) / len(items), rel=1e-4)
    assert together[1] == sum(right for _, right in singles) / len(items)
    assert accuracy.greedy(network, vocabulary, items, hide=True)[0] != together[0]
