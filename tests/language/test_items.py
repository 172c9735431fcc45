"""Training items: answers, what is hidden, padded batches, order."""

from __future__ import annotations

import random
from itertools import chain

from models.language.dataset import generate
from models.language.items import at_least, batches, command, hidden_words, refusal, to_batch, vocabulary_of
from models.language.vocabulary import END, NO_TASK

BEAR = next(e for e in generate("manipulation").seen if e.text.startswith("Pick up the red teddy bear"))


def test_command_and_refusal() -> None:
    item = command(BEAR)
    assert item.text == ("pick", "up", "the", "red", "teddy", "bear")
    assert item.answer == ("pickup_colored", "(", "teddy", "bear", ",", "red", ")", END)
    assert item.phrases == (("teddy", "bear"), ("red",))
    assert not item.is_refusal
    other = refusal("What is what?")
    assert other.is_refusal
    assert (other.text, other.answer) == (("what", "is", "what"), (NO_TASK, END))
    assert other.phrases == (("what",), ("is",))


def test_hidden_words() -> None:
    item, generator = command(BEAR), random.Random(0)
    drawn = {hidden_words(item, 0.5, generator) for _ in range(100)}
    phrases = [{"teddy", "bear"}, {"red"}]
    assert drawn == {frozenset(), frozenset(phrases[0]), frozenset(phrases[1]), frozenset(chain(*phrases))}
    assert hidden_words(item, 0.0, generator) == frozenset()
    assert hidden_words(item, 1.0, generator) == {"teddy", "bear", "red"}


def test_batch() -> None:
    items = [command(BEAR), refusal("what is it")]
    vocabulary = vocabulary_of(items)
    source, target = to_batch(items, [{"red"}, ()], vocabulary)
    size = len(vocabulary)
    assert source.size == size + 1
    assert source.lengths.tolist() == [6, 3]
    assert source.mask.tolist() == [[True] * 6, [True] * 3 + [False] * 3]
    assert source.ids[0, 3] == vocabulary.unknown
    assert source.extended[0, 3] == size
    assert source.extended[1].tolist() == [*(vocabulary.number(w) for w in ("what", "is", "it")), -1, -1, -1]
    assert (source.ids[1, 3:] == vocabulary.pad).all()
    spelled = vocabulary.spell(target.words[0].tolist(), ["red"])
    assert spelled == items[0].answer
    assert target.words[0, 5] == size
    assert target.previous[:, 0].tolist() == [vocabulary.start] * 2
    assert target.previous[0, 1:].tolist() == target.words[0, :-1].tolist()
    assert target.mask.tolist() == [[True] * 8, [True] * 2 + [False] * 6]


def test_small_classes_are_repeated() -> None:
    assert at_least(3, [BEAR]) == [BEAR] * 3
    pair = [BEAR, generate("navigation").seen[0]]
    assert at_least(3, pair) == pair * 2
    assert at_least(1, pair) == at_least(2, pair) == pair


def test_batches_hold_every_item_once() -> None:
    items = [refusal(f"say {'very ' * (index % 7)} {index}") for index in range(50)]
    groups = list(batches(items, 8, random.Random(0)))
    assert sorted(item.text for group in groups for item in group) == sorted(item.text for item in items)
    assert [len(group) for group in groups].count(8) == 6
    assert groups == list(batches(items, 8, random.Random(0)))
    assert groups != list(batches(items, 8, random.Random(1)))
