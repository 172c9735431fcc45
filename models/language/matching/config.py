"""The sizes of the matching network, its tags, and the tensors that go with them."""

from __future__ import annotations

from dataclasses import dataclass

from models.language.encoder.layers import layer_shapes
from models.language.encoder.minilm import LAYERS, LOWER

TAGS = 3
OUTSIDE, BEGIN, ON = range(TAGS)
LEFT = 2
"""Words before a mention that tell the part it plays: "to the", "instead of the"."""
UPPER = range(LOWER, LAYERS)
"""The layers of MiniLM that are fitted."""


@dataclass(frozen=True, slots=True)
class MatchConfig:
    """The sizes of a network; `vector` is D, `role` is R."""

    vector: int
    role: int = 96
    dropout: float = 0.3

    @property
    def hidden(self) -> int:
        """H, and V."""
        return self.vector // 2

    def shapes(self) -> dict[str, tuple[int, ...]]:
        """The shapes of the tensors by name, but for those of the layers: as in `MatchNet`."""
        sizes = {"role": (self.role, 2 * self.vector), "tag": (TAGS, self.vector)}
        weights: dict[str, tuple[int, ...]] = {f"{name}.weight": size for name, size in sizes.items()}
        biases: dict[str, tuple[int, ...]] = {f"{name}.bias": size[:1] for name, size in sizes.items()}
        return weights | biases | {"transition": (TAGS, TAGS)}

    def upper_shapes(self) -> dict[str, tuple[int, ...]]:
        """The shapes of the tensors of the layers, named as MiniLM's."""
        return {name: shape for number in UPPER for name, shape in layer_shapes(number, self.hidden).items()}
