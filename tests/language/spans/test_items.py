from __future__ import annotations

import random

import pytest
import torch
from hypothesis import given, settings
from hypothesis import strategies as st

from models.language.dataset import Domain, fill, generate
from models.language.encoder import encoder
from models.language.spans.config import SpanConfig
from models.language.spans.decoding import best_sequences
from models.language.spans.items import Item, batches, likelihood
from models.language.spans.network import SpanNet, TextBatch
from models.language.spans.tags import mentions_of

SHIP = "Put the {object} in the {container}, then put the {container} in the {location}"


def test_a_command_is_renamed_wherever_it_mentions_an_argument() -> None:
    example = fill(
        Domain.MANIPULATION, "ship", SHIP, {"object": "teddy bear", "container": "box", "location": "kitchen"}
    )
    item = Item.command(example)
    assert item.mentions == (((2, 4),), ((6, 7), (10, 11)), ((13, 14),))
    renamed = item.renamed([("mug",), ("tool", "chest"), ("front", "porch")])
    assert " ".join(renamed.text) == "put the mug in the tool chest then put the tool chest in the front porch"
    assert renamed.mentions == (((2, 3),), ((5, 7), (10, 12)), ((14, 16),))
    assert renamed.renamed([("teddy", "bear"), ("box",), ("kitchen",)]) == item
    assert renamed.mentioned == {2, 5, 6, 10, 11, 14, 15}


@given(number=st.integers(0, 4649), seed=st.integers(0, 99))
@settings(deadline=None)  # the first example makes the dataset
def test_the_words_of_a_mention_are_the_argument(number: int, seed: int) -> None:
    example = generate(Domain.MANIPULATION).seen[number]
    generator = random.Random(seed)
    phrases = [tuple(generator.choices("abc", k=generator.randint(1, 3))) for _ in example.query.arguments]
    item = Item.command(example).renamed(phrases)
    for spans, phrase in zip(item.mentions, phrases, strict=True):
        assert {item.text[begin:end] for begin, end in spans} == {phrase}


def test_batches_hold_every_item_once() -> None:
    items = [Item(("go",) * (1 + number % 7)) for number in range(50)]
    drawn = [item for chunk in batches(items, 8, random.Random(0)) for item in chunk]
    assert sorted(map(id, drawn)) == sorted(map(id, items))


@pytest.fixture(scope="module")
def network() -> SpanNet:
    with torch.random.fork_rng(devices=[]):
        torch.manual_seed(0)
        config = SpanConfig(
            words=("take", "the", "from"), tasks=(("take", 1), ("move", 2)), vector=encoder().size, encoder=8
        )
        return SpanNet(config).eval()


@torch.inference_mode()
def test_the_probabilities_of_all_readings_of_a_text_add_up_to_one(network: SpanNet) -> None:
    text = ("take", "the", "mug")
    total = float(likelihood(network, [Item(text)], encoder()).exp())  # that no task fits
    numbers = {word: number for number, word in enumerate(network.config.words, start=1)}
    scores = network(TextBatch.of([text], numbers, encoder()))
    for task, (name, arity) in enumerate(network.config.tasks):
        field = (
            network.tag(scores.states[0]).unflatten(1, (len(network.config.tasks), -1))[:, task],
            network.transition[task] + network.allowed[task],
            network.allowed_start[task],
        )
        (found,) = best_sequences(*(tensor.double().numpy()[None] for tensor in field), count=10_000)
        for _, tags in found:
            item = Item(text, name, mentions_of(tags, arity))
            total += float(likelihood(network, [item], encoder()).exp())
    assert total == pytest.approx(1.0, abs=1e-4)


@torch.inference_mode()
def test_padding_changes_nothing(network: SpanNet) -> None:
    short = Item(("take", "the", "mug"), "take", (((2, 3),),))
    long = Item(("take", "the", "claw", "hammer", "from", "the", "shed"), "move", (((2, 4),), ((6, 7),)))
    alone = [float(likelihood(network, [item], encoder())) for item in (short, long, Item(("mug",)))]
    together = likelihood(network, [short, long, Item(("mug",))], encoder()).tolist()
    assert together == pytest.approx(alone, abs=1e-5)


@torch.inference_mode()
def test_a_hidden_word_reads_like_one_without_an_embedding(network: SpanNet) -> None:
    numbers = {word: number for number, word in enumerate(network.config.words, start=1)}
    batch = TextBatch.of([("take", "the")], numbers, encoder(), hidden=[[False, True]])
    assert batch.numbers.tolist() == [[1, 0]]
    assert torch.equal(batch.vectors, TextBatch.of([("take", "the")], numbers, encoder()).vectors)
