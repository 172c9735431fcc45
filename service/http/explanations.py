"""`/explain`."""

from __future__ import annotations

from collections.abc import Sequence

from anyio.to_thread import run_sync
from fastapi import APIRouter

from models.logic import to_text as formula_text
from models.queries import ContextualQuery, QueryPart, pointer_of
from models.world import Environment, Part, explain, outline
from service.explaining import Explained, explain_request
from service.http.dependencies import BODY, GROUNDING, ServicesDep, refusals
from service.http.schemas import ExplainRequest, ExplainResponse, ExplanationPart, KindOut
from service.http.views import query_in, query_out

router = APIRouter(tags=["language"])


@router.post(
    "/explain",
    operation_id="explain",
    responses=refusals(
        *BODY,
        *GROUNDING,
        "unknown-environment",
        "unknown-template",
        "formula-syntax",
        "formula-too-large",
        "overloaded",
    ),
)
async def post_explain(body: ExplainRequest, services: ServicesDep) -> ExplainResponse:
    """Read a formula or a contextual query back in plain English, part by part."""
    query = body.contextual_query if body.query is None else query_in(body.query)
    explained = await explain_request(services, ltl=body.ltl, query=query, environment=body.environment)
    return await run_sync(_explained_out, explained)  # a large formula has many parts to read


def _explained_out(explained: Explained) -> ExplainResponse:
    meaning, query, kind = explained.meaning, explained.query, explained.kind
    reading = explain(meaning.formula, explained.environment)
    parts = [_query_part(part, explained.environment) for part in query.parts] if query else []
    return ExplainResponse(
        contextual_query=None if meaning.query is None else query_out(meaning.query),
        ltl=formula_text(meaning.formula),
        explanation=reading if query is None else query.explanation,
        reading=reading,
        kind=None if kind is None else KindOut(name=kind, explanation=kind.plain),
        parts=parts or _formula_parts(outline(meaning.formula, explained.environment)),
        warnings=list(explained.warnings),
    )


def _query_part(part: QueryPart, environment: Environment | None) -> ExplanationPart:
    operands = [_query_part(operand, environment) for operand in part.parts]
    is_task = isinstance(part.query, ContextualQuery)
    return ExplanationPart(
        part=pointer_of(part.path),
        ltl=formula_text(part.formula),
        explanation=part.explanation,
        parts=_formula_parts(outline(part.formula, environment)) if is_task else operands,
    )


def _formula_parts(parts: Sequence[Part]) -> list[ExplanationPart]:
    return [
        ExplanationPart(
            part=None,
            ltl=formula_text(part.formula),
            explanation=part.explanation,
            parts=_formula_parts(part.parts),
        )
        for part in parts
    ]
