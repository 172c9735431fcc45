"""Readings of a command in an environment: what makes sense there comes first.

A translator knows the words, not the place: "put the bag in the bag" is one thing where bags are toys and boxes, and
another where they are not. Its probability of a reading is weighed by how much sense the reading makes there:

    P(reading | text, environment)  ~  P(reading | text) · weight

and scaled so that all readings together stay as probable as they were.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass, replace
from typing import TypeVar

from models.errors import CqltlError, Place
from models.language.kinds import strangers
from models.language.scene import Scene
from models.language.tokens import find
from models.language.translation import Translation
from models.logic import Formula
from models.logic import to_text as formula_text
from models.queries import (
    AmbiguousGroundingError,
    ContextualQuery,
    GroundedQuery,
    Query,
    evaluate_query,
    resolve_grounded,
)
from models.world import Environment

GROUNDED = 1.0
"""Weight of a reading that means one thing in the environment."""
AMBIGUOUS = 0.5
"""Weight of one with a phrase that fits several things: it makes sense, and the speaker can be asked."""
MISSPELT = 0.3
"""Factor for a reading that makes sense only when a word is taken for misspelt: what is said exactly is likelier."""
UNSAID = 0.3
"""Factor for each thing of the environment that the text names and the reading leaves out."""
STRANGE = 0.1
"""Factor for each thing of another kind than a task was taught with, where another task was taught with that kind."""
SENSELESS = 1e-4
"""Weight of one that means nothing in the environment. Not 0: people do ask for what is not there."""
IMPROBABLE = 0.002
"""Part of the probability of a reading that makes full sense, below which another one is not looked at: whatever sense
it makes, it stays so much less probable.
"""
FAR_LIKELIER = 10.0
"""How many times likelier by the words a reading that means nothing must be, for one that makes sense to count as put
in its place: "pick up the oven" is not "switch on the oven" because ovens cannot be picked up.
"""

R = TypeVar("R", "Reading", "FormulaReading")


@dataclass(frozen=True, slots=True)
class Reading:
    """A contextual query that a command may say.

    `grounded` is what it means in the environment and `refusal` why it means nothing there; both are None without an
    environment, unless the query has the wrong number of arguments. `senseless` is how many of its tasks mean nothing,
    `unsaid` how many things that the text names there it leaves out, `strange` how many are of a kind that another task
    was taught with (`models.language.kinds`). `instead_of` is what the words say far likelier, where that means
    nothing there.
    """

    query: Query
    confidence: float
    grounded: GroundedQuery | None = None
    refusal: CqltlError | None = None
    senseless: int = 1
    unsaid: int = 0
    strange: int = 0
    instead_of: Reading | None = None

    @property
    def likelihood(self) -> float:
        """How much likelier than others the environment makes it: by its sense, by how much of the text it says, and by
        the kinds of the things that it is about.
        """
        return self.weight * UNSAID**self.unsaid * STRANGE**self.strange

    @property
    def weight(self) -> float:
        """How much sense it makes in the environment; without one, as much as can be."""
        if self.refusal is None:
            weight = GROUNDED
            bindings = self.grounded.bindings if self.grounded else ()
            candidates = [candidate for _, binding in bindings for candidate in binding.candidates]
        elif isinstance(self.refusal, AmbiguousGroundingError):
            weight, candidates = AMBIGUOUS, list(self.refusal.candidates)
        else:
            return SENSELESS**self.senseless
        return weight * MISSPELT if any(candidate.misspelt is not None for candidate in candidates) else weight


@dataclass(frozen=True, slots=True)
class FormulaReading:
    """A formula that a command may say, of a translator that gives formulas.

    `formula` is resolved in the environment, and as the translator gave it without one or with a `refusal`.
    """

    formula: Formula
    confidence: float
    refusal: CqltlError | None = None

    @property
    def likelihood(self) -> float:
        """As `Reading.likelihood`."""
        return GROUNDED if self.refusal is None else SENSELESS


def rank(translations: Sequence[Translation], scene: Scene) -> tuple[Reading, ...]:
    """The readings of a text, grounded where it is said, the most probable there first; without those that are
    `IMPROBABLE` beside one that makes full sense.

    Readings of a task without a template are left out, and none is given when one of them is the most probable: what
    says a task that is not known is not taken for another.
    """
    known = [translation for translation in translations if scene.knows(translation.query)]
    said = _probable(known, scene)
    readings = _in_place(_ordered(said, sum(translation.confidence for translation in known)), said)
    left_out = max((t.confidence for t in translations if not scene.knows(t.query)), default=0.0)
    return readings if readings and readings[0].confidence >= left_out else ()


def read(translations: Iterable[Translation], scene: Scene) -> tuple[Reading, ...]:
    """As `rank`, in the order and with the confidences of the translations, and all of them."""
    known = [translation for translation in translations if scene.knows(translation.query)]
    named = scene.named() if known else ()
    return _compared([_read(said, scene, named) for said in known], scene)


def _probable(translations: Sequence[Translation], scene: Scene) -> tuple[Reading, ...]:
    """As `read`, without what is `IMPROBABLE`: most of a translator's readings, and grounding them takes longer than
    the reading that is meant.
    """
    if scene.environment is None:
        return read(translations, scene)
    named, best = scene.named() if translations else (), 0.0
    found: dict[int, Reading] = {}
    for place in sorted(range(len(translations)), key=lambda place: -translations[place].confidence):
        if translations[place].confidence < IMPROBABLE * best:
            break
        found[place] = reading = _read(translations[place], scene, named)
        if reading.likelihood >= GROUNDED:
            best = max(best, reading.confidence)
    readings = _compared([found[place] for place in sorted(found)], scene)
    if len(found) == len(translations) or any(r.likelihood >= GROUNDED and r.confidence == best for r in readings):
        return readings
    return read(translations, scene)  # beside the others, the best is said of strange things


def _in_place(ranked: tuple[Reading, ...], said: Sequence[Reading]) -> tuple[Reading, ...]:
    """The ranked readings, the first with what it was put in the place of; `said` are the same, as likely as the words
    make them.
    """
    likeliest = max(said, key=lambda reading: reading.confidence, default=None)
    if likeliest is None or likeliest.weight > SENSELESS:
        return ranked
    first, *others = ranked
    by_words = next(reading.confidence for reading in said if reading.query == first.query)
    if first.weight <= SENSELESS or likeliest.confidence < FAR_LIKELIER * by_words:
        return ranked
    return (replace(first, instead_of=likeliest), *others)


def _compared(readings: Sequence[Reading], scene: Scene) -> tuple[Reading, ...]:
    """With what is strange in each beside the others."""
    strange = strangers([(reading.grounded, reading.confidence) for reading in readings], scene.template_of)
    return tuple(replace(reading, strange=count) for reading, count in zip(readings, strange, strict=True))


def rank_formulas(
    translations: Iterable[tuple[Formula, float]], *, environment: Environment | None
) -> tuple[FormulaReading, ...]:
    """As `rank`, for formulas with their probabilities: those that the environment can resolve come first."""
    readings = [_resolve(formula, confidence, environment) for formula, confidence in translations]
    return _ordered(readings, sum(reading.confidence for reading in readings))


def _read(translation: Translation, scene: Scene, named: Sequence[tuple[str, ...]]) -> Reading:
    query, confidence = translation.query, translation.confidence
    unsaid = _unsaid(query, named)
    try:
        scene.check(query)
        grounded = None if scene.environment is None else evaluate_query(query, scene.ground)
    except CqltlError as error:
        return Reading(query, confidence, None, error, max(1, _senseless(query, scene)), unsaid)
    return Reading(query, confidence, grounded, unsaid=unsaid)


def _unsaid(query: Query, named: Sequence[tuple[str, ...]]) -> int:
    """How many of the named things no argument speaks of."""
    spoken = [argument.split() for _, task in query.tasks for argument in task.arguments]
    return sum(all(find(phrase, argument) is None for argument in spoken) for phrase in named)


def _senseless(query: Query, scene: Scene) -> int:
    """How many tasks of a composed query cannot be grounded."""
    if isinstance(query, ContextualQuery):
        return 1
    count = 0
    for _, task in query.tasks:
        try:
            scene.ground(task)
        except AmbiguousGroundingError:
            continue
        except CqltlError:
            count += 1
    return count


def _resolve(formula: Formula, confidence: float, environment: Environment | None) -> FormulaReading:
    if environment is None:
        return FormulaReading(formula, confidence)
    try:
        return FormulaReading(resolve_grounded(formula, environment), confidence)
    except CqltlError as error:
        detail = f"{formula_text(formula)}: {error.detail}"
        error.places = (Place("", detail),)
        return FormulaReading(formula, confidence, error)


def _ordered(readings: Sequence[R], total: float) -> tuple[R, ...]:
    """By probability in the environment, equally probable ones in their order, together as probable as all were."""
    weighed = [reading.confidence * reading.likelihood for reading in readings]
    scale = total / (sum(weighed) or 1.0)
    ranked = [replace(reading, confidence=w * scale) for reading, w in zip(readings, weighed, strict=True)]
    return tuple(sorted(ranked, key=lambda reading: -reading.confidence))
