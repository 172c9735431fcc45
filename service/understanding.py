"""From a command to readings: taught wordings first, then the network."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from functools import lru_cache

from models.language import BEAM_WIDTH, TaughtTranslator, Translation
from models.queries import ContextualQuery, parse_query
from service.services import Services
from service.store import StoredExample

Fits = Callable[[ContextualQuery], bool]
"""Whether a query makes sense where the command was given."""


def understand(
    services: Services, text: str, *, translator: str, candidates: int, fits: Fits
) -> tuple[Translation, ...]:
    """Up to `candidates` readings, best first; none when no task fits.

    `default` asks the wordings that were taught with `/learn` before the network, so a taught command is understood at
    once, in every process that shares the store. Taught readings that do not fit give way to readings that do:
    "go to the sphere", taught for picking up, does not keep "go to the kitchen" from being understood.
    """
    learned = services.translators[translator].translate(text, candidates=candidates)
    if translator != "default":
        return learned
    taught = _taught(services).translate(text, candidates=BEAM_WIDTH)
    fitting = [translation for translation in taught if fits(translation.query)]
    if not fitting and learned and fits(learned[0].query):
        return learned
    first = _shared(fitting or taught)
    known = {translation.query for translation in first}
    rest = [Translation(t.query, 0.0 if first else t.confidence) for t in learned if t.query not in known]
    return (*first, *rest)[:candidates]


def _shared(readings: Sequence[Translation]) -> list[Translation]:
    """The readings with confidences that add up to 1; those of no confidence share it when nothing else is left."""
    total = sum(reading.confidence for reading in readings)
    return [Translation(r.query, r.confidence / total if total else 1 / len(readings)) for r in readings]


def _taught(services: Services) -> TaughtTranslator:
    with services.store.read() as transaction:
        examples = transaction.templates.examples()
    return _wordings(tuple(examples))


@lru_cache(maxsize=4)
def _wordings(examples: tuple[StoredExample, ...]) -> TaughtTranslator:
    return TaughtTranslator.of((example.text, parse_query(example.contextual_query)) for example in examples)
