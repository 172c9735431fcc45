"""Several networks of the same classes that read together: what one of them mistakes, the others seldom do as well."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field, replace

from models.language.spans.reader import Read, SpanReader, SpanReading
from models.language.spans.tags import Span

HELD = 16
"""Texts that are held."""


@dataclass(frozen=True, slots=True, eq=False)
class SpanEnsemble:
    """Readers that were trained alike with different seeds; probabilities are their means.

    An error of reading is rather one of training's chances than of its data, so that the mean of networks is right more
    often than any of them, and doubts where they disagree (Lakshminarayanan, Pritzel, Blundell, "Simple and scalable
    predictive uncertainty estimation using deep ensembles", NeurIPS 2017).
    """

    readers: Sequence[SpanReader]
    _held: dict[tuple[str, ...], Read] = field(default_factory=dict, repr=False)

    def __post_init__(self) -> None:
        if not self.readers:
            raise ValueError("an ensemble has a reader")

    @property
    def words(self) -> frozenset[str]:
        """The words with embeddings of their own."""
        return frozenset(word for reader in self.readers for word in reader.model.config.words)

    def read(self, spoken: Sequence[str]) -> Read:
        """The readings of one text that any reader has, by class in the order of the first reader's, each class's best
        first, and the probability that no class fits. What was read last is held: it is asked for more than once.
        """
        key = tuple(spoken)
        read = self._held.get(key)
        if read is None:
            read = self._read(key)
            if len(self._held) >= HELD:
                self._held.clear()
            self._held[key] = read
        return read

    def _read(self, spoken: Sequence[str]) -> Read:
        share = 1 / len(self.readers)
        found: dict[tuple[str, tuple[tuple[Span, ...], ...]], SpanReading] = {}
        refusal = 0.0
        for reader in self.readers:
            readings, none = reader.read(spoken)
            refusal += share * none
            for reading in readings:
                key = (reading.task, reading.mentions)
                before = found[key].probability if key in found else 0.0
                found[key] = replace(reading, probability=before + share * reading.probability)
        order = {task: place for place, (task, _) in enumerate(self.readers[0].model.config.tasks)}
        return tuple(sorted(found.values(), key=lambda one: (order[one.task], -one.probability))), refusal
