"""From the values of the pipeline to the shapes of responses."""

from __future__ import annotations

from typing import Any
from urllib.parse import quote

from models.errors import CqltlError
from models.logic import to_text as formula_text
from models.queries import AmbiguousGroundingError, ContextualQuery, GroundedTask
from models.world import Environment, EnvironmentSpec, explain
from service.http.problems import ErrorPlace
from service.http.schemas import (
    BindingOut,
    CandidateOut,
    ContextualQueryOut,
    PairOut,
    ParameterOut,
    QuestionOut,
    TemplateOut,
    TranslateResponse,
)
from service.pipeline import Reading, Translated
from service.store import StoredTemplate


def environment_data(spec: EnvironmentSpec) -> dict[str, Any]:
    """The data of an environment as it was sent, defaults left out, for `models.world.load_environment`."""
    return spec.model_dump(mode="json", by_alias=True, exclude_defaults=True) | {"kind": spec.kind}


def location(*parts: str) -> str:
    """The path of a resource, with each part fit for a header."""
    return "".join(f"/{quote(part, safe='')}" for part in parts)


def query_out(query: ContextualQuery) -> ContextualQueryOut:
    """A contextual query."""
    return ContextualQueryOut(text=str(query), task=query.task, arguments=list(query.arguments))


def bindings_out(task: GroundedTask) -> list[BindingOut]:
    """The bindings of a grounded task."""
    return [
        BindingOut(
            argument=binding.position,
            phrase=binding.phrase,
            name=binding.candidate.symbol.name,
            kind=binding.candidate.symbol.kind,
            reason=binding.candidate.reason,
        )
        for binding in task.bindings
    ]


def template_out(stored: StoredTemplate) -> TemplateOut:
    """A stored template."""
    return TemplateOut(
        task=stored.task,
        arity=stored.arity,
        parameters=[
            ParameterOut(position=position, type=" | ".join(kinds))
            for position, kinds in enumerate(stored.kinds, start=1)
        ],
        template=stored.template,
        lifted=stored.lifted,
        pairs=[
            PairOut(contextual_query=p.contextual_query, ltl=p.ltl, environment=p.environment) for p in stored.pairs
        ],
        examples=[example.text for example in stored.examples],
        revision=stored.revision,
        warnings=list(stored.warnings),
    )


def translated_out(translated: Translated) -> TranslateResponse:
    """A translation; its first reading is spelled out beside the list of candidates."""
    candidates = [_candidate(reading, translated.environment) for reading in translated.readings]
    best = candidates[0] if candidates else None
    return TranslateResponse(
        text=translated.text,
        outcome=translated.outcome,
        contextual_query=best.contextual_query if best else None,
        ltl=best.ltl if best else None,
        confidence=best.confidence if best else None,
        explanation=best.explanation if best else None,
        bindings=best.bindings if best else [],
        candidates=candidates,
        question=_question(translated),
        warnings=best.warnings if best else [],
        issues=best.issues if best else [],
    )


def _candidate(reading: Reading, environment: Environment | None) -> CandidateOut:
    task = None if reading.meaning is None else reading.meaning.task
    return CandidateOut(
        contextual_query=query_out(reading.query),
        ltl=None if task is None else formula_text(task.formula),
        confidence=round(reading.confidence, 6),
        explanation=None if task is None else explain(task.formula, environment),
        bindings=[] if task is None else bindings_out(task),
        warnings=[] if reading.meaning is None else list(reading.meaning.warnings),
        issues=[] if reading.refusal is None else _issues(reading.refusal),
    )


def _issues(refusal: CqltlError) -> list[ErrorPlace]:
    places = [ErrorPlace(pointer=f"/contextual_query{p.pointer}", detail=p.detail) for p in refusal.places]
    return places or [ErrorPlace(pointer="/contextual_query", detail=refusal.detail)]


def _question(translated: Translated) -> QuestionOut | None:
    refusal = translated.readings[0].refusal if translated.readings else None
    if not isinstance(refusal, AmbiguousGroundingError):
        return None
    return QuestionOut(
        argument=refusal.position,
        text=f"which {refusal.phrase}?",
        choices=list(refusal.choices),
    )
