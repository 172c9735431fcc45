"""The use cases: English in, policy out. Plain functions over the services that the composition root made."""

from __future__ import annotations

import hashlib
import json
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any, Literal

from anyio.to_thread import run_sync

from models.errors import CqltlError
from models.logic import Formula, parse
from models.logic import to_text as formula_text
from models.queries import (
    AmbiguousGroundingError,
    ContextualQuery,
    GroundedTask,
    evaluate,
    parse_query,
    resolve_grounded,
)
from models.world import Environment, State
from service.errors import AmbiguousCommandError, NotUnderstoodError
from service.lessons import read_template
from service.places import at
from service.services import LoadedEnvironment, Services
from service.store import StoredPolicy
from service.understanding import understand
from service.worker import Device, PlanAnswer, PlanJob, run_plan


@dataclass(frozen=True, slots=True)
class Meaning:
    """A contextual query grounded, with the warnings of its template."""

    task: GroundedTask
    warnings: tuple[str, ...]


@dataclass(frozen=True, slots=True)
class Reading:
    """One way to read a command: its query, and what it means or the refusal that stands in the way."""

    query: ContextualQuery
    confidence: float
    meaning: Meaning | None
    refusal: CqltlError | None


@dataclass(frozen=True, slots=True)
class Translated:
    """The readings of a command, best first; none when no task fits. `environment` is None when none was named."""

    text: str
    readings: tuple[Reading, ...]
    environment: Environment | None

    @property
    def outcome(self) -> Literal["translated", "ambiguous", "unknown"]:
        """Whether the command is understood, could mean several objects, or fits no task."""
        if not self.readings:
            return "unknown"
        return "ambiguous" if isinstance(self.readings[0].refusal, AmbiguousGroundingError) else "translated"


@dataclass(frozen=True, slots=True)
class PlanOrder:
    """What `/plan` is asked for: one of `text`, `query` and `ltl`; one of `environment` (a name) and `spec`."""

    text: str | None
    query: str | None
    ltl: str | None
    environment: str | None
    spec: Mapping[str, Any] | None
    state: State | None
    translator: str
    epsilon: float
    timeout_s: float
    max_states: int
    device: Device


@dataclass(frozen=True, slots=True)
class Planned:
    """A plan: what was planned for, where, and what was found."""

    meaning: Meaning | None
    formula: Formula
    environment: Environment
    answer: PlanAnswer
    policy_id: str | None


def translate(
    services: Services,
    text: str,
    *,
    environment: str | None,
    translator: str,
    candidates: int,
    pointer: str = "/text",
) -> Translated:
    """Translate a command; with an environment, ground each reading and put it into its template.

    `pointer` is where the text stands in the request.
    """
    with at("/environment"):
        world = None if environment is None else services.environment(environment).value
    with at(pointer):
        return _translate_in(services, text, world, translator=translator, candidates=candidates)


def _translate_in(
    services: Services, text: str, environment: Environment | None, *, translator: str, candidates: int
) -> Translated:
    """Translate a command for an environment that is at hand."""
    known: dict[ContextualQuery, tuple[Meaning | None, CqltlError | None]] = {}

    def mean(query: ContextualQuery) -> tuple[Meaning | None, CqltlError | None]:
        if query not in known:
            known[query] = _mean(services, text, query, environment)
        return known[query]

    def fits(query: ContextualQuery) -> bool:
        return mean(query)[1] is None or isinstance(mean(query)[1], AmbiguousGroundingError)

    found = understand(services, text, translator=translator, candidates=candidates, fits=fits)
    found = tuple(translation for translation in found if _is_stored(services, translation.query))
    return Translated(text, tuple(Reading(t.query, t.confidence, *mean(t.query)) for t in found), environment)


def ground(services: Services, query: str, environment: str) -> tuple[Environment, Meaning]:
    """Evaluate a contextual query against its stored template in a stored environment."""
    with at("/environment"):
        world = services.environment(environment).value
    with at("/contextual_query"):
        return world, ground_query(services, parse_query(query), world)


