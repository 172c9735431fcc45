"""The OpenAPI document: what FastAPI makes, with error media types as they are sent."""

from __future__ import annotations

from typing import Any

from fastapi import FastAPI
from fastapi.openapi.utils import get_openapi

from service.http.problems import MEDIA_TYPE, STATUS
from service.http.scopes import OPEN, UNLIMITED, first_part

_PROBLEM = {"$ref": "#/components/schemas/Problem"}


def openapi(app: FastAPI) -> dict[str, Any]:
    """The document of the app, made once."""
    if app.openapi_schema is None:
        document = get_openapi(
            title=app.title,
            version=app.version,
            summary=app.summary,
            description=app.description,
            license_info=app.license_info,
            routes=app.routes,
            separate_input_output_schemas=app.separate_input_output_schemas,
        )
        _document_gate(document)
        _document_problems(document)
        _document_streams(document)
        app.openapi_schema = document
    return app.openapi_schema


def _document_problems(document: dict[str, Any]) -> None:
    """Every error is a problem: FastAPI writes `application/json`, and its own schema for 422."""
    for path in document["paths"].values():
        for operation in path.values():
            responses = operation["responses"]
            for status, response in responses.items():
                if status >= "400":
                    response["content"] = {MEDIA_TYPE: {"schema": _PROBLEM}}
                    if response["description"] == "Validation Error":
                        response["description"] = "`validation`"
            responses["default"] = {
                "description": "Any other problem.",
                "content": {MEDIA_TYPE: {"schema": _PROBLEM}},
            }
            operation["responses"] = dict(sorted(responses.items()))
    for name in ("HTTPValidationError", "ValidationError"):
        document["components"]["schemas"].pop(name, None)


def _document_gate(document: dict[str, Any]) -> None:
    """What may be refused before a route is asked. A service may want keys, and need not."""
    for path, item in document["paths"].items():
        part = first_part(path)
        slugs = [] if part in OPEN else ["unauthorized", "forbidden"]
        slugs += [] if part in UNLIMITED else ["rate-limited"]
        for operation in item.values():
            for slug in [*slugs, "request-timeout"] if "requestBody" in operation else slugs:
                operation["responses"].setdefault(str(STATUS[slug]), {"description": f"`{slug}`"})
    document["components"]["securitySchemes"] = {
        "key": {"type": "http", "scheme": "bearer", "description": "An API key, where the service asks for one."}
    }
    document["security"] = [{}, {"key": []}]


def _document_streams(document: dict[str, Any]) -> None:
    """Server-sent events as what OpenAPI 3.1 can say of them; FastAPI writes `itemSchema`, which comes with 3.2."""
    for path in document["paths"].values():
        for operation in path.values():
            for response in operation["responses"].values():
                content = response.get("content", {})
                if "text/event-stream" in content:
                    content["text/event-stream"] = {"schema": {"type": "string"}}
