"""From a command to what it may mean: taught wordings first, then the translator."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, replace

from models.errors import CqltlError
from models.language import BEAM_WIDTH, ComposedTranslator, TaughtTranslator
from models.language.reading import (
    AMBIGUOUS,
    GROUNDED,
    SENSELESS,
    FormulaReading,
    Reading,
    rank,
    rank_formulas,
    read,
)
from models.logic import Formula
from models.queries import Binding, GroundedQuery, Path, Query, explain_query
from models.world import Environment, explain
from service.services import Services
from service.store import StoredTemplate
from service.taught import Taught
from service.translators import DEFAULT


@dataclass(frozen=True, slots=True)
class Meaning:
    """A formula; and unless it was said as a formula, the query as it was grounded, the warnings of the templates, and
    by task the words that were taught for it.
    """

    formula: Formula
    grounded: GroundedQuery | None = None
    warnings: tuple[str, ...] = ()
    words: tuple[tuple[str, str], ...] = ()

    @property
    def query(self) -> Query | None:
        """The query, unless it was said as a formula."""
        return None if self.grounded is None else self.grounded.query

    @property
    def bindings(self) -> tuple[tuple[Path, Binding], ...]:
        """What the arguments of the query were bound to, each with the path of its task."""
        return () if self.grounded is None else self.grounded.bindings

    def explanation(self, environment: Environment | None) -> str:
        """What it asks for, in the words that were taught for its tasks, else as its formula reads."""
        if self.grounded is None or not self.words:
            return explain(self.formula, environment)
        return explain_query(self.grounded, dict(self.words), environment).explanation

    @classmethod
    def of(cls, grounded: GroundedQuery, stored: Iterable[StoredTemplate]) -> Meaning:
        """The meaning of a query that was put into its templates."""
        templates = tuple(stored)
        warnings = dict.fromkeys(warning for template in templates for warning in template.warnings)
        words = {template.task: template.explanation for template in templates if template.explanation}
        return cls(grounded.formula, grounded, tuple(warnings), tuple(words.items()))


@dataclass(frozen=True, slots=True)
class Understanding:
    """One way to understand a command: its query if the translator gives one, what it means, or why it means nothing.

    Without an environment a query has no meaning yet, and a formula is as the translator gave it.
    """

    query: Query | None
    confidence: float
    meaning: Meaning | None
    refusal: CqltlError | None


def understand(
    services: Services, taught: Taught, text: str, environment: Environment | None, *, translator: str, candidates: int
) -> tuple[Understanding, ...]:
    """Up to `candidates` ways to understand a command, best first; none when no task fits.

    In an environment, what makes sense there comes first; `models.language.reading` says how. `default` asks the
    wordings that were taught with `/learn` before its network, so a taught command is understood at once, in every
    process that shares the store. Taught readings that make no sense give way to readings that do: "go to the sphere",
    taught for picking up, does not keep "go to the kitchen" from being understood.

    Raises:
        TextTooLongError: the text is beyond the limits of a command.
    """
    wanted = candidates if environment is None else max(candidates, BEAM_WIDTH)
    if services.translators.gives_formulas(translator):
        said = services.translators.formulas(translator).translate(text, candidates=wanted)
        formulas = rank_formulas(((found.formula, found.confidence) for found in said), environment=environment)
        return tuple(map(_of_formula, formulas[:candidates]))
    chosen = services.translators.queries(translator)
    wordings = taught.wordings if translator == DEFAULT else TaughtTranslator(())
    if isinstance(chosen, ComposedTranslator):
        chosen = chosen.knowing(wordings)
    said_as_taught = wordings.translate(text, candidates=BEAM_WIDTH)
    learned = chosen.translate(text, candidates=wanted)
    readings = _merged(
        read(text, said_as_taught, template_of=taught.template, environment=environment),
        rank(text, learned, template_of=taught.template, environment=environment),
    )
    return tuple(of_reading(reading, taught.stored) for reading in readings[:candidates])


def _merged(taught: Sequence[Reading], learned: Sequence[Reading]) -> tuple[Reading, ...]:
    """The taught readings that make sense, then the others; just the learned ones where only those do.

    A taught reading that takes a word for misspelt makes less sense than a learned one that takes all as said.
    """
    best = learned[0].weight if learned else SENSELESS
    least = AMBIGUOUS if best == GROUNDED else SENSELESS
    fitting = [reading for reading in taught if reading.weight >= least and reading.weight > SENSELESS]
    if not fitting and best > SENSELESS:
        return tuple(learned)
    first = _shared(fitting or taught)
    known = {reading.query for reading in first}
    rest = [replace(r, confidence=0.0) if first else r for r in learned if r.query not in known]
    return (*first, *rest)


def _shared(readings: Sequence[Reading]) -> list[Reading]:
    """The readings with confidences that add up to 1; those of no confidence share it when nothing else is left."""
    total = sum(reading.confidence for reading in readings)
    return [replace(r, confidence=r.confidence / total if total else 1 / len(readings)) for r in readings]


def of_reading(reading: Reading, templates: Mapping[str, StoredTemplate]) -> Understanding:
    """A reading with the warnings of its stored templates."""
    stored = [templates[task.task] for _, task in reading.query.tasks]
    meaning = None if reading.grounded is None else Meaning.of(reading.grounded, stored)
    return Understanding(reading.query, reading.confidence, meaning, reading.refusal)


def _of_formula(reading: FormulaReading) -> Understanding:
    meaning = Meaning(reading.formula) if reading.refusal is None else None
    return Understanding(None, reading.confidence, meaning, reading.refusal)
