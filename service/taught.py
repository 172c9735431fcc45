"""What was taught, read once for as long as it stays the same."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field
from threading import Lock

from models.language import TaughtTranslator, Utterance, Wording
from models.language.teaching.wording import Element
from models.logic import parse
from models.queries import Template, parse_task
from service.store import StoredExample, StoredTemplate, Transaction

Meaning = tuple[str, tuple[int, ...]]
"""A task, and which of its arguments the slots of a wording are, from left to right."""


@dataclass(frozen=True, slots=True)
class Taught:
    """The stored templates by task, and a translator of the wordings of their examples."""

    version: int
    stored: Mapping[str, StoredTemplate]
    wordings: TaughtTranslator
    _meanings: Mapping[tuple[Element, ...], tuple[Meaning, ...]]
    _templates: dict[str, Template] = field(default_factory=dict)

    @classmethod
    def of(cls, version: int, stored: Mapping[str, StoredTemplate]) -> Taught:
        """Read all examples."""
        utterances = [_utterance(example) for template in stored.values() for example in template.examples]
        meanings: dict[tuple[Element, ...], dict[Meaning, None]] = {}
        for wording in map(Wording.of, utterances):
            meanings.setdefault(wording.said, {})[_meaning(wording)] = None
        return cls(
            version,
            stored,
            TaughtTranslator.of(utterances),
            {said: tuple(meant) for said, meant in meanings.items()},
        )

    def template(self, task: str) -> Template | None:
        """The template of a task; None if it has none."""
        if task not in self._templates and task in self.stored:
            self._templates[task] = read_template(self.stored[task])
        return self._templates.get(task)

    def conflicts(self, example: StoredExample) -> tuple[str, ...]:
        """The tasks that the wording of an example says besides its own meaning: the same words taught with another
        task, or with the arguments of its own in another order.
        """
        wording = Wording.of(_utterance(example))
        own = _meaning(wording)
        return tuple(task for task, order in self._meanings.get(wording.said, ()) if (task, order) != own)

    def conflict_warnings(self, examples: Iterable[StoredExample]) -> tuple[str, ...]:
        """A sentence for each example whose wording has another meaning too."""
        return tuple(
            f'the wording "{example.text}" was also taught for {", ".join(tasks)}'
            for example in examples
            if (tasks := self.conflicts(example))
        )


class TaughtCache:
    """Holds what was taught until a transaction sees that it has changed."""

    def __init__(self) -> None:
        self._held: Taught | None = None
        self._lock = Lock()

    def of(self, transaction: Transaction) -> Taught:
        """What was taught, as the transaction sees it."""
        version = transaction.templates.version()
        held = self._held
        if held is not None and held.version == version:
            return held
        with self._lock:
            held = Taught.of(version, transaction.templates.every())
            self._held = held
            return held


def read_template(stored: StoredTemplate) -> Template:
    """The template value of a stored one."""
    kinds, taught = (tuple(map(frozenset, group)) for group in (stored.kinds, stored.taught))
    return Template(stored.task, parse(stored.template), parse(stored.lifted), kinds, taught)


def _utterance(example: StoredExample) -> Utterance:
    return Utterance.of(example.text, parse_task(example.contextual_query))


def _meaning(wording: Wording) -> Meaning:
    return wording.task, tuple(dict.fromkeys(element for element in wording.elements if isinstance(element, int)))
