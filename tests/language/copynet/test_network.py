"""The network against CopyNet's equations, recomputed one number at a time with numpy (Gu et al. 2016)."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import pytest
import torch
from numpy.typing import NDArray

from models.language.copynet.batch import SourceBatch, TargetBatch
from models.language.copynet.network import CopyNet, log_probabilities, loss
from models.language.copynet.vocabulary import END, Vocabulary
from models.language.copynet.weights import build_network

Array = NDArray[np.float64]

# zorb is unknown and stands twice; ball is known, can be generated, and stands once; "the" can only be copied.
TEXT = ("take", "zorb", "the", "ball", "zorb")
ANSWER = ("pickup", "zorb", "ball", "the", "zorb", END)


@pytest.fixture
def vocabulary() -> Vocabulary:
    return Vocabulary.build([["take", "the", "ball"]], [["pickup", "(", "ball", ")", END], ["again", END]])


@pytest.fixture
def network(vocabulary: Vocabulary) -> CopyNet:
    torch.manual_seed(3)
    network = build_network(vocabulary, embedding=5, encoder=3, decoder=4).double().eval()
    with torch.no_grad():
        for parameter in network.parameters():
            parameter.mul_(2.0)  # away from zero, so that the scores differ
    return network


@dataclass
class ByHand:
    """CopyNet in numpy: one text, no batch, no padding."""

    weights: dict[str, Array]
    vocabulary: Vocabulary

    def gru(self, inputs: Array, hidden: Array, prefix: str, suffix: str = "") -> Array:
        """One step of a GRU in PyTorch's convention: reset, update, new."""
        w, u = self.weights[f"{prefix}weight_ih{suffix}"], self.weights[f"{prefix}weight_hh{suffix}"]
        b, c = self.weights[f"{prefix}bias_ih{suffix}"], self.weights[f"{prefix}bias_hh{suffix}"]
        (xr, xz, xn), (hr, hz, hn) = np.split(w @ inputs + b, 3), np.split(u @ hidden + c, 3)
        reset, update = 1 / (1 + np.exp(-xr - hr)), 1 / (1 + np.exp(-xz - hz))
        return (1 - update) * np.tanh(xn + reset * hn) + update * hidden

    def linear(self, name: str, inputs: Array) -> Array:
        return self.weights[f"{name}.weight"] @ inputs + self.weights.get(f"{name}.bias", np.zeros(1))

    def encode(self, ids: tuple[int, ...]) -> tuple[list[Array], Array]:
        forward, backward = [np.zeros(3)], [np.zeros(3)]
        for number in ids:
            forward.append(self.gru(self.weights["embedding.weight"][number], forward[-1], "encoder.", "_l0"))
        for number in reversed(ids):
            backward.append(self.gru(self.weights["embedding.weight"][number], backward[-1], "encoder.", "_l0_reverse"))
        states = [np.concatenate(pair) for pair in zip(forward[1:], backward[:0:-1], strict=True)]
        return states, np.tanh(self.linear("bridge", np.concatenate([forward[-1], backward[-1]])))

    def answer(self, text: tuple[str, ...], answer: tuple[str, ...]) -> list[dict[str, float]]:
        """Probability of every word at every step, given the answer so far."""
        ids = tuple(self.vocabulary.number(word) for word in text)
        states, hidden = self.encode(ids)
        previous, said, steps = self.vocabulary.start, "", []
        copy_scores: list[float] = [0.0] * len(text)
        for word in answer:
            scores = [
                float(
                    (
                        self.weights["attention.weight"]
                        @ np.tanh(self.linear("attention_key", h) + self.weights["attention_query.weight"] @ hidden)
                    )[0]
                )
                for h in states
            ]
            attention = np.exp(scores) / np.exp(scores).sum()
            attended = sum((a * h for a, h in zip(attention, states, strict=True)), np.zeros(6))
            here = [np.exp(score) if token == said else 0.0 for token, score in zip(text, copy_scores, strict=True)]
            total = sum(here) or 1.0  # K; a word that stands nowhere reads nothing
            selected = sum((r / total * h for r, h in zip(here, states, strict=True)), np.zeros(6))
            inputs = np.concatenate([self.weights["embedding.weight"][previous], attended, selected])
            hidden = self.gru(inputs, hidden, "decoder.")
            generate = self.linear("generate", hidden)
            copy_scores = [float(np.tanh(self.linear("copy", h)) @ hidden) for h in states]
            normaliser = np.exp(generate).sum() + np.exp(copy_scores).sum()  # both modes together
            probability = {
                w: float(np.exp(s) / normaliser) for w, s in zip(self.vocabulary.words, generate, strict=False)
            }
            for token, score in zip(text, copy_scores, strict=True):
                probability[token] = probability.get(token, 0.0) + float(np.exp(score) / normaliser)
            steps.append(probability)
            previous, said = self.vocabulary.number(word), word
        return steps


