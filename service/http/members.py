"""What a request body may have: the members of its model, for errors that name one which it does not have."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import Any, get_args

from fastapi import Request
from pydantic import BaseModel

from service.names import or_rather


def said(item: dict[str, Any], request: Request) -> str:
    """What is wrong by an error of pydantic, in words for those who know JSON and not pydantic."""
    if item["type"] == "missing":
        return "this member is missing"
    if item["type"] != "extra_forbidden":
        return str(item["msg"])
    known = sorted(_members(request, item["loc"][1:-1]))
    listed = f"; there are {', '.join(known)}" if known else ""
    return f"there is no such member{or_rather(str(item['loc'][-1]), known) or listed}"


def _members(request: Request, path: Sequence[str | int]) -> set[str]:
    """The members of the models that may stand at a path of the body."""
    field = getattr(request.scope.get("route"), "body_field", None)
    models = [] if field is None else list(_models(field.field_info.annotation))
    for part in path:
        models = [inner for model in models for inner in _below(model, part)]
    return {info.alias or name for model in models for name, info in model.model_fields.items()}


def _below(model: type[BaseModel], part: str | int) -> list[type[BaseModel]]:
    """The models at a part of the path; the place in a list and the tag of a union lead to the same model."""
    info = model.model_fields.get(str(part))
    return [model] if info is None else list(_models(info.annotation))


def _models(annotation: Any) -> Iterator[type[BaseModel]]:
    if isinstance(annotation, type) and issubclass(annotation, BaseModel):
        yield annotation
    for argument in get_args(annotation):
        yield from _models(argument)
