"""`/translate`, `/learn`, `/ground`."""

from __future__ import annotations

from functools import partial

from anyio.to_thread import run_sync
from fastapi import APIRouter, Request, Response

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
from service.pipeline import ground, translate

router = APIRouter(tags=["language"])


@router.post(
    "/translate",
    operation_id="translate",
    responses=refusals(*BODY, "unknown-environment", "invalid-state", "text-too-long", "wrong-answer"),
)
async def post_translate(body: TranslateRequest, services: ServicesDep, request: Request) -> TranslateResponse:
    """Translate an English command into a contextual query and, in an environment, into grounded LTL."""

    def translated() -> TranslateResponse:
        found = translate(
            services,
            body.text,
            environment=body.environment,
            state=body.state,
            translator=body.translator,
            candidates=body.candidates,
            answers=answers_in(body.answers),
        )
        request.state.translated_under = found.versions  # for `service.http.shortcut`
        return translated_out(found)

    return await services.in_turn(translated)


@router.post(
    "/translate/batch",
    operation_id="translateBatch",
    responses=refusals(*BODY, "unknown-environment", "invalid-state", "text-too-long"),
)
async def post_translate_batch(body: BatchRequest, services: ServicesDep) -> BatchResponse:
    """Translate several commands."""

    def translated(index: int, text: str) -> TranslateResponse:
        return translated_out(
            translate(
                services,
                text,
                environment=body.environment,
                state=body.state,
                translator=body.translator,
                candidates=body.candidates,
                pointer=f"/texts/{index}",
            )
        )

    # Each waits for its turn, so that nobody waits for a whole batch.
    items = [await services.in_turn(partial(translated, index, text)) for index, text in enumerate(body.texts)]
    return BatchResponse(items=items)


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
