"""`/translate`, `/learn`, `/ground`."""

from __future__ import annotations

from collections.abc import Sequence
from functools import partial

from anyio.to_thread import run_sync
from fastapi import APIRouter, Response

from models.logic import to_text as formula_text
from service.http.dependencies import BODY, GROUNDING, ServicesDep, refusals
from service.http.idempotency import SLUGS, AnsweredMeanwhile, KeyHeader, keeping, kept_response, once_of
from service.http.schemas import (
    BatchRequest,
    BatchResponse,
    GroundRequest,
    GroundResponse,
    LearnRequest,
    TemplateOut,
    TranslateRequest,
    TranslateResponse,
)
from service.http.views import answers_in, bindings_out, location, query_in, query_out, template_out, translated_out
from service.lessons import Learned, Lesson, learn_template
from service.pipeline import Translated, ground, translate
from service.questions import Answer
from service.services import Services

router = APIRouter(tags=["language"])


@router.post(
    "/translate",
    operation_id="translate",
    responses=refusals(*BODY, "unknown-environment", "invalid-state", "text-too-long", "wrong-answer"),
)
async def post_translate(body: TranslateRequest, services: ServicesDep) -> TranslateResponse:
    """Translate an English command into a contextual query and, in an environment, into grounded LTL."""
    _, answer = await translation(services, body)
    return answer


async def translation(services: Services, asked: TranslateRequest) -> tuple[Translated, TranslateResponse]:
    """What `/translate` finds, and what it answers."""
    return await services.in_turn(partial(_translation, services, asked, asked.text, answers_in(asked.answers)))


@router.post(
    "/translate/batch",
    operation_id="translateBatch",
    responses=refusals(*BODY, "unknown-environment", "invalid-state", "text-too-long"),
)
async def post_translate_batch(body: BatchRequest, services: ServicesDep) -> BatchResponse:
    """Translate several commands."""

    # Each waits for its turn, so that nobody waits for a whole batch.
    items = []
    for index, text in enumerate(body.texts):
        each = partial(_translation, services, body, text, pointer=f"/texts/{index}")
        items.append((await services.in_turn(each))[1])
    return BatchResponse(items=items)


def _translation(
    services: Services,
    asked: TranslateRequest | BatchRequest,
    text: str,
    answers: Sequence[Answer] = (),
    pointer: str = "/text",
) -> tuple[Translated, TranslateResponse]:
    found = translate(
        services,
        text,
        environment=asked.environment,
        state=asked.state,
        translator=asked.translator,
        candidates=asked.candidates,
        answers=answers,
        pointer=pointer,
    )
    return found, translated_out(found)


@router.post(
    "/learn",
    operation_id="learn",
    status_code=201,
    responses={
        200: {
            "model": TemplateOut,
            "description": "Known already; `revision` tells whether anything was added.",
        },
        **refusals(
            *BODY,
            *SLUGS,
            "insufficient-storage",
            "unknown-environment",
            "template-conflict",
            "formula-syntax",
            "formula-too-large",
            "query-syntax",
            "unknown-proposition",
            "unknown-object",
            "type-mismatch",
            "ambiguous-parameter-mapping",
            "unused-parameter",
            "inconsistent-examples",
            "example-argument-not-found",
            "example-mark",
            "example-too-general",
            "invalid-explanation",
            "too-many-examples",
            "out-of-time",
            "overloaded",
        ),
    },
)
async def post_learn(
    body: LearnRequest, services: ServicesDep, response: Response, idempotency_key: KeyHeader = None
) -> TemplateOut:
    """Learn the template of a task class from one contextual query and its grounded LTL."""
    once = once_of("learn", idempotency_key, body)
    if (before := await kept_response(services, once)) is not None:
        return before  # type: ignore[return-value]  # FastAPI passes responses on
    lesson = Lesson(
        query=body.contextual_query,
        ltl=body.ltl,
        environment=body.environment,
        more=tuple((pair.contextual_query, pair.ltl) for pair in body.more),
        examples=tuple(body.examples),
        replace=body.replace,
        explanation=body.explanation,
    )
    try:
        learned = await learn_template(services, lesson, note=keeping(once, _learned))
    except AnsweredMeanwhile:
        return await kept_response(services, once)  # type: ignore[return-value]
    response.status_code, response.headers["Location"], answer = _learned(learned)
    return answer


def _learned(learned: Learned) -> tuple[int, str, TemplateOut]:
    status = 201 if learned.created else 200
    return status, location("templates", learned.stored.task), template_out(learned.stored, *learned.conflicts)


@router.post(
    "/ground",
    operation_id="ground",
    responses=refusals(
        *BODY, "unknown-environment", "unknown-template", "invalid-state", "formula-too-large", *GROUNDING
    ),
)
async def post_ground(body: GroundRequest, services: ServicesDep) -> GroundResponse:
    """Evaluate a contextual query against its template: grounded LTL and the binding of every argument."""
    query = body.contextual_query if body.query is None else query_in(body.query)
    assert query is not None
    environment, meaning = await run_sync(ground, services, query, body.environment, body.state)
    assert meaning.query is not None
    return GroundResponse(
        contextual_query=query_out(meaning.query),
        ltl=formula_text(meaning.formula),
        explanation=meaning.explanation(environment),
        bindings=bindings_out(meaning),
        warnings=list(meaning.warnings),
    )
