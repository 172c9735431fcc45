"""The use case of `/learn`: derive a template from one example, review it, keep it."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from dataclasses import dataclass, replace
from functools import lru_cache
from typing import TypeVar

from anyio.to_thread import run_sync

from models.errors import CqltlError, Place
from models.language import Wording
from models.logic import FormulaTooLargeError, parse
from models.logic import to_text as formula_text
from models.queries import Example, Template, learn, parse_task
from service.errors import OutOfTimeError, TemplateConflictError, TooManyExamplesError
from service.places import at
from service.services import LoadedEnvironment, Services
from service.store import StoredExample, StoredPair, StoredTemplate, Transaction
from service.worker import ReviewJob, run_review

T = TypeVar("T")

MAX_EVIDENCE = 100
"""Pairs, and utterances, kept with one template."""


@dataclass(frozen=True, slots=True)
class Lesson:
    """What `/learn` is given: a contextual query and grounded LTL, further such pairs, and utterances."""

    query: str
    ltl: str
    environment: str
    more: tuple[tuple[str, str], ...] = ()
    examples: tuple[str, ...] = ()
    replace: bool = False


@lru_cache(maxsize=1_024)
def read_template(stored: StoredTemplate) -> Template:
    """The template value of a stored one."""
    kinds, taught = (tuple(map(frozenset, group)) for group in (stored.kinds, stored.taught))
    return Template(stored.task, parse(stored.template), parse(stored.lifted), kinds, taught)


Note = Callable[[Transaction, StoredTemplate, bool], None]
"""What is done in the transaction that stores a template, with whether its task is new."""


def _no_note(_transaction: Transaction, _stored: StoredTemplate, _new: bool) -> None:
    pass


async def learn_template(services: Services, lesson: Lesson, *, note: Note = _no_note) -> tuple[StoredTemplate, bool]:
    """Derive the template, review it, and store it; the flag says whether the task is new.

    Learning the same again stores nothing new but pairs and utterances not seen before. What `note` raises undoes all.

    Raises:
        TemplateConflictError: the task has another template and `lesson.replace` is not set.
        CqltlError: whatever parsing and `models.queries.learn` raise; then nothing is stored.
    """
    environment, template = await run_sync(_derive, services, lesson)
    job = ReviewJob(template, environment.text)
    try:
        warnings = await services.workers.check(run_review, job, timeout_s=services.settings.logic_timeout_s)
    except (OutOfTimeError, FormulaTooLargeError) as error:
        warnings = (f"the template was not checked for a simpler form: {error.detail}",)
    return await run_sync(_keep, services, lesson, template, warnings, note)


def _derive(services: Services, lesson: Lesson) -> tuple[LoadedEnvironment, Template]:
    with at("/environment"):
        environment = services.environment(lesson.environment)
    examples = [_read_pair(lesson.query, lesson.ltl, "")]
    examples += [_read_pair(query, ltl, f"/more/{index}") for index, (query, ltl) in enumerate(lesson.more)]
    for index, utterance in enumerate(lesson.examples):
        with at(f"/examples/{index}"):
            Wording.of(utterance, examples[0].query)
    try:
        return environment, learn(examples, environment.value)
    except CqltlError as error:
        error.places = tuple(_in_request(place) for place in error.places) or (Place("/ltl", error.detail),)
        error.placed = True
        raise


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
    services: Services, lesson: Lesson, template: Template, warnings: tuple[str, ...], note: Note
) -> tuple[StoredTemplate, bool]:
    pairs = [StoredPair(lesson.query, lesson.ltl, lesson.environment)]
    pairs += [StoredPair(query, ltl, lesson.environment) for query, ltl in lesson.more]
    new = StoredTemplate(
        task=template.task,
        template=formula_text(template.formula),
        lifted=formula_text(template.lifted),
        kinds=tuple(tuple(sorted(kinds)) for kinds in template.kinds),
        taught=tuple(tuple(sorted(kinds)) for kinds in template.taught),
        pairs=tuple(dict.fromkeys(pairs)),
        examples=tuple(StoredExample(text, lesson.query) for text in dict.fromkeys(lesson.examples)),
        warnings=warnings,
        revision=1,
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
        note(transaction, kept, known is None)
    return kept, known is None


def _replace(known: StoredTemplate, new: StoredTemplate) -> StoredTemplate:
    """The new template in place of the known one; how people say the task stays known if its arguments are as many."""
    examples = known.examples if known.arity == new.arity else ()
    kept = _within(dict.fromkeys(examples + new.examples))
    return replace(new, examples=kept, revision=known.revision + 1)


def _add_evidence(known: StoredTemplate, new: StoredTemplate) -> StoredTemplate:
    """The known template with what the new lesson adds to its pairs and utterances."""
    pairs = _within(dict.fromkeys(known.pairs + new.pairs))
    examples = _within(dict.fromkeys(known.examples + new.examples))
    taught = _both(known.taught, new.taught)
    if (pairs, examples, taught) == (known.pairs, known.examples, known.taught):
        return known
    return replace(known, pairs=pairs, examples=examples, taught=taught, revision=known.revision + 1)


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
