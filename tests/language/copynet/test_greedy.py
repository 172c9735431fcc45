"""Greedy decoding in batches, against the same text alone, one word at a time."""

from __future__ import annotations

import pytest
import torch

from models.language.copynet import greedy
from models.language.copynet.batch import SourceBatch
from models.language.copynet.greedy import greedy_search
from models.language.copynet.network import CopyNet, log_probabilities
from models.language.copynet.vocabulary import END, Source, Vocabulary
from models.language.copynet.weights import build_network

TEXTS = ["take the ball", "zorb", "take zorb and blarg and zorb", "the the the", "ball blarg", "take the red zorb now"]


@pytest.fixture
def vocabulary() -> Vocabulary:
    return Vocabulary.build([["take", "the", "ball", "and"]], [["pickup", "(", "ball", ")", END]])


@pytest.fixture
def network(vocabulary: Vocabulary) -> CopyNet:
    torch.manual_seed(5)
    network = build_network(vocabulary, embedding=6, encoder=5, decoder=7).double().eval()
    with torch.no_grad():
        for parameter in network.parameters():
            parameter.mul_(3.0)  # away from zero, so that the outputs differ
    return network


def _alone(network: CopyNet, vocabulary: Vocabulary, source: Source, steps: int) -> tuple[int, ...]:
    batch = SourceBatch.of([source], vocabulary)
    said = [vocabulary.start]
    with torch.no_grad():
        memory, state = network.encode(batch)
        while len(said) <= steps and vocabulary.end not in said:
            scores, state = network.step(torch.tensor(said[-1:]), state, memory)
            said.append(int(log_probabilities(scores, batch)[0].argmax()))
    return tuple(said[1:])


@pytest.mark.parametrize("size", [1, 4, 512])
@pytest.mark.parametrize("steps", [1, 3, 9])
def test_a_batch_answers_as_each_alone(
    network: CopyNet, vocabulary: Vocabulary, monkeypatch: pytest.MonkeyPatch, size: int, steps: int
) -> None:
    monkeypatch.setattr(greedy, "BATCH", size)
    sources = [vocabulary.source(text.split()) for text in TEXTS]
    found = greedy_search(network, vocabulary, sources, steps=steps)
    assert found == [_alone(network, vocabulary, source, steps) for source in sources]
    assert len(set(found)) > 1


def test_an_output_stops_at_its_end(network: CopyNet, vocabulary: Vocabulary) -> None:
    with torch.no_grad():
        network.generate.bias[vocabulary.end] = 100.0
    sources = [vocabulary.source(text.split()) for text in TEXTS]
    assert greedy_search(network, vocabulary, sources, steps=9) == [(vocabulary.end,)] * len(TEXTS)


def test_no_text(network: CopyNet, vocabulary: Vocabulary) -> None:
    assert greedy_search(network, vocabulary, [], steps=9) == []
