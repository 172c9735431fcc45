"""The wordings of the task classes that the networks are trained on, in the form of those that are taught."""

from __future__ import annotations

from functools import cache

from models.language.dataset.corpus import Domain, read_corpus
from models.language.dataset.half import Half
from models.language.dataset.paraphrases import paraphrases
from models.language.teaching import Utterance, Wording
from models.queries import ContextualQuery


@cache
def trained_wordings() -> tuple[Wording, ...]:
    """Those of S, and the further ones that the default translator was trained on, each once."""
    found: dict[Wording, None] = {}
    for domain in Domain:
        further = paraphrases(domain, Half.TRAINING)
        for task in read_corpus(domain).tasks:
            query = ContextualQuery(task.name, task.arguments)
            marks = {slot: f"{{{number}}}" for number, slot in enumerate(task.arguments, start=1)}
            for wording in (*task.wordings, *further[task.name]):
                found[Wording.of(Utterance.of(wording.format_map(marks), query))] = None
    return tuple(found)
