"""The use case of `/learn`: derive a template from one example, review it, keep it."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from contextlib import suppress
from dataclasses import dataclass, replace
from typing import TypeVar

from anyio.to_thread import run_sync

from models.errors import CqltlError, Place
from models.language import ExampleArgumentNotFoundError, Utterance, Wording, find_arguments, is_marked
from models.logic import FormulaTooLargeError, parse
from models.logic import to_text as formula_text
from models.queries import ContextualQuery, Example, Template, check_words, learn, parse_task
from models.world import Environment, explain
from service.errors import OutOfTimeError, TemplateConflictError, TooManyExamplesError
from service.places import at
from service.services import LoadedEnvironment, Services
from service.store import StoredExample, StoredPair, StoredTemplate, Transaction
from service.taught import Taught
from service.worker import ReviewJob, run_review

T = TypeVar("T")

MAX_EVIDENCE = 100
"""Pairs, and utterances, kept with one template."""


@dataclass(frozen=True, slots=True)
class Lesson:
    """What `/learn` is given: a contextual query and grounded LTL, further such pairs, utterances, and the words in
    which the task is read back, with slots for its arguments.
    """

    query: str
    ltl: str
    environment: str
    more: tuple[tuple[str, str], ...] = ()
    examples: tuple[str, ...] = ()
    replace: bool = False
    explanation: str | None = None


@dataclass(frozen=True, slots=True)
class Learned:
    """A template as it is stored now, whether its task is new, and what to know of what was learned with it."""

    stored: StoredTemplate
    created: bool
    conflicts: tuple[str, ...]


Note = Callable[[Transaction, Learned], None]
"""What is done in the transaction that stores what was learned."""


def _no_note(_transaction: Transaction, _learned: Learned) -> None:
    pass


async def learn_template(services: Services, lesson: Lesson, *, note: Note = _no_note) -> Learned:
    """Derive the template, review it, and store it.

    Learning the same again stores nothing new but pairs and utterances not seen before. What `note` raises undoes all.

    Raises:
        TemplateConflictError: the task has another template and `lesson.replace` is not set.
        CqltlError: whatever parsing and `models.queries.learn` raise; then nothing is stored.
    """
    template, environment, examples = await run_sync(_derive, services, lesson)
    job = ReviewJob(template, environment.text)
    try:
        warnings = await services.workers.check(run_review, job, timeout_s=services.settings.logic_timeout_s)
    except (OutOfTimeError, FormulaTooLargeError) as error:
        warnings = (f"the template was not checked for a simpler form: {error.detail}",)
    reading = explain(template.formula, environment.value)
    return await run_sync(_keep, services, lesson, template, examples, warnings, reading, note)


def _derive(services: Services, lesson: Lesson) -> tuple[Template, LoadedEnvironment, tuple[StoredExample, ...]]:
    with at("/environment"):
        environment = services.environment(lesson.environment)
    pairs = [_read_pair(lesson.query, lesson.ltl, "")]
    pairs += [_read_pair(query, ltl, f"/more/{index}") for index, (query, ltl) in enumerate(lesson.more)]
    if lesson.explanation is not None:
        with at("/explanation"):
            check_words(lesson.explanation, len(pairs[0].query.arguments))
    try:
        template = learn(pairs, environment.value)
    except CqltlError as error:
        error.places = tuple(_in_request(place) for place in error.places) or (Place("/ltl", error.detail),)
        error.placed = True
        raise
    return template, environment, _read_utterances(lesson.examples, pairs, template, environment.value)


def _read_utterances(
    texts: Sequence[str], pairs: Sequence[Example], template: Template, environment: Environment
) -> tuple[StoredExample, ...]:
    """The utterances with the queries that they say: one of the pairs', where its words stand in them, or else that of
    the things that they name in the environment.
    """
    found = []
    for index, text in enumerate(dict.fromkeys(texts)):
        with at(f"/examples/{index}"):
            utterance = _read_utterance(text, [pair.query for pair in pairs], template, environment)
            Wording.of(utterance)
        found.append(StoredExample(text, str(utterance.query)))
    return tuple(found)


def _read_utterance(
    text: str, queries: Sequence[ContextualQuery], template: Template, environment: Environment
) -> Utterance:
    if is_marked(text):
        return Utterance.of(text, queries[0])
    for query in queries:
        with suppress(ExampleArgumentNotFoundError):
            return Utterance.of(text, query)
    return Utterance.of(text, find_arguments(text, template, environment))


def _in_request(place: Place) -> Place:
    """`learn` numbers its examples; the first is spelled out in the request, the others are the list `more`."""
    number, _, rest = place.pointer.removeprefix("/").partition("/")
    rest = rest.replace("query", "contextual_query", 1).replace("formula", "ltl", 1)
    return Place(f"/{rest}" if number == "0" else f"/more/{int(number) - 1}/{rest}", place.detail)


def _read_pair(query: str, ltl: str, pointer: str) -> Example:
    with at(f"{pointer}/contextual_query"):
        read = parse_task(query)
    with at(f"{pointer}/ltl"):
        return Example(read, parse(ltl))


def _keep(
    services: Services,
    lesson: Lesson,
    template: Template,
    examples: tuple[StoredExample, ...],
    warnings: tuple[str, ...],
    reading: str,
    note: Note,
) -> Learned:
    pairs = [StoredPair(lesson.query, lesson.ltl, lesson.environment)]
    pairs += [StoredPair(query, ltl, lesson.environment) for query, ltl in lesson.more]
    new = StoredTemplate(
        task=template.task,
        template=formula_text(template.formula),
        lifted=formula_text(template.lifted),
        kinds=tuple(tuple(sorted(kinds)) for kinds in template.kinds),
        taught=tuple(tuple(sorted(kinds)) for kinds in template.taught),
        pairs=tuple(dict.fromkeys(pairs)),
        examples=examples,
        warnings=warnings,
        revision=1,
        reading=reading,
        explanation="" if lesson.explanation is None else check_words(lesson.explanation, template.arity),
    )
    with services.store.write() as transaction:
        known = transaction.templates.find(template.task)
        if known is None:
            kept = new
        elif (known.template, known.arity) == (new.template, new.arity):
            kept = _add_evidence(known, new)
        elif lesson.replace:
            kept = _replace(known, new)
        else:
            detail = (
                f'{template.task} is stored with the template {known.template}; "replace": true puts '
                f"{new.template} in its place"
            )
            raise TemplateConflictError(detail, places=[Place("/ltl", detail)])
        if kept != known:
            transaction.templates.put(kept)
        conflicts = Taught.of(0, transaction.templates.every()).conflict_warnings(examples) if examples else ()
        learned = Learned(kept, known is None, conflicts)
        note(transaction, learned)
    services.note_examples([example for example in examples if known is None or example not in known.examples])
    return learned


def _replace(known: StoredTemplate, new: StoredTemplate) -> StoredTemplate:
    """The new template in place of the known one; how people say the task stays known if its arguments are as many.
    What it is read back as does not: that was said of another formula.
    """
    examples = known.examples if known.arity == new.arity else ()
    kept = _within(dict.fromkeys(examples + new.examples))
    return replace(new, examples=kept, revision=known.revision + 1)


def _add_evidence(known: StoredTemplate, new: StoredTemplate) -> StoredTemplate:
    """The known template with what the new lesson adds to its pairs and utterances, and says of it in words."""
    pairs = _within(dict.fromkeys(known.pairs + new.pairs))
    examples = _within(dict.fromkeys(known.examples + new.examples))
    taught = _both(known.taught, new.taught)
    kept = replace(
        known,
        pairs=pairs,
        examples=examples,
        taught=taught,
        reading=known.reading or new.reading,
        explanation=new.explanation or known.explanation,
    )
    return known if kept == known else replace(kept, revision=known.revision + 1)


def _both(known: tuple[tuple[str, ...], ...], new: tuple[tuple[str, ...], ...]) -> tuple[tuple[str, ...], ...]:
    """The kinds of either, per argument."""
    if not known:
        return new
    return tuple(tuple(sorted({*one, *other})) for one, other in zip(known, new, strict=True))


def _within(kept: Iterable[T]) -> tuple[T, ...]:
    found = tuple(kept)
    if len(found) > MAX_EVIDENCE:
        raise TooManyExamplesError(f"a template keeps at most {MAX_EVIDENCE} pairs and {MAX_EVIDENCE} utterances")
    return found
