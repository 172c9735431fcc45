"""The use cases: English in, policy out. Plain functions over the services that the composition root made."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Any, Literal

from anyio.to_thread import run_sync

from models.logic import parse
from models.logic import to_text as formula_text
from models.queries import (
    AmbiguousGroundingError,
    Query,
    evaluate,
    evaluate_query,
    parse_query,
    resolve_grounded,
)
from models.world import Environment, State
from service.errors import AmbiguousCommandError, NotUnderstoodError
from service.jobs import Commission, Planned
from service.lessons import read_template
from service.places import at
from service.services import LoadedEnvironment, Services
from service.store import Once, StoredJob
from service.understanding import Meaning, Understanding, understand
from service.worker import Device, Objective, PlanJob

Describe = Callable[[Meaning, Environment], Mapping[str, Any]]
"""What is known of a plan's answer before planning, from what is meant and where."""


@dataclass(frozen=True, slots=True)
class Translated:
    """The ways to understand a command, best first; none when no task fits. Without an environment that is None."""

    text: str
    readings: tuple[Understanding, ...]
    environment: Environment | None

    @property
    def outcome(self) -> Literal["translated", "ambiguous", "unknown"]:
        """Whether the command is understood, could mean several objects, or fits no task."""
        if not self.readings:
            return "unknown"
        return "ambiguous" if isinstance(self.readings[0].refusal, AmbiguousGroundingError) else "translated"


@dataclass(frozen=True, slots=True)
class PlanOrder:
    """What `/plan` is asked for: one of `text`, `query` (as text, or in parts) and `ltl`; one of `environment`, a name,
    and `spec`.
    """

    text: str | None
    query: str | Query | None
    ltl: str | None
    environment: str | None
    spec: Mapping[str, Any] | None
    state: State | None
    translator: str
    epsilon: float
    timeout_s: float
    max_states: int
    device: Device
    objective: Objective
    verify: bool
    relevance: bool


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
        return Translated(text, understand(services, text, world, translator=translator, candidates=candidates), world)


def ground(services: Services, query: str | Query, environment: str) -> tuple[Environment, Meaning]:
    """Evaluate a contextual query, as text or in parts, against its stored templates in a stored environment."""
    with at("/environment"):
        world = services.environment(environment).value
    with at(_pointer(query)):
        return world, _ground_query(services, query, world)


async def plan(
    services: Services, order: PlanOrder, describe: Describe, *, wait_s: float, once: Once | None = None
) -> Planned | StoredJob:
    """Ground, compile, and run value iteration in a worker process; the policy is stored.

    What takes longer than `wait_s` seconds becomes a job, and so does a request that is to be done `once`: a job that
    has ended tells what became of it. `describe` gives what is known of the answer beforehand, as JSON.
    """
    environment, meaning = await run_sync(_prepare, services, order)
    work = PlanJob(
        environment=environment.text,
        formula=meaning.formula,
        state=order.state,
        epsilon=order.epsilon,
        max_states=order.max_states,
        device=order.device,
        objective=order.objective,
        verify=order.verify,
        relevance=order.relevance,
        timeout_s=order.timeout_s,
    )
    told = describe(meaning, environment.value)
    commission = Commission(work, environment.value.name, told, _source(order))
    return await services.jobs.plan(commission, wait_s=wait_s, once=once)


def _ground_query(services: Services, said: str | Query, environment: Environment) -> Meaning:
    query = parse_query(said) if isinstance(said, str) else said
    with services.store.read() as transaction:
        stored = {task.task: transaction.templates.get(task.task) for _, task in query.tasks}
    templates = {task: read_template(template) for task, template in stored.items()}
    return Meaning.of(
        evaluate_query(query, lambda task: evaluate(templates[task.task], task, environment)), stored.values()
    )


def _prepare(services: Services, order: PlanOrder) -> tuple[LoadedEnvironment, Meaning]:
    """The environment, and what to plan for there."""
    if order.spec is None:
        assert order.environment is not None
        with at("/environment"):
            environment = services.environment(order.environment)
    else:
        with at("/environment_spec"):
            environment = LoadedEnvironment.read(order.spec)
    with at(_source(order)):
        if order.ltl is not None:
            return environment, Meaning(resolve_grounded(parse(order.ltl), environment.value))
        if order.text is not None:
            return environment, _meaning_of(services, order.text, environment.value, order.translator)
        assert order.query is not None
        return environment, _ground_query(services, order.query, environment.value)


def _meaning_of(services: Services, text: str, environment: Environment, translator: str) -> Meaning:
    """What a command to be planned means; a robot must not act on a guess, so doubt is refused."""
    readings = understand(services, text, environment, translator=translator, candidates=2)
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
        detail = f'"{text[:100]}" could mean several things; send one of them as contextual_query, or as ltl'
        raise AmbiguousCommandError(detail, choices=map(_said, rivals))
    return best.meaning


def _said(reading: Understanding) -> str:
    if reading.query is not None:
        return str(reading.query)
    return "" if reading.meaning is None else formula_text(reading.meaning.formula)


def _source(order: PlanOrder) -> str:
    """The pointer of the member that says what to do."""
    if order.text is not None:
        return "/text"
    return "/ltl" if order.query is None else _pointer(order.query)


def _pointer(query: str | Query) -> str:
    return "/contextual_query" if isinstance(query, str) else "/query"
