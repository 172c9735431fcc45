"""The sizes of the default translator's networks, and the tensors that go with them."""

from __future__ import annotations

from dataclasses import dataclass

from models.language.spans.tags import MOST_ARGUMENTS, tag_count


@dataclass(frozen=True, slots=True)
class SpanConfig:
    """The sizes of a network.

    Attributes:
        words: the words with embeddings of their own, by number from 1; 0 stands for all others.
        tasks: the task classes, in the order of the network's outputs, with their numbers of arguments. One output
            more, the last, says that no task fits.
        vector: D.
    """

    words: tuple[str, ...]
    tasks: tuple[tuple[str, int], ...]
    vector: int
    embedding: int = 48
    projection: int = 96  # of the encoder's vectors
    encoder: int = 96  # in each direction and layer
    layers: int = 2
    dropout: float = 0.25

    def __post_init__(self) -> None:
        if len(set(self.words)) != len(self.words) or len(dict(self.tasks)) != len(self.tasks):
            raise ValueError("a network knows every word and every task once")
        if not all(0 <= arity <= MOST_ARGUMENTS for _, arity in self.tasks):
            raise ValueError(f"a task has between 0 and {MOST_ARGUMENTS} arguments")

    @property
    def no_task(self) -> int:
        """The output that says that no task fits, K."""
        return len(self.tasks)

    @property
    def tags(self) -> int:
        """L."""
        return tag_count(arity for _, arity in self.tasks)

    @property
    def states(self) -> int:
        """H, of both directions."""
        return 2 * self.encoder

    def shapes(self) -> dict[str, tuple[int, ...]]:
        """The shapes of the tensors by name, as in `models.language.spans.network.SpanNet`."""
        tasks, tags, gates = len(self.tasks), self.tags, 3 * self.encoder
        found: dict[str, tuple[int, ...]] = {
            "embedding.weight": (len(self.words) + 1, self.embedding),
            "projection.weight": (self.projection, self.vector),
            "projection.bias": (self.projection,),
            "task.weight": (tasks + 1, 2 * self.states),
            "task.bias": (tasks + 1,),
            "tag.weight": (tasks * tags, self.states),
            "tag.bias": (tasks * tags,),
            "transition": (tasks, tags, tags),
        }
        for layer, direction in ((layer, direction) for layer in range(self.layers) for direction in ("", "_reverse")):
            given = self.states if layer else self.embedding + self.projection
            for kind, shape in (("weight_ih", (gates, given)), ("weight_hh", (gates, self.encoder))):
                found[f"encoder.{kind}_l{layer}{direction}"] = shape
            for kind in ("bias_ih", "bias_hh"):
                found[f"encoder.{kind}_l{layer}{direction}"] = (gates,)
        return found
