"""From the values of the pipeline to the shapes of responses."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import zip_longest
from typing import Any, overload
from urllib.parse import quote

from models.errors import Place
from models.logic import to_text as formula_text
from models.queries import Composition, ContextualQuery, Operator, Query, pointer_of
from models.world import Environment, EnvironmentSpec
from service.http.schemas import (
    AnswerIn,
    BindingOut,
    CandidateOut,
    ContextualQueryTree,
    ErrorPlace,
    ExampleOut,
    PairOut,
    ParameterOut,
    QuestionOut,
    TemplateOut,
    ThingOut,
    TranslateResponse,
)
from service.pipeline import Translated
from service.places import at
from service.questions import Answer
from service.store import StoredExample, StoredTemplate
from service.taught import Taught
from service.understanding import Meaning, Understanding


def environment_data(spec: EnvironmentSpec) -> dict[str, Any]:
    """The data of an environment as it was sent, defaults left out, for `models.world.load_environment`."""
    return spec.model_dump(mode="json", by_alias=True, exclude_defaults=True) | {"kind": spec.kind}


def location(*parts: str) -> str:
    """The path of a resource, with each part fit for a header."""
    return "".join(f"/{quote(part, safe='')}" for part in parts)


def query_out(query: Query) -> ContextualQueryTree:
    """A contextual query in parts."""
    if isinstance(query, ContextualQuery):
        return ContextualQueryTree(text=str(query), task=query.task, arguments=list(query.arguments))
    operands = [query_out(operand) for operand in query.operands]
    return ContextualQueryTree(text=str(query), operator=query.operator.value, operands=operands)


def query_in(tree: ContextualQueryTree, pointer: str = "/query") -> Query:
    """The query that was sent in parts, at a pointer; raises QuerySyntaxError with the part that is wrong."""
    operands = tuple(query_in(part, f"{pointer}/operands/{place}") for place, part in enumerate(tree.operands))
    with at(pointer):
        if tree.operator is None:
            assert tree.task is not None
            return ContextualQuery(tree.task, tuple(tree.arguments))
        return Composition(Operator(tree.operator), operands)


def bindings_out(meaning: Meaning) -> list[BindingOut]:
    """The bindings of a meaning that comes from a contextual query; none of a formula."""
    return [
        BindingOut(
            part=pointer_of(path),
            argument=binding.position,
            phrase=binding.phrase,
            quantifier=binding.quantifier.value,
            name=binding.candidate.symbol.name,
            kind=binding.candidate.symbol.kind,
            reason=binding.candidate.reason,
            things=[
                ThingOut(name=found.symbol.name, kind=found.symbol.kind, reason=found.reason)
                for found in binding.candidates
            ],
        )
        for path, binding in meaning.bindings
    ]


def template_out(stored: StoredTemplate, *further_warnings: str) -> TemplateOut:
    """A stored template."""
    return TemplateOut(
        task=stored.task,
        arity=stored.arity,
        parameters=[
            ParameterOut(position=position, type=" | ".join(kinds), taught=" | ".join(taught))
            for position, (kinds, taught) in enumerate(zip_longest(stored.kinds, stored.taught, fillvalue=()), start=1)
        ],
        template=stored.template,
        explanation=stored.words,
        reading=stored.reading,
        lifted=stored.lifted,
        pairs=[
            PairOut(contextual_query=p.contextual_query, ltl=p.ltl, environment=p.environment) for p in stored.pairs
        ],
        examples=[example.text for example in stored.examples],
        revision=stored.revision,
        warnings=[*stored.warnings, *further_warnings],
    )


def example_out(example: StoredExample, taught: Taught) -> ExampleOut:
    """A taught utterance."""
    return ExampleOut(
        id=example.id,
        text=example.text,
        contextual_query=example.contextual_query,
        also_says=list(taught.conflicts(example)),
    )


def answers_in(sent: Sequence[AnswerIn]) -> tuple[Answer, ...]:
    """The answers that were sent."""
    return tuple(Answer(answer.choice, answer.part, answer.argument) for answer in sent)


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
        question=None if translated.question is None else QuestionOut.of(translated.question),
        nearest=list(translated.nearest),
        warnings=best.warnings if best else [],
        issues=best.issues if best else [],
    )


@overload
def rounded(confidence: float) -> float: ...


@overload
def rounded(confidence: float | None) -> float | None: ...


def rounded(confidence: float | None) -> float | None:
    """What float32 gives alike on every machine."""
    return None if confidence is None else round(confidence, 4)


def _candidate(reading: Understanding, environment: Environment | None) -> CandidateOut:
    meaning = reading.meaning
    return CandidateOut(
        contextual_query=None if reading.query is None else query_out(reading.query),
        ltl=None if meaning is None else formula_text(meaning.formula),
        confidence=rounded(reading.confidence),
        explanation=None if meaning is None or environment is None else meaning.explanation(environment),
        bindings=[] if meaning is None else bindings_out(meaning),
        warnings=[] if meaning is None else list(meaning.warnings),
        issues=_issues(reading),
    )


def _issues(reading: Understanding) -> list[ErrorPlace]:
    if reading.refusal is None:
        return []
    pointer = "/ltl" if reading.query is None else "/contextual_query"
    places = reading.refusal.places or (Place("", reading.refusal.detail),)
    return [ErrorPlace(pointer=pointer + place.pointer, detail=place.detail) for place in places]
