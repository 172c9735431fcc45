"""From a command to what it may mean: taught wordings first, then the translator."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from itertools import chain

from models.errors import CqltlError
from models.language import BEAM_WIDTH
from models.language.hearing import Hearing
from models.language.reading import (
    FormulaReading,
    Reading,
    rank_formulas,
)
from models.logic import Formula
from models.queries import Binding, GroundedQuery, Path, Query, explain_query, review_composition
from models.world import Environment, explain
from service.services import Services
from service.store import StoredTemplate
from service.taught import Taught
from service.translators import DEFAULT

NEAREST = 3
"""Known tasks that are named where none fits."""


@dataclass(frozen=True, slots=True)
class Meaning:
    """A formula; and unless it was said as a formula, the query as it was grounded, the warnings of the templates, and
    by task the words that were taught for it. `confidence` is that of the reading of a command, where it is one.
    """

    formula: Formula
    grounded: GroundedQuery | None = None
    warnings: tuple[str, ...] = ()
    words: tuple[tuple[str, str], ...] = ()
    confidence: float | None = None

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
        warned = chain.from_iterable(template.warnings for template in templates)
        warnings = dict.fromkeys((*warned, *review_composition(grounded)))
        words = {template.task: template.explanation for template in templates if template.explanation}
        return cls(grounded.formula, grounded, tuple(warnings), tuple(words.items()))


@dataclass(frozen=True, slots=True)
class Understanding:
    """One way to understand a command: its query if the translator gives one, what it means, or why it means nothing.

    Without an environment a query has no meaning yet, and a formula is as the translator gave it. `instead_of` is
    why what the words rather say means nothing, where this was put in its place.
    """

    query: Query | None
    confidence: float
    meaning: Meaning | None
    refusal: CqltlError | None
    instead_of: CqltlError | None = None


def understand(
    services: Services, taught: Taught, text: str, environment: Environment | None, *, translator: str, candidates: int
) -> tuple[Understanding, ...]:
    """Up to `candidates` ways to understand a command, best first; none when no task fits.

    In an environment, what makes sense there comes first; `models.language.reading` says how. `default` hears what was
    taught with `/learn` besides its networks (`models.language.hearing`), so a taught task is understood at once, in
    every process that shares the store.

    Raises:
        TextTooLongError: the text is beyond the limits of a command.
    """
    if services.translators.gives_formulas(translator):
        wanted = candidates if environment is None else max(candidates, BEAM_WIDTH)
        said = services.translators.formulas(translator).translate(text, candidates=wanted)
        formulas = rank_formulas(((found.formula, found.confidence) for found in said), environment=environment)
        return tuple(map(_of_formula, formulas[:candidates]))
    chosen = services.translators.queries(translator)
    lessons = services.lessons(taught) if translator == DEFAULT else None
    hearing = Hearing(chosen, lessons, taught.template)
    readings = hearing.readings(text, environment, candidates=candidates)
    return tuple(of_reading(reading, taught.stored) for reading in readings)


def nearest_tasks(
    services: Services, taught: Taught, text: str, environment: Environment | None, *, translator: str
) -> tuple[str, ...]:
    """The known tasks that are nearest to a command that none of them fits; none by the translators of the paper."""
    if translator != DEFAULT:
        return ()
    return services.lessons(taught).nearest(text, count=NEAREST, environment=environment)


def of_reading(reading: Reading, templates: Mapping[str, StoredTemplate]) -> Understanding:
    """A reading with the warnings of its stored templates."""
    stored = [templates[task.task] for _, task in reading.query.tasks]
    meaning = None if reading.grounded is None else Meaning.of(reading.grounded, stored)
    instead_of = None if reading.instead_of is None else reading.instead_of.refusal
    return Understanding(reading.query, reading.confidence, meaning, reading.refusal, instead_of)


def _of_formula(reading: FormulaReading) -> Understanding:
    meaning = Meaning(reading.formula) if reading.refusal is None else None
    return Understanding(None, reading.confidence, meaning, reading.refusal)
