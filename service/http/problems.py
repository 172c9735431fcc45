"""Errors as RFC 9457 problems. docs/http.md lists every slug; a test compares the two."""

from __future__ import annotations

import logging
from collections.abc import Mapping, Sequence
from http import HTTPStatus
from typing import Any

from fastapi import FastAPI, Request
from fastapi.exceptions import RequestValidationError
from fastapi.responses import JSONResponse
from sqlalchemy.exc import DataError, OperationalError
from starlette.exceptions import HTTPException
from starlette.routing import Match

from models.errors import CqltlError
from service.http.members import said
from service.http.schemas.problems import ErrorPlace, Problem
from service.refusals import refusal_data
from service.store.dialect import is_full

MEDIA_TYPE = "application/problem+json"
TYPE_PREFIX = "urn:cqltl:problem:"

STATUS: dict[str, int] = {
    # the request's form
    "malformed-json": 400,
    "validation": 422,
    "body-too-large": 413,
    "body-too-deep": 422,
    "unsupported-media-type": 415,
    "method-not-allowed": 405,
    "http-error": 400,
    "request-timeout": 408,
    "internal": 500,
    # who sends it
    "unauthorized": 401,
    "forbidden": 403,
    "rate-limited": 429,
    # what it names
    "not-found": 404,
    "unknown-environment": 404,
    "unknown-template": 404,
    "unknown-example": 404,
    "unknown-policy": 404,
    "unknown-job": 404,
    "idempotency-key-reused": 422,
    "environment-exists": 409,
    "template-conflict": 409,
    # formulas and queries
    "formula-syntax": 422,
    "formula-too-large": 422,
    "query-syntax": 422,
    "arity-mismatch": 422,
    "impossible-composition": 422,
    "unknown-proposition": 422,
    "unknown-object": 422,
    "type-mismatch": 422,
    "ambiguous-parameter-mapping": 422,
    "ambiguous-grounding": 422,
    "unused-parameter": 422,
    "inconsistent-examples": 422,
    "too-many-examples": 422,
    "example-argument-not-found": 422,
    "example-mark": 422,
    "example-too-general": 422,
    "invalid-explanation": 422,
    # language
    "text-too-long": 422,
    "not-understood": 422,
    "ambiguous-command": 422,
    "wrong-answer": 422,
    # worlds and plans
    "invalid-environment": 422,
    "invalid-state": 422,
    "invalid-memory": 422,
    "model-too-large": 422,
    "device-unavailable": 422,
    "drawing-too-large": 422,
    "out-of-time": 422,
    "out-of-memory": 422,
    # the service
    "overloaded": 503,
    "worker-died": 503,
    "not-ready": 503,
    "insufficient-storage": 507,
    "spot-missing": 503,
}
"""Status of every slug."""

METHODS = ("DELETE", "GET", "PATCH", "POST", "PUT")

_log = logging.getLogger("cqltl")


def problem_of(data: Mapping[str, Any]) -> Problem:
    """A problem of `service.refusals.refusal_data`; its status is that of its slug unless it is given."""
    slug, members = data["slug"], {name: value for name, value in data.items() if name != "slug"}
    return Problem.model_validate(
        {"type": TYPE_PREFIX + slug, "title": slug.replace("-", " "), "status": STATUS[slug], **members}
    )


def response_of(problem: Problem) -> JSONResponse:
    """The response that says it."""
    headers = {"Retry-After": "1"} if problem.status == 503 else None
    content = problem.model_dump(exclude_none=True)
    return JSONResponse(content, status_code=problem.status, headers=headers, media_type=MEDIA_TYPE)


def problem_response(slug: str, detail: str, **members: Any) -> JSONResponse:
    """The response for a problem; `members` are further members of `Problem`."""
    return response_of(problem_of({"slug": slug, "detail": detail, **members}))


def install(app: FastAPI) -> None:
    """Answer every error with a problem; what is none of these, `service.http.edge` answers."""
    app.add_exception_handler(CqltlError, _refused)
    app.add_exception_handler(RequestValidationError, _invalid)
    app.add_exception_handler(HTTPException, _http_error)
    app.add_exception_handler(OperationalError, _store_unavailable)
    app.add_exception_handler(DataError, _not_storable)


def _refused(_request: Request, error: Exception) -> JSONResponse:
    assert isinstance(error, CqltlError)
    return response_of(problem_of(refusal_data(error)))


def _invalid(request: Request, error: Exception) -> JSONResponse:
    assert isinstance(error, RequestValidationError)
    found = error.errors()
    if isinstance(error.body, (str, bytes)) and "json" not in request.headers.get("content-type", ""):
        detail = "the body is not marked as JSON: send it with the header Content-Type: application/json"
        return problem_response("unsupported-media-type", detail)
    places = [ErrorPlace(pointer=_pointer(item, error.body), detail=said(item, request)) for item in found]
    unknown = [place for place, item in zip(places, found, strict=True) if item["type"] == "extra_forbidden"]
    first = (unknown or places)[0]  # a misspelt member tells more than that the right one is missing
    return problem_response("validation", f"{first.pointer or 'the request'}: {first.detail}", errors=places)


def _pointer(item: Mapping[str, Any], body: Any) -> str:
    """The JSON pointer of a validation error; the names of union members, which pydantic adds, are left out."""
    location: Sequence[str | int] = item["loc"]
    if not location or location[0] != "body":
        return "".join(f"/{part}" for part in location)
    parts: list[str] = []
    value = body
    for number, part in enumerate(location[1:], start=2):
        missing = item["type"] == "missing" and number == len(location)
        if isinstance(value, dict) and part not in value and not missing:
            continue
        parts.append(str(part).replace("~", "~0").replace("/", "~1"))
        try:
            value = value[part]
        except (KeyError, IndexError, TypeError):
            value = None
    if item["type"].startswith("union_tag"):
        parts.append(item["ctx"]["discriminator"].strip("'"))
    return "".join(f"/{part}" for part in parts)


def _http_error(request: Request, error: Exception) -> JSONResponse:
    assert isinstance(error, HTTPException)
    slug = {404: "not-found", 405: "method-not-allowed", 413: "body-too-large"}.get(error.status_code, "http-error")
    detail = error.detail or HTTPStatus(error.status_code).phrase
    response = problem_response(slug, str(detail), status=error.status_code)
    response.headers.update(error.headers or {})
    if error.status_code == 405:
        response.headers["Allow"] = ", ".join(_allowed(request))
    return response


def _allowed(request: Request) -> list[str]:
    """The methods of the path; the framework names those of one of its routes."""

    def has(method: str) -> bool:
        scope = {**request.scope, "method": method}
        return any(route.matches(scope)[0] is Match.FULL for route in request.app.routes)

    return [method for method in METHODS if has(method)]


def _store_unavailable(request: Request, error: Exception) -> JSONResponse:
    assert isinstance(error, OperationalError)
    if is_full(error):
        _log.error("%s %s: the store has no room: %s", request.method, request.url.path, error.orig)
        return problem_response("insufficient-storage", "the store has no room for this; what it holds can be read")
    _log.warning("%s %s: the store does not answer: %s", request.method, request.url.path, error)
    return problem_response("not-ready", "the store does not answer, or is locked by another writer; try again")


def _not_storable(_request: Request, _error: Exception) -> JSONResponse:
    """PostgreSQL's texts hold everything but U+0000."""
    return problem_response("validation", "the request has a character that cannot be stored, such as U+0000")
