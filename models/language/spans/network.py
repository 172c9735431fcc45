"""The network of the default translator: which task a text asks for, and which of its words name the arguments.

Words are known by what they do, not by what they name: those of wordings ("put", "then", "the") have embeddings of
their own, all others only what the encoder says of them in their sentence. So a phrase that training never held is
read like one that it did, which is lifting (paper, § Approach) applied to the words. A bidirectional GRU reads both;
one head scores the task classes, another the tags of every word under each, and a conditional random field per task
class joins the tags.

Shapes: B texts, S words, D encoder, H states, K task classes, L tags.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Self

import torch
from torch import Tensor, nn
from torch.nn.utils.rnn import pack_padded_sequence, pad_packed_sequence

from models.language.encoder import WordReader
from models.language.runtime import Floats
from models.language.spans.config import SpanConfig
from models.language.spans.crf import log_partition, score
from models.language.spans.model import SpanModel
from models.language.spans.tags import forbidden_moves


@dataclass(frozen=True, slots=True)
class TextBatch:
    """B texts of up to S words, padded at the end."""

    numbers: Tensor  # [B, S] int64, words with embeddings; 0 for the others
    vectors: Tensor  # [B, S, D] float32
    lengths: Tensor  # [B] int64, on the CPU wherever the others are

    @classmethod
    def of(
        cls,
        texts: Sequence[Sequence[str]],
        numbers: Mapping[str, int],
        encoder: WordReader,
        *,
        hidden: Sequence[Sequence[bool]] | None = None,
    ) -> Self:
        """Folded words as tensors; each text has a word. `hidden[i][j]` takes the embedding of a word j away."""
        width = max(len(text) for text in texts)
        ids = torch.zeros(len(texts), width, dtype=torch.int64)
        for row, text in enumerate(texts):
            known = [numbers.get(word, 0) for word in text]
            if hidden is not None:
                known = [0 if absent else number for number, absent in zip(known, hidden[row], strict=True)]
            ids[row, : len(text)] = torch.tensor(known)
        vectors = torch.from_numpy(encoder.read(texts).copy())
        return cls(ids, vectors, torch.tensor([len(text) for text in texts]))

    def to(self, device: torch.device) -> TextBatch:
        """The same on a device."""
        return TextBatch(self.numbers.to(device), self.vectors.to(device), self.lengths)


@dataclass(frozen=True, slots=True)
class Scores:
    """What the network says of B texts."""

    tasks: Tensor  # [B, K + 1], not normalised
    states: Tensor  # [B, S, H], of which the scores of tags are made


class SpanNet(nn.Module):
    """Encoder, task classifier, and one conditional random field per task class."""

    allowed: Tensor
    allowed_start: Tensor

    def __init__(self, config: SpanConfig) -> None:
        super().__init__()
        self.config = config
        tasks, tags, states = len(config.tasks), config.tags, config.states
        self.embedding = nn.Embedding(len(config.words) + 1, config.embedding)
        self.projection = nn.Linear(config.vector, config.projection)
        self.dropout = nn.Dropout(config.dropout)
        self.encoder = nn.GRU(
            config.embedding + config.projection,
            config.encoder,
            num_layers=config.layers,
            dropout=config.dropout if config.layers > 1 else 0.0,
            batch_first=True,
            bidirectional=True,
        )
        self.task = nn.Linear(2 * states, tasks + 1)
        self.tag = nn.Linear(states, tasks * tags)
        self.transition = nn.Parameter(torch.zeros(tasks, tags, tags))
        rules = [forbidden_moves(arity, tags) for _, arity in config.tasks]
        self.register_buffer("allowed", torch.tensor([moves for moves, _ in rules]), persistent=False)  # [K, L, L]
        self.register_buffer("allowed_start", torch.tensor([start for _, start in rules]), persistent=False)  # [K, L]

    @classmethod
    def of(cls, model: SpanModel) -> Self:
        """The network of a model, to be learned from."""
        with torch.random.fork_rng(devices=[]):  # its first values are thrown away; the caller's generator stays
            network = cls(model.config)
        network.load_state_dict({name: torch.from_numpy(tensor.copy()) for name, tensor in model.tensors.items()})
        return network.eval()

    def tensors(self) -> dict[str, Floats]:
        """What was learned, by name."""
        return {name: tensor.cpu().numpy().copy() for name, tensor in self.state_dict().items()}

    @torch.no_grad()
    def reading_like(self, other: SpanNet) -> None:
        """Take over how another network reads: its embeddings of the words that both know, and all layers below the
        heads. What tasks and tags are made of it stays to be learned.

        Raises ValueError when the layers differ in size.
        """
        numbers = {word: number for number, word in enumerate(other.config.words, start=1)}
        for number, word in enumerate(self.config.words, start=1):
            if word in numbers:
                self.embedding.weight[number] = other.embedding.weight[numbers[word]]
        self.embedding.weight[0] = other.embedding.weight[0]
        for mine, others in ((self.projection, other.projection), (self.encoder, other.encoder)):
            theirs = others.state_dict()
            if any(theirs[name].shape != tensor.shape for name, tensor in mine.state_dict().items()):
                raise ValueError("a network can read only like one of the same sizes")
            mine.load_state_dict(theirs)

    @property
    def device(self) -> torch.device:
        """Where it is."""
        return self.embedding.weight.device

    def forward(self, batch: TextBatch) -> Scores:
        """Score the tasks, and read the words."""
        meant = torch.tanh(self.projection(batch.vectors))  # [B, S, projection]
        read = self.dropout(torch.cat([self.embedding(batch.numbers), meant], dim=2))  # [B, S, E]
        states = self._encoded(read, batch.lengths)  # [B, S, H]
        lengths = batch.lengths.to(self.device)[:, None]  # [B, 1]
        here = (torch.arange(states.shape[1], device=self.device) < lengths)[:, :, None]  # [B, S, 1]
        highest = states.masked_fill(~here, -1.0).amax(dim=1)  # [B, H]; a GRU's states lie between -1 and 1
        mean = (states * here).sum(dim=1) / lengths  # [B, H]
        states = self.dropout(states)
        return Scores(self.task(self.dropout(torch.cat([highest, mean], dim=1))), states)

    def _encoded(self, read: Tensor, lengths: Tensor) -> Tensor:
        """[B, S, H] the states of texts [B, S, E]."""
        packed = pack_padded_sequence(read, lengths, batch_first=True, enforce_sorted=False)
        states, _ = pad_packed_sequence(self.encoder(packed)[0], batch_first=True)
        return states


def log_likelihood(
    network: SpanNet, scores: Scores, batch: TextBatch, tasks: Tensor, tags: Tensor, *, temperature: float = 1.0
) -> Tensor:
    """The log-probabilities [B] of the right answers: of the task, and of the tags under it when there is one.

    Args:
        tasks: [B] int64, K where no task fits.
        tags: [B, S] int64; ignored where no task fits.
        temperature: what all scores are divided by.

    Wherever the network is, answers and results are on the CPU, where the many small steps of the field are faster.
    """
    task = (scores.tasks.cpu() / temperature).log_softmax(dim=1).gather(1, tasks[:, None]).squeeze(1)  # [B]
    asked = tasks < network.config.no_task  # [B]
    if not bool(asked.any()):
        return task
    rows, lengths = asked.nonzero().squeeze(1), batch.lengths[asked]  # [N], [N]
    chosen, kinds = rows.to(network.device), tasks[asked].to(network.device)  # [N], [N]
    every = network.tag(scores.states[chosen]).unflatten(2, (len(network.config.tasks), -1))  # [N, S, K, L]
    emissions = every[torch.arange(len(kinds), device=network.device), :, kinds].cpu() / temperature  # [N, S, L]
    transitions = (network.transition / temperature + network.allowed)[kinds].cpu()  # [N, L, L]
    start = network.allowed_start[kinds].cpu()  # [N, L]
    said = score(emissions, transitions, start, lengths, tags[asked])  # [N]
    total = log_partition(emissions, transitions, start, lengths)  # [N]
    return task.index_add(0, rows, said - total)
