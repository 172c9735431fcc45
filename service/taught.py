"""What was taught, read once for as long as it stays the same."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, field
from itertools import chain
from threading import Lock

from models.language import TaughtTranslator, Utterance, Wording
from models.language.dataset.wordings import trained_wordings
from models.language.hearing import Lessons
from models.language.matching import Known, Matcher, Shelf, TaughtTask
from models.language.matching.cards import cards_of
from models.language.teaching import Gap, OpenWordings
from models.language.teaching.wording import Element
from models.logic import atoms, parse
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
    _lessons: list[Lessons] = field(default_factory=list)
    _open: list[OpenWordings] = field(default_factory=list)

    @classmethod
    def of(cls, version: int, stored: Mapping[str, StoredTemplate]) -> Taught:
        """Read all examples."""
        utterances = [read_example(example) for template in stored.values() for example in template.examples]
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

    def lessons(self, matcher: Matcher, known: KnownCache, *, own: frozenset[str]) -> Lessons:
        """What the default translator hears besides its networks, which know their `own` tasks."""
        if not self._lessons:
            tasks = [self._task(stored, matcher, known) for stored in self.stored.values()]
            functions = {task: _functions(stored) for task, stored in self.stored.items()}
            left = frozenset(task for task in own if task in self.stored and not self.stored[task].examples)
            self._lessons.append(Lessons(self.wordings, Shelf.of(tasks), matcher, functions, left))
        return self._lessons[0]

    def gaps(self, text: str) -> tuple[Gap, ...]:
        """What a command says but for one argument, in the wordings of the stored tasks; raises TextTooLongError."""
        if not self._open:
            trained = (wording for wording in trained_wordings() if wording.task in self.stored)
            self._open.append(OpenWordings.of(chain((wording for wording, _ in self.wordings.wordings), trained)))
        return self._open[0].gaps(text)

    def _task(self, stored: StoredTemplate, matcher: Matcher, known: KnownCache) -> TaughtTask:
        examples = known.of([read_example(example) for example in stored.examples], matcher)
        queries = [parse_task(pair.contextual_query) for pair in stored.pairs[:1]]
        cards = known.of([card for query in queries for card in cards_of(query, stored.words)], matcher)
        return TaughtTask(stored.task, stored.arity, examples, cards)

    def conflicts(self, example: StoredExample) -> tuple[str, ...]:
        """The tasks that the wording of an example says besides its own meaning: the same words taught with another
        task, or with the arguments of its own in another order.
        """
        wording = Wording.of(read_example(example))
        own = _meaning(wording)
        return tuple(task for task, order in self._meanings.get(wording.said, ()) if (task, order) != own)

    def conflict_warnings(self, examples: Iterable[StoredExample]) -> tuple[str, ...]:
        """A sentence for each example whose wording has another meaning too."""
        return tuple(
            f'the wording "{example.text}" was also taught for {", ".join(tasks)}'
            for example in examples
            if (tasks := self.conflicts(example))
        )


class KnownCache:
    """What the matcher read in utterances; each is read once in a process, or was by the process that learned it."""

    def __init__(self) -> None:
        self._held: dict[Utterance, Known] = {}

    def of(self, utterances: Sequence[Utterance], matcher: Matcher) -> tuple[Known, ...]:
        """For each utterance what there is to compare with."""
        new = [utterance for utterance in dict.fromkeys(utterances) if utterance not in self._held]
        self._held.update(zip(new, matcher.known(new), strict=True))
        return tuple(self._held[utterance] for utterance in utterances)

    def note(self, readings: Mapping[str, bytes], stored: Iterable[StoredTemplate], matcher: Matcher) -> None:
        """Take over what was read in examples, by their ids."""
        for template in stored:
            for example in template.examples:
                known = matcher.from_bytes(readings.get(example.id))
                if known is not None:
                    self._held.setdefault(read_example(example), known)


class TaughtCache:
    """Holds what was taught until a transaction sees that it has changed."""

    def __init__(self) -> None:
        self._held: Taught | None = None
        self._lock = Lock()

    def held(self, version: int) -> Taught | None:
        """What was taught as of this version, if it is at hand."""
        held = self._held
        return held if held is not None and held.version == version else None

    def of(self, transaction: Transaction, version: int) -> Taught:
        """What was taught, as the transaction sees it, which sees this version of it."""
        if (found := self.held(version)) is not None:
            return found
        with self._lock:
            found = Taught.of(version, transaction.templates.every())
            self._held = found
            return found


def read_template(stored: StoredTemplate) -> Template:
    """The template value of a stored one."""
    kinds, taught = (tuple(map(frozenset, group)) for group in (stored.kinds, stored.taught))
    return Template(stored.task, parse(stored.template), parse(stored.lifted), kinds, taught)


def read_example(example: StoredExample) -> Utterance:
    """The utterance of a stored example."""
    return Utterance.of(example.text, parse_task(example.contextual_query))


def _functions(stored: StoredTemplate) -> frozenset[str]:
    return frozenset(atom.function for atom in atoms(parse(stored.template)))


def _meaning(wording: Wording) -> Meaning:
    return wording.task, tuple(dict.fromkeys(element for element in wording.elements if isinstance(element, int)))