def ground_query(
    services: Services, query: ContextualQuery, environment: Environment, *, text: str | None = None
) -> Meaning:
    """Evaluate a query against its stored template; parts of speech of `text` are asked only when nothing else decides.

    Raises:
        UnknownTemplateError: and whatever `models.queries.evaluate` raises.
    """
    with services.store.read() as transaction:
        stored = transaction.templates.get(query.task)
    template = read_template(stored)
    try:
        return Meaning(evaluate(template, query, environment), stored.warnings)
    except AmbiguousGroundingError:
        if text is None:
            raise
    from models.language import part_of_speech

    tags = [part_of_speech(text, phrase) for phrase in query.arguments]
    return Meaning(evaluate(template, query, environment, parts_of_speech=tags), stored.warnings)


async def plan(services: Services, order: PlanOrder) -> Planned:
    """Ground, compile, and run value iteration in a worker process; the policy is stored."""
    environment, meaning, formula = await run_sync(_prepare, services, order)
    job = PlanJob(environment.text, formula, order.state, order.epsilon, order.max_states, order.device)
    with (
        at("/state", only={"invalid-state"}),
        at("/options/max_states", only={"model-too-large"}),
        at("/options/device", only={"device-unavailable"}),
        at(_source(order), only={"formula-not-cosafe", "formula-too-large"}),
    ):
        answer = await services.workers.plan(run_plan, job, timeout_s=order.timeout_s)
    policy_id = await run_sync(_keep_policy, services, environment.value.name, formula, answer)
    return Planned(meaning, formula, environment.value, answer, policy_id)


def _is_stored(services: Services, query: ContextualQuery) -> bool:
    """Whether a template is stored for the query's task and number of arguments."""
    with services.store.read() as transaction:
        stored = transaction.templates.find(query.task)
    return stored is not None and stored.arity == len(query.arguments)


def _mean(
    services: Services, text: str, query: ContextualQuery, environment: Environment | None
) -> tuple[Meaning | None, CqltlError | None]:
    """What a query means in the environment, or why it means nothing there; neither without an environment."""
    if environment is None:
        return None, None
    try:
        return ground_query(services, query, environment, text=text), None
    except CqltlError as error:
        return None, error


def _prepare(services: Services, order: PlanOrder) -> tuple[LoadedEnvironment, Meaning | None, Formula]:
    """The environment, the meaning when it came from words, and the resolved formula."""
    if order.spec is None:
        assert order.environment is not None
        with at("/environment"):
            environment = services.environment(order.environment)
    else:
        with at("/environment_spec"):
            environment = LoadedEnvironment.read(order.spec)
    with at(_source(order)):
        if order.ltl is not None:
            return environment, None, resolve_grounded(parse(order.ltl), environment.value)
        if order.text is not None:
            meaning = _meaning_of(services, order.text, environment.value, order.translator)
        else:
            assert order.query is not None
            meaning = ground_query(services, parse_query(order.query), environment.value)
    return environment, meaning, meaning.task.formula


def _meaning_of(services: Services, text: str, environment: Environment, translator: str) -> Meaning:
    """What a command to be planned means; a robot must not act on a guess, so doubt is refused."""
    readings = _translate_in(services, text, environment, translator=translator, candidates=2).readings
    if not readings:
        raise NotUnderstoodError(f'no stored task fits "{text[:100]}"; GET /templates lists the known tasks')
    best = readings[0]
    if isinstance(best.refusal, AmbiguousGroundingError):
        raise AmbiguousCommandError(best.refusal.detail, choices=best.refusal.choices)
    if best.meaning is None:
        assert best.refusal is not None
        best.refusal.places = ()  # they are in a contextual query that the caller did not write
        raise best.refusal
    rivals = [reading for reading in readings if reading.confidence == best.confidence]
    if len(rivals) > 1:
        detail = f'"{text[:100]}" was taught with several meanings; send one of them as contextual_query'
        raise AmbiguousCommandError(detail, choices=(str(reading.query) for reading in rivals))
    return best.meaning


def _source(order: PlanOrder) -> str:
    """The pointer of the member that says what to do."""
    if order.text is not None:
        return "/text"
    return "/contextual_query" if order.query is not None else "/ltl"


def _keep_policy(services: Services, environment: str, formula: Formula, answer: PlanAnswer) -> str | None:
    """Store the policy under a digest of what it holds, so that the same plan has the same id."""
    if answer.policy is None:
        return None
    ltl = formula_text(formula)
    digest = hashlib.sha256(json.dumps([environment, ltl]).encode() + b"\0" + answer.policy).hexdigest()[:32]
    with services.store.write() as transaction:
        transaction.policies.add(StoredPolicy(digest, environment, ltl, answer.policy))
    return digest
