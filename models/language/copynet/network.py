"""CopyNet: a sequence-to-sequence network whose output words are generated or copied from the input.

Gu, Lu, Li, Li, *Incorporating Copying Mechanism in Sequence-to-Sequence Learning*, ACL 2016. Generate mode scores the
G output words of the vocabulary, copy mode scores the S positions of the input, and one softmax normalises the two
together. A word's probability is the sum over every way to say it: it may be generated, and copied from each place
where it stands, so words that the vocabulary lacks get probability from copying alone.

Shapes: B texts, S input words, T output words, G output vocabulary, E extended vocabulary, D encoder states, H decoder
states.
"""

from __future__ import annotations

from dataclasses import dataclass

import torch
from torch import Tensor, nn
from torch.nn.utils.rnn import pack_padded_sequence, pad_packed_sequence

from models.language.copynet.batch import SourceBatch, TargetBatch


@dataclass(frozen=True, slots=True)
class NetworkConfig:
    """The sizes of a network. `words` and `outputs` are the vocabulary's, `unknown` its number for words it lacks."""

    words: int
    outputs: int
    unknown: int
    embedding: int = 64
    encoder: int = 96  # in each direction, so D = 192
    decoder: int = 128  # H
    dropout: float = 0.2


@dataclass(frozen=True, slots=True)
class Memory:
    """What the decoder reads at every step: the encoded text, and what each use of it needs, computed once."""

    states: Tensor  # [B, S, D]
    keys: Tensor  # [B, S, H] for attention
    copies: Tensor  # [B, S, H] for the copy mode
    source: SourceBatch

    def repeat(self, count: int) -> Memory:
        """The memory of one text `count` times over."""
        return Memory(
            states=self.states.expand(count, -1, -1),  # [count, S, D]
            keys=self.keys.expand(count, -1, -1),  # [count, S, H]
            copies=self.copies.expand(count, -1, -1),  # [count, S, H]
            source=self.source.repeat(count),
        )


@dataclass(frozen=True, slots=True)
class State:
    """The decoder between two words."""

    hidden: Tensor  # [B, H]
    copied: Tensor  # [B, S] copy scores of the word just said, for the selective read

    def select(self, rows: Tensor) -> State:
        """The states at `rows` [N]."""
        return State(self.hidden[rows], self.copied[rows])


class CopyNet(nn.Module):
    """Bidirectional GRU encoder, attentive GRU decoder, generate and copy modes."""

    def __init__(self, config: NetworkConfig) -> None:
        super().__init__()
        self.config = config
        size, states, hidden = config.embedding, 2 * config.encoder, config.decoder
        self.embedding = nn.Embedding(config.words, size)
        self.dropout = nn.Dropout(config.dropout)
        self.encoder = nn.GRU(size, config.encoder, batch_first=True, bidirectional=True)
        self.bridge = nn.Linear(states, hidden)
        self.attention_key = nn.Linear(states, hidden)
        self.attention_query = nn.Linear(hidden, hidden, bias=False)
        self.attention = nn.Linear(hidden, 1, bias=False)
        self.decoder = nn.GRUCell(size + 2 * states, hidden)
        self.generate = nn.Linear(hidden, config.outputs)
        self.copy = nn.Linear(states, hidden)

    def encode(self, source: SourceBatch) -> tuple[Memory, State]:
        """Read the texts: the memory, and the decoder's state before its first word."""
        embedded = self.dropout(self.embedding(source.ids))  # [B, S, embedding]
        packed = pack_padded_sequence(embedded, source.lengths, batch_first=True, enforce_sorted=False)
        packed_states, last = self.encoder(packed)  # last: [2, B, D / 2], the final state of each direction
        states, _ = pad_packed_sequence(packed_states, batch_first=True)  # [B, S, D]
        hidden = torch.tanh(self.bridge(torch.cat([last[0], last[1]], dim=1)))  # [B, H]
        memory = Memory(
            states=states,
            keys=self.attention_key(states),  # [B, S, H]
            copies=torch.tanh(self.copy(states)),  # [B, S, H]
            source=source,
        )
        return memory, State(hidden, torch.zeros_like(source.ids, dtype=states.dtype))

    def step(self, previous: Tensor, state: State, memory: Memory) -> tuple[Tensor, State]:
        """Score what comes after the words `previous` [B] (extended numbers).

        Returns scores [B, G + S], first the generate mode and then the copy mode, not normalised; -inf at padding.
        """
        known = previous.masked_fill(previous >= self.config.words, self.config.unknown)  # [B]
        embedded = self.dropout(self.embedding(known))  # [B, embedding]
        attended = self._attentive_read(state, memory)  # [B, D]
        selected = selective_read(previous, state.copied, memory)  # [B, D]
        hidden = self.decoder(torch.cat([embedded, attended, selected], dim=1), state.hidden)  # [B, H]
        generated = self.generate(hidden)  # [B, G]
        copied = torch.einsum("bsh,bh->bs", memory.copies, hidden)  # [B, S]
        copied = copied.masked_fill(~memory.source.mask, -torch.inf)  # [B, S]
        return torch.cat([generated, copied], dim=1), State(hidden, copied)

    def forward(self, source: SourceBatch, target: TargetBatch) -> Tensor:
        """Scores [B, T, G + S] of every output word given those before it (teacher forcing)."""
        memory, state = self.encode(source)
        scores = []
        for previous in target.previous.unbind(dim=1):  # [B]
            score, state = self.step(previous, state, memory)  # [B, G + S]
            scores.append(score)
        return torch.stack(scores, dim=1)  # [B, T, G + S]

    def _attentive_read(self, state: State, memory: Memory) -> Tensor:
        """The encoder states averaged by additive attention (Bahdanau et al. 2015): [B, D]."""
        query = self.attention_query(state.hidden)[:, None]  # [B, 1, H]
        scores = self.attention(torch.tanh(memory.keys + query)).squeeze(2)  # [B, S]
        weights = scores.masked_fill(~memory.source.mask, -torch.inf).softmax(dim=1)  # [B, S]
        return torch.einsum("bs,bsd->bd", weights, memory.states)


