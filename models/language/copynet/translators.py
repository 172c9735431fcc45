"""The three systems as translators of single texts, with beam search and confidences.

Each has a network for each domain, and a text does not say which domain it is of. A reading's confidence is the
network's probability for it times the share of its domain: that falls tenfold with every word of the text that T of the
domain does not have. A word that no domain has tells nothing, so new names do not count.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Self, TypeVar

from models.language.copynet.formulas import read_formula
from models.language.copynet.queries import is_spoken, query_or_none, read_query
from models.language.copynet.search import best_outputs, first_words
from models.language.copynet.tagged import arguments
from models.language.copynet.weights import Model, System, load_model
from models.language.dataset import Domain
from models.language.tagging import tagged
from models.language.tokens import words
from models.language.translation import BEAM_WIDTH, NEGATIONS, Translation
from models.logic import Formula
from models.queries import ContextualQuery

STRANGE = 0.1
"""What a word that its T lacks costs a domain."""

_Reading = TypeVar("_Reading", ContextualQuery, Formula)


@dataclass(frozen=True, slots=True)
class FormulaTranslation:
    """A reading of a text as grounded LTL, and the translator's probability for it, between 0 and 1."""

    formula: Formula
    confidence: float


@dataclass(frozen=True, slots=True, eq=False)
class _Networks:
    """The networks of one system."""

    models: tuple[Model, ...]

    def _shares(self, spoken: Sequence[str]) -> Iterator[tuple[Model, float]]:
        """Each network with the share of its domain; the shares add up to 1."""
        strange = [STRANGE ** sum(word not in model.vocabulary for word in spoken) for model in self.models]
        for model, share in zip(self.models, strange, strict=True):
            yield model, share / sum(strange)


@dataclass(frozen=True, slots=True, eq=False)
class CqCopyNetTranslator(_Networks):
    """CQ-CopyNet (paper, § Training Pipelines).

    An output is dropped when it is malformed, or when an argument is no phrase of the text; one with more or fewer
    arguments than its task takes is kept. There is no reading of a text with one of `NEGATIONS`.
    """

    @classmethod
    def load(cls, folder: Path | None = None) -> Self:
        """The networks of both domains in a folder; without a folder, those that are shipped.

        Raises:
            WeightsError: one is missing, damaged, or does not fit the code.
        """
        return cls(_load(System.CQ, folder))

    def translate(self, text: str, *, candidates: int = 1) -> tuple[Translation, ...]:
        """See `Translator`; at most `BEAM_WIDTH` candidates."""
        spoken = _commanded(text)
        readings = [
            (query, share * probability)
            for model, share in self._shares(spoken)
            for spelled, probability in (best_outputs(model, spoken, width=BEAM_WIDTH) if spoken else ())
            if (query := read_query(spelled)) is not None and is_spoken(query, spoken)
        ]
        return tuple(Translation(*reading) for reading in _best(readings, candidates))


@dataclass(frozen=True, slots=True, eq=False)
class CqCopyNetPosTranslator(_Networks):
    """CQ-CopyNet+POS (paper, § Training Pipelines): the network's task classes, each with the same arguments.

    The arguments are the nouns and adjectives of the text, as `models.language.copynet.tagged` finds them, whether or
    not the task takes so many. There is no reading of a text with one of `NEGATIONS`.
    """

    @classmethod
    def load(cls, folder: Path | None = None) -> Self:
        """See `CqCopyNetTranslator.load`."""
        return cls(_load(System.CQ, folder))

    def translate(self, text: str, *, candidates: int = 1) -> tuple[Translation, ...]:
        """See `Translator`; at most `BEAM_WIDTH` candidates."""
        spoken = _commanded(text)
        (tokens,) = tagged([text])
        phrases = arguments(tokens)
        readings = [
            (query, share * probability)
            for model, share in self._shares(spoken)
            for task, probability in (first_words(model, spoken, width=BEAM_WIDTH) if spoken else ())
            if (query := query_or_none(task, phrases)) is not None
        ]
        return tuple(Translation(*reading) for reading in _best(readings, candidates))


@dataclass(frozen=True, slots=True, eq=False)
class LtlCopyNetTranslator(_Networks):
    """LTL-CopyNet (paper, § Training Pipelines): grounded LTL, whatever environment it is meant for.

    A malformed output is dropped. `models.world.resolve` says whether an environment has what the formula speaks of.
    There is no reading of a text with one of `NEGATIONS`.
    """

    @classmethod
    def load(cls, folder: Path | None = None) -> Self:
        """See `CqCopyNetTranslator.load`."""
        return cls(_load(System.LTL, folder))

    def translate(self, text: str, *, candidates: int = 1) -> tuple[FormulaTranslation, ...]:
        """Up to `candidates` readings, most probable first; at most `BEAM_WIDTH`. See `Translator`."""
        spoken = _commanded(text)
        readings = [
            (formula, share * probability)
            for model, share in self._shares(spoken)
            for spelled, probability in (best_outputs(model, spoken, width=BEAM_WIDTH) if spoken else ())
            if (formula := read_formula(spelled, model.domain)) is not None
        ]
        return tuple(FormulaTranslation(*reading) for reading in _best(readings, candidates))


def _load(system: System, folder: Path | None) -> tuple[Model, ...]:
    return tuple(load_model(system, domain, folder) for domain in Domain)


def _commanded(text: str) -> tuple[str, ...]:
    """The words of a text; none when one of them turns the command round."""
    spoken = words(text)
    return spoken if NEGATIONS.isdisjoint(spoken) else ()


def _best(readings: Iterable[tuple[_Reading, float]], candidates: int) -> list[tuple[_Reading, float]]:
    """The most probable readings, each once with all its probability; the first of equals was found first."""
    if candidates < 1:
        raise ValueError("at least one candidate must be asked for")
    totals: dict[_Reading, float] = {}
    for reading, probability in readings:
        totals[reading] = totals.get(reading, 0.0) + probability
    best = sorted(totals.items(), key=lambda item: -item[1])
    return best[: min(candidates, BEAM_WIDTH)]
