"""The sizes of the matching network, its tags, and the tensors that go with them."""

from __future__ import annotations

from dataclasses import dataclass

TAGS = 3
OUTSIDE, BEGIN, ON = range(TAGS)
LEFT = 2
"""Words before a mention that tell the part it plays: "to the", "instead of the"."""


@dataclass(frozen=True, slots=True)
class MatchConfig:
    """The sizes of a network; `vector` is D, `role` is R."""

    vector: int
    role: int = 96
    dropout: float = 0.3

    @property
    def word(self) -> int:
        """V."""
        return self.vector // 2

    def shapes(self) -> dict[str, tuple[int, ...]]:
        """The shapes of the tensors by name, as in `models.language.matching.network.MatchNet`."""
        sizes = {
            "word": (self.word, self.word),
            "salience": (1, self.vector),
            "role": (self.role, 2 * self.vector),
            "tag": (TAGS, self.vector),
        }
        weights: dict[str, tuple[int, ...]] = {f"{name}.weight": size for name, size in sizes.items()}
        biases: dict[str, tuple[int, ...]] = {f"{name}.bias": size[:1] for name, size in sizes.items()}
        return weights | biases | {"transition": (TAGS, TAGS)}