def selective_read(previous: Tensor, copied: Tensor, memory: Memory) -> Tensor:
    """The encoder states at the places the previous word may have been copied from, by its copy scores (§ 3.3).

    Args:
        previous: [B] extended numbers.
        copied: [B, S] copy scores of the step that said it.

    Returns: [B, D]; zero where the word does not stand in the text.
    """
    here = memory.source.extended == previous[:, None]  # [B, S]
    lowest = torch.finfo(copied.dtype).min  # finite: a row of -inf would make the gradient nan
    weights = copied.masked_fill(~here, lowest).softmax(dim=1).masked_fill(~here, 0.0)  # [B, S]
    return torch.einsum("bs,bsd->bd", weights, memory.states)


def log_probabilities(scores: Tensor, source: SourceBatch) -> Tensor:
    """Log-probabilities [B, E] over the extended vocabulary from the scores [B, G + S] of one step.

    One softmax over both modes; what stands for the same word is added up. Words that can be neither generated nor
    copied get -inf.
    """
    joint = scores.softmax(dim=1)  # [B, G + S]
    batch, generated = scores.shape[0], scores.shape[1] - source.ids.shape[1]
    probability = torch.zeros(batch, source.size, dtype=joint.dtype)  # [B, E]
    probability[:, :generated] = joint[:, :generated]
    places = source.extended.clamp(min=0)  # [B, S]; padding adds nothing, its probability is 0
    probability.scatter_add_(1, places, joint[:, generated:])
    return probability.log()


def loss(scores: Tensor, source: SourceBatch, target: TargetBatch) -> Tensor:
    """Mean over the B texts of the negative log-probability of the whole target, from scores [B, T, G + S]."""
    batch, _, width = scores.shape
    generated = width - source.ids.shape[1]
    numbers = torch.arange(generated)  # [G]
    generates = target.words[:, :, None] == numbers  # [B, T, G]
    copies = target.words[:, :, None] == source.extended[:, None]  # [B, T, S]
    says = torch.cat([generates, copies], dim=2)  # [B, T, G + S], every way to say the target word
    said = scores.masked_fill(~says, -torch.inf).logsumexp(dim=2)  # [B, T]
    log_probability = said - scores.logsumexp(dim=2)  # [B, T]
    return -log_probability.masked_fill(~target.mask, 0.0).sum() / batch
