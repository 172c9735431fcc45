"""How large an evaluation is."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field, replace
from typing import Self

from models.language import copynet
from models.language.spans import training as spans

Done = Callable[[str], None]
"""Told of every step that is done, and what it was, to show progress."""


@dataclass(frozen=True, slots=True)
class Settings:
    """What is trained and how much is asked.

    Attributes:
        points: at how many epochs the paper's systems are measured; the first and the last are among them.
        taught: commands of T that the paper's networks are fitted to, and as many at most to validate; None for all.
        most: commands of each task class that are asked of S and of U; None for all.
        open_world: commands of W in each domain.
        paraphrases: commands in held-out wordings, for each task class and vocabulary.
        refusals: held-out texts without a task; None for all.
    """

    seeds: tuple[int, ...] = (0, 1, 2)
    copynet: copynet.Settings = field(default_factory=copynet.Settings)
    spans: spans.Settings = field(default_factory=spans.Settings)
    points: int = 10
    taught: int | None = None
    most: int | None = None
    open_world: int = 1000
    paraphrases: int = 60
    refusals: int | None = None

    @property
    def epochs(self) -> tuple[int, ...]:
        """The epochs at which the paper's systems are measured: more at the start, where curves are steep."""
        last, count = self.copynet.epochs, max(2, min(self.points, self.copynet.epochs))
        wanted = [round(last ** (step / (count - 1))) for step in range(count)]
        epochs: list[int] = []
        for epoch in wanted:
            epochs.append(max(epoch, epochs[-1] + 1 if epochs else 1))
        return tuple(dict.fromkeys(min(epoch, last) for epoch in epochs))

    def quick(self) -> Self:
        """The smallest evaluation that goes through everything: figures without meaning, in less than a minute."""
        return replace(
            self,
            seeds=self.seeds[:1],
            copynet=replace(self.copynet, epochs=2),
            spans=replace(self.spans, epochs=1, share=0.03),
            taught=200,
            most=2,
            open_world=10,
            paraphrases=1,
            refusals=10,
        )
