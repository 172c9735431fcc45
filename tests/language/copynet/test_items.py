"""Training items: answers, what is to be copied, what is hidden, padded batches, order."""

from __future__ import annotations

import random

from models.language.copynet.items import Item, batches, copied_words, hidden_words, to_batch
from models.language.copynet.vocabulary import END, Vocabulary
from models.language.copynet.weights import System
from models.language.dataset import generate

BEAR = next(e for e in generate("manipulation").seen if e.text.startswith("Pick up the red teddy bear"))
SHOP = next(e for e in generate("navigation").seen if e.text == "Go to the coffee shop")


def _item(text: str, query: str = "pickup ( ball )") -> Item:
    return Item(tuple(text.split()), (*query.split(), END), ("F", "(", "holding_ball", ")", END))


def test_items_of_examples() -> None:
    bear = Item.of(BEAR)
    assert bear.text == ("pick", "up", "the", "red", "teddy", "bear")
    assert bear.answer(System.CQ) == ("pickup_colored", "(", "teddy", "bear", ",", "red", ")", END)
    assert bear.answer(System.LTL) == ("F", "(", "holding_teddy_bear", "&", "teddy_bear_is_red", ")", END)
    shop = Item.of(SHOP)
    assert shop.answer(System.CQ) == ("navigate_one", "(", "coffee", "shop", ")", END)
    assert shop.answer(System.LTL) == ("F", "(", "coffee", "shop", ")", END)


def test_copied_words() -> None:
    """The names that stand in the text, but not the task that does, and no compound proposition."""
    items = [Item.of(BEAR), Item.of(SHOP)]
    assert copied_words(items, System.CQ) == {"teddy", "bear", "red", "coffee", "shop"}
    assert copied_words(items, System.LTL) == {"coffee", "shop"}
    assert copied_words([_item("pickup the ball")], System.CQ) == {"ball"}
    assert copied_words([_item("lift the pickup", "pickup ( pickup )")], System.CQ) == set()


def test_hidden_words() -> None:
    text = ("put", "the", "ball", "in", "the", "box")
    generator = random.Random(0)
    assert hidden_words(text, 0.0, generator) == frozenset()
    assert hidden_words(text, 1.0, generator) == set(text)
    draws = [hidden_words(text, 0.25, generator) for _ in range(2_000)]
    for word in text:  # within five standard deviations
        assert abs(sum(word in draw for draw in draws) / 2_000 - 0.25) < 0.05
    assert len(set(draws)) == 2 ** len(set(text))


def test_batch() -> None:
    items = [_item("pick up the red ball"), _item("pickup the ball")]
    texts, answers = [item.text for item in items], [item.query for item in items]
    vocabulary = Vocabulary.build(texts, answers, copied=copied_words(items, System.CQ))
    source, target = to_batch(texts, answers, [{"red", "ball"}, ()], vocabulary)
    size = len(vocabulary)
    assert source.size == size + 2
    assert source.lengths.tolist() == [5, 3]
    assert source.mask.tolist() == [[True] * 5, [True] * 3 + [False] * 2]
    assert source.ids[0, 3:].tolist() == [vocabulary.unknown] * 2
    assert source.extended[0, 3:].tolist() == [size, size + 1]
    assert source.extended[1].tolist() == [*(vocabulary.number(word) for word in texts[1]), -1, -1]
    assert (source.ids[1, 3:] == vocabulary.pad).all()
    assert target.words[:, 2].tolist() == [size + 1, vocabulary.number("ball")]
    assert target.previous[:, 0].tolist() == [vocabulary.start] * 2
    assert target.previous[0, 1:].tolist() == target.words[0, :-1].tolist()
    assert target.mask.all()


def test_batches_hold_every_item_once() -> None:
    items = [_item(f"say {'very ' * (index % 7)} {index}") for index in range(50)]
    groups = list(batches(items, 8, random.Random(0)))
    assert sorted(item.text for group in groups for item in group) == sorted(item.text for item in items)
    assert [len(group) for group in groups].count(8) == 6
    assert groups == list(batches(items, 8, random.Random(0)))
    assert groups != list(batches(items, 8, random.Random(1)))