def _by_hand(network: CopyNet, vocabulary: Vocabulary) -> ByHand:
    weights = {name: tensor.detach().numpy() for name, tensor in network.state_dict().items()}
    return ByHand(weights, vocabulary)


def _tensors(
    vocabulary: Vocabulary, pairs: list[tuple[tuple[str, ...], tuple[str, ...]]]
) -> tuple[SourceBatch, TargetBatch]:
    sources = [vocabulary.source(text) for text, _ in pairs]
    targets = [vocabulary.target(answer, source) for (_, answer), source in zip(pairs, sources, strict=True)]
    return SourceBatch.of(sources, vocabulary), TargetBatch.of(targets, vocabulary)


def test_probabilities_over_the_extended_vocabulary(network: CopyNet, vocabulary: Vocabulary) -> None:
    source, target = _tensors(vocabulary, [(TEXT, ANSWER)])
    scores = network(source, target)
    expected = _by_hand(network, vocabulary).answer(TEXT, ANSWER)
    for step, probability in enumerate(expected):
        row = log_probabilities(scores[:, step], source).exp()[0]  # [E]
        assert row.sum().item() == pytest.approx(1.0, abs=1e-12)
        words = vocabulary.spell(range(len(row)), ["zorb"])
        found = {word: value for word, value in zip(words, row.tolist(), strict=True) if value > 0}
        assert found == pytest.approx(probability, rel=1e-9)


def test_loss(network: CopyNet, vocabulary: Vocabulary) -> None:
    steps = _by_hand(network, vocabulary).answer(TEXT, ANSWER)
    expected = -sum(np.log(step[word]) for step, word in zip(steps, ANSWER, strict=True))
    source, target = _tensors(vocabulary, [(TEXT, ANSWER)])
    assert loss(network(source, target), source, target).item() == pytest.approx(float(expected), rel=1e-9)


def test_padding_changes_nothing(network: CopyNet, vocabulary: Vocabulary) -> None:
    short = (("the", "blarg"), ("pickup", "blarg", END))
    alone = [_tensors(vocabulary, [pair]) for pair in (short, (TEXT, ANSWER))]
    together = _tensors(vocabulary, [short, (TEXT, ANSWER)])
    separate = [loss(network(*tensors), *tensors).item() for tensors in alone]
    assert loss(network(*together), *together).item() == pytest.approx(sum(separate) / 2, rel=1e-9)
    first = log_probabilities(network(*alone[0])[:, 1], alone[0][0])[0]  # [E]
    padded = log_probabilities(network(*together)[:, 1], together[0])[0]  # [E]
    assert padded.exp().sum().item() == pytest.approx(1.0, abs=1e-12)
    assert padded[: len(first)].tolist() == pytest.approx(first.tolist(), rel=1e-9)


def test_selective_read_follows_the_copied_word(network: CopyNet, vocabulary: Vocabulary) -> None:
    """Two unknown words share one embedding; only the selective read tells the decoder which was said."""
    text = ("take", "zorb", "the", "blarg")
    source, said_zorb = _tensors(vocabulary, [(text, ("zorb", END))])
    _, said_blarg = _tensors(vocabulary, [(text, ("blarg", END))])
    after_zorb, after_blarg = network(source, said_zorb)[0, 1], network(source, said_blarg)[0, 1]
    assert (after_zorb - after_blarg).abs().max().item() > 1e-3


def test_every_weight_gets_a_finite_gradient(network: CopyNet, vocabulary: Vocabulary) -> None:
    source, target = _tensors(vocabulary, [(TEXT, ANSWER), (("the", "blarg"), ("pickup", "blarg", END))])
    loss(network(source, target), source, target).backward()
    for name, parameter in network.named_parameters():
        assert parameter.grad is not None, name
        assert bool(parameter.grad.isfinite().all()), name
        assert bool((parameter.grad != 0).any()), name


def test_gradient_equals_finite_differences(network: CopyNet, vocabulary: Vocabulary) -> None:
    source, target = _tensors(vocabulary, [(TEXT, ANSWER)])
    loss(network(source, target), source, target).backward()
    for parameter in (network.copy.weight, network.generate.weight, network.attention.weight):
        assert parameter.grad is not None
        flat = parameter.data.view(-1)
        values = []
        for change in (1e-6, -2e-6):
            flat[0] += change
            values.append(loss(network(source, target), source, target).item())
        flat[0] += 1e-6
        assert (values[0] - values[1]) / 2e-6 == pytest.approx(parameter.grad.view(-1)[0].item(), rel=1e-4, abs=1e-7)
