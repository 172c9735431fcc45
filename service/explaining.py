"""The use case of `/explain`: a formula or query read back in English, with its parts and its class."""

from __future__ import annotations

from dataclasses import dataclass

from anyio.to_thread import run_sync

from models.logic import FormulaTooLargeError, PropertyClass, SpotMissingError, parse
from models.queries import Query, QueryPart, evaluate_query, explain_query, parse_query, put_in, resolve_grounded
from models.world import Environment
from service.errors import OutOfTimeError
from service.pipeline import ground_query, query_pointer
from service.places import at
from service.services import Services
from service.taught import read_template
from service.understanding import Meaning
from service.worker import run_classification


@dataclass(frozen=True, slots=True)
class Explained:
    """What a request meant, and where; what its query says, if it was one, with all parts.

    `kind` is None where it could not be told; `warnings` then say why.
    """

    meaning: Meaning
    query: QueryPart | None
    environment: Environment | None
    kind: PropertyClass | None
    warnings: tuple[str, ...]


async def explain_request(
    services: Services, *, ltl: str | None, query: str | Query | None, environment: str | None
) -> Explained:
    """Read back a formula, or a contextual query as text or in parts; in an environment, if one is named.

    Without an environment, atoms are read as they are written, and the phrases of a query stand in the templates as
    names.
    """
    meaning, part, world = await run_sync(_prepare, services, ltl, query, environment)
    warnings = meaning.warnings
    kind: PropertyClass | None = None
    try:
        timeout = services.settings.logic_timeout_s
        kind = await services.workers.check(run_classification, meaning.formula, timeout_s=timeout)
    except (OutOfTimeError, FormulaTooLargeError, SpotMissingError) as error:
        warnings += (f"what kind of task it is could not be told: {error.detail}",)
    return Explained(meaning, part, world, kind, warnings)


def _prepare(
    services: Services, ltl: str | None, query: str | Query | None, environment: str | None
) -> tuple[Meaning, QueryPart | None, Environment | None]:
    with at("/environment"):
        world = None if environment is None else services.environment(environment).value
    if query is None:
        assert ltl is not None
        with at("/ltl"):
            formula = parse(ltl)
            return Meaning(formula if world is None else resolve_grounded(formula, world)), None, world
    with at(query_pointer(query)):
        if world is None:
            meaning, words = _without_environment(services, query)
        else:
            meaning = ground_query(services, query, world)
            words = dict(meaning.words)
    assert meaning.grounded is not None
    return meaning, explain_query(meaning.grounded, words, world), world


def _without_environment(services: Services, said: str | Query) -> tuple[Meaning, dict[str, str]]:
    """The query with its phrases in the templates, and what each task says: as taught, or as read when taught."""
    query = parse_query(said) if isinstance(said, str) else said
    with services.store.read() as transaction:
        stored = {task.task: transaction.templates.get(task.task) for _, task in query.tasks}
    templates = {task: read_template(template) for task, template in stored.items()}
    grounded = evaluate_query(query, lambda task: put_in(templates[task.task], task))
    words = {task: template.words for task, template in stored.items() if template.words}
    return Meaning.of(grounded, stored.values()), words
