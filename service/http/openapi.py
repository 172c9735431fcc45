"""The OpenAPI document: what FastAPI makes, with error media types as they are sent."""

from __future__ import annotations

from typing import Any

from fastapi import FastAPI
from fastapi.openapi.utils import get_openapi

from service.http.admission import document_admission
from service.http.links import document_links
from service.http.problems import MEDIA_TYPE

_PROBLEM = {"$ref": "#/components/schemas/Problem"}
_ENVIRONMENT = {
    "oneOf": [{"$ref": "#/components/schemas/OomdpSpec"}, {"$ref": "#/components/schemas/ExplicitSpec"}],
    "discriminator": {
        "mapping": {"explicit": "#/components/schemas/ExplicitSpec", "oomdp": "#/components/schemas/OomdpSpec"},
        "propertyName": "kind",
    },
}
_STATE = {
    "type": "object",
    "additionalProperties": {"type": "object", "additionalProperties": {"type": "string"}},
}
_NAMED: dict[str, tuple[str, dict[str, Any]]] = {
    "EnvironmentSpec": ("A world: an object-oriented MDP, or one listed state by state.", _ENVIRONMENT),
    "State": ("What is observed: object to attribute to value.", _STATE),
}
"""Schemas that FastAPI writes out where they are used. Generators would make a type of each use, with odd names."""


_RETRY_AFTER = {"schema": {"type": "integer"}, "description": "Seconds until it is worth asking again."}


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
        document_admission(document)
        _document_problems(document)
        _document_streams(document)
        _name_schemas(document)
        document_links(document)
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
                if status in ("429", "503"):
                    response["headers"] = {"Retry-After": _RETRY_AFTER}
            responses["default"] = {
                "description": "Any other problem.",
                "content": {MEDIA_TYPE: {"schema": _PROBLEM}},
            }
            operation["responses"] = dict(sorted(responses.items()))
    for name in ("HTTPValidationError", "ValidationError"):
        document["components"]["schemas"].pop(name, None)


def _document_streams(document: dict[str, Any]) -> None:
    """Server-sent events as what OpenAPI 3.1 can say of them; FastAPI writes `itemSchema`, which comes with 3.2."""
    for path in document["paths"].values():
        for operation in path.values():
            for response in operation["responses"].values():
                content = response.get("content", {})
                if "text/event-stream" in content:
                    content["text/event-stream"] = {"schema": {"type": "string"}}


def _name_schemas(document: dict[str, Any]) -> None:
    """Have every use of those refer to one that has a name."""
    document.update(_named(document))
    schemas = document["components"]["schemas"]
    for name, (description, schema) in _NAMED.items():
        schemas[name] = {"title": name, "description": description, **schema}
    document["components"]["schemas"] = dict(sorted(schemas.items()))


def _named(part: Any) -> Any:
    if isinstance(part, list):
        return [_named(item) for item in part]
    if not isinstance(part, dict):
        return part
    for name, (_, schema) in _NAMED.items():
        if schema == {key: value for key, value in part.items() if key not in ("title", "description")}:
            said = {"description": part["description"]} if "description" in part else {}
            return {"$ref": f"#/components/schemas/{name}", **said}
    return {key: _named(value) for key, value in part.items()}
