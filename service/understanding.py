"""From a command to readings: taught wordings first, then the network."""

from __future__ import annotations

from models.language import TaughtTranslator, Translation
from models.queries import parse_query
from service.services import Services


def understand(services: Services, text: str, *, translator: str, candidates: int) -> tuple[Translation, ...]:
    """Up to `candidates` readings, best first; none when no task fits.

    `default` asks the wordings that were taught with `/learn` before the network, so a taught command is understood at
    once, in every process that shares the store.
    """
    network = services.translators[translator]
    if translator != "default":
        return network.translate(text, candidates=candidates)
    taught = _taught(services).translate(text, candidates=candidates)
    if len(taught) == candidates:
        return taught
    known = {translation.query for translation in taught}
    learned = [t for t in network.translate(text, candidates=candidates) if t.query not in known]
    rest = [Translation(t.query, 0.0 if taught else t.confidence) for t in learned]
    return (*taught, *rest)[:candidates]


def _taught(services: Services) -> TaughtTranslator:
    with services.store.read() as transaction:
        examples = transaction.templates.examples()
    return TaughtTranslator.of((example.text, parse_query(example.contextual_query)) for example in examples)
