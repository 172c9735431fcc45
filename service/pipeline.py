"""The use cases: English in, policy out. Plain functions over the services that the composition root made."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import partial
from typing import Any, Literal

from anyio.to_thread import run_sync

from models.logic import parse
from models.queries import (
    Query,
    evaluate,
    evaluate_query,
    parse_query,
    resolve_grounded,
)
from models.world import Environment, State
from service.completions import completions, says_too_little
from service.errors import AmbiguousCommandError, NotUnderstoodError
from service.jobs import Commission, Planned
from service.places import at
from service.questions import Answer, Question, answered, left_out, question_of
from service.services import LoadedEnvironment, Services
from service.store import Once, StoredJob, Versions
from service.taught import Taught, read_template
from service.translators import DEFAULT
from service.understanding import Meaning, Understanding, nearest_tasks, understand
from service.worker import Device, Objective, PlanJob

Describe = Callable[[Meaning, Environment], Mapping[str, Any]]
"""What is known of a plan's answer before planning, from what is meant and where."""

RIVALS = 3
"""Readings that are looked at to see whether several are meant."""


@dataclass(frozen=True, slots=True)
class Translated:
    """The ways to understand a command, best first; none when no task fits, or when it leaves something out, which the
    question asks for. Without an environment that is None.
    """

    text: str
    readings: tuple[Understanding, ...]
    environment: Environment | None
    question: Question | None
    versions: Versions  # of the store, under which it stays so
    nearest: tuple[str, ...] = ()  # known tasks, where none fits

    @property
    def outcome(self) -> Literal["translated", "ambiguous", "unknown"]:
        """Whether the command is understood, leaves a question open, or fits no task."""
        if self.question is not None:
            return "ambiguous"
        return "translated" if self.readings else "unknown"


@dataclass(frozen=True, slots=True)
class PlanOrder:
    """What `/plan` is asked for: one of `text`, `query` (as text, or in parts) and `ltl`; one of `environment`, a name,
    and `spec`.
    """

    text: str | None
    answers: tuple[Answer, ...]  # to the questions that the text left open
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
    state: State | None = None,
    translator: str,
    candidates: int,
    answers: Sequence[Answer] = (),
    pointer: str = "/text",
) -> Translated:
    """Translate a command; with an environment, ground each reading and put it into its template.

    Phrases that say how things stand go by `state`; what that leaves out is as in the initial state. `answers` are to
    the questions that the command left open, in their order; `pointer` is where the text stands in the request.

    Raises:
        AnswerError: an answer is none to the question that is asked.
    """
    found = _translated(services, text, environment, state, translator, candidates, answers, pointer)
    services.metrics.translated(translator, found.outcome, found.readings[0].confidence if found.readings else None)
    return found


def _translated(
    services: Services,
    text: str,
    environment: str | None,
    state: State | None,
    translator: str,
    candidates: int,
    answers: Sequence[Answer],
    pointer: str,
) -> Translated:
    versions, taught = services.now()
    world = None if environment is None else _situated(services, environment, state, versions)
    left, question = _heard(services, taught, text, world, translator, max(candidates, RIVALS), answers, pointer)
    if left or question:
        return Translated(text, left[:candidates], world, question, versions)
    with at(pointer):
        nearest = nearest_tasks(services, taught, text, world, translator=translator)
    return Translated(text, (), world, None, versions, nearest)


def _heard(
    services: Services,
    taught: Taught,
    text: str,
    world: Environment | None,
    translator: str,
    candidates: int,
    answers: Sequence[Answer],
    pointer: str,
) -> tuple[tuple[Understanding, ...], Question | None]:
    """The ways to understand a command that the answers leave, best first, and what is to be asked next; no way but a
    question where the command leaves something out, and neither where no task fits.
    """
    first = None
    with at(pointer):
        found = understand(services, taught, text, world, translator=translator, candidates=candidates)
        if translator == DEFAULT and world is not None and says_too_little(text, found):
            filled = completions(taught, text, world)
            if filled:
                found, first = filled, left_out(filled, world)
    if first is not None and not answers:
        return (), first
    if not found:
        return (), None
    with at("", only={"wrong-answer"}):
        left = answered(text, found, answers, taught, world, first=first)
    return left, question_of(text, left, taught, world)


def ground(
    services: Services, query: str | Query, environment: str, state: State | None = None
) -> tuple[Environment, Meaning]:
    """Evaluate a contextual query, as text or in parts, against its stored templates in a stored environment, whose
    things stand as in `state`.
    """
    world = _situated(services, environment, state)
    with at(query_pointer(query)):
        return world, ground_query(services, query, world)


async def plan(
    services: Services, order: PlanOrder, describe: Describe, *, wait_s: float, once: Once | None = None
) -> Planned | StoredJob:
    """Ground, compile, and run value iteration in a worker process; the policy is stored.

    What takes longer than `wait_s` seconds becomes a job, and so does a request that is to be done `once`: a job that
    has ended tells what became of it. `describe` gives what is known of the answer beforehand, as JSON.
    """
    prepared = partial(_prepare, services, order)
    environment, meaning = await (run_sync(prepared) if order.text is None else services.in_turn(prepared))
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


def _situated(services: Services, name: str, state: State | None, versions: Versions | None = None) -> Environment:
    """A stored environment in a state."""
    with at("/environment"):
        environment = services.environment(name, versions).value
    return _in_state(environment, state)


def _in_state(environment: Environment, state: State | None) -> Environment:
    with at("/state"):
        return environment if state is None else environment.in_state(state)


def ground_query(services: Services, said: str | Query, environment: Environment) -> Meaning:
    """What a contextual query, as text or in parts, means in an environment by the stored templates."""
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
    now = _in_state(environment.value, order.state)
    if order.text is not None:
        return environment, _meaning_of(services, order, now)
    with at(_source(order)):
        if order.ltl is not None:
            return environment, Meaning(resolve_grounded(parse(order.ltl), now))
        assert order.query is not None
        return environment, ground_query(services, order.query, now)


def _meaning_of(services: Services, order: PlanOrder, environment: Environment) -> Meaning:
    """What a command to be planned means; a robot must not act on a guess, so doubt is refused."""
    assert order.text is not None
    taught, text = services.known(), order.text
    left, question = _heard(services, taught, text, environment, order.translator, RIVALS, order.answers, "/text")
    with at("/text"):
        if question is not None:
            raise AmbiguousCommandError(f'"{text[:100]}" leaves a question open: {question.text}', question)
        if not left:
            near = nearest_tasks(services, taught, text, environment, translator=order.translator)
            hint = f"the nearest known tasks are {', '.join(near)}" if near else "GET /templates lists the known tasks"
            raise NotUnderstoodError(f'no stored task fits "{text[:100]}"; {hint}')
        best = left[0]
        if best.meaning is None:
            assert best.refusal is not None
            best.refusal.places = ()  # they are in a contextual query that the caller did not write
            raise best.refusal
        return replace(best.meaning, confidence=best.confidence)


def _source(order: PlanOrder) -> str:
    """The pointer of the member that says what to do."""
    if order.text is not None:
        return "/text"
    return "/ltl" if order.query is None else query_pointer(order.query)


def query_pointer(query: str | Query) -> str:
    """The pointer of the member that has the query."""
    return "/contextual_query" if isinstance(query, str) else "/query"
