"""`/translate`, `/learn`, `/ground`."""

from __future__ import annotations

from anyio.to_thread import run_sync
from fastapi import APIRouter, Response

from models.logic import to_text as formula_text
from models.world import explain
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
from service.http.views import bindings_out, location, query_in, query_out, template_out, translated_out
from service.lessons import Lesson, learn_template
from service.pipeline import ground, translate
from service.store import StoredTemplate

router = APIRouter(tags=["language"])


@router.post("/translate", operation_id="translate", responses=refusals(*BODY, "unknown-environment", "text-too-long"))
def post_translate(body: TranslateRequest, services: ServicesDep) -> TranslateResponse:
    """Translate an English command into a contextual query and, in an environment, into grounded LTL."""
    return translated_out(
        translate(
            services,
            body.text,
            environment=body.environment,
            translator=body.translator,
            candidates=body.candidates,
        )
    )


@router.post(
    "/translate/batch",
    operation_id="translateBatch",
    responses=refusals(*BODY, "unknown-environment", "text-too-long"),
)
def post_translate_batch(body: BatchRequest, services: ServicesDep) -> BatchResponse:
    """Translate several commands."""
    return BatchResponse(
        items=[
            translated_out(
                translate(
                    services,
                    text,
                    environment=body.environment,
                    translator=body.translator,
                    candidates=body.candidates,
                    pointer=f"/texts/{index}",
                )
            )
            for index, text in enumerate(body.texts)
        ]
    )


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
            "example-too-general",
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
    )
    try:
        stored, created = await learn_template(services, lesson, note=keeping(once, _learned))
    except AnsweredMeanwhile:
        return await kept_response(services, once)  # type: ignore[return-value]
    response.status_code = 201 if created else 200
    response.headers["Location"] = location("templates", stored.task)
    return template_out(stored)


def _learned(stored: StoredTemplate, created: bool) -> tuple[int, str, TemplateOut]:
    return 201 if created else 200, location("templates", stored.task), template_out(stored)


@router.post(
    "/ground",
    operation_id="ground",
    responses=refusals(*BODY, "unknown-environment", "unknown-template", *GROUNDING),
)
async def post_ground(body: GroundRequest, services: ServicesDep) -> GroundResponse:
    """Evaluate a contextual query against its template: grounded LTL and the binding of every argument."""
    query = body.contextual_query if body.query is None else query_in(body.query)
    assert query is not None
    environment, meaning = await run_sync(ground, services, query, body.environment)
    assert meaning.query is not None
    return GroundResponse(
        contextual_query=query_out(meaning.query),
        ltl=formula_text(meaning.formula),
        explanation=explain(meaning.formula, environment),
        bindings=bindings_out(meaning),
        warnings=list(meaning.warnings),
    )
