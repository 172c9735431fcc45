"""Refusals as plain data, which a job keeps and a problem is made of."""

from __future__ import annotations

from dataclasses import asdict
from typing import Any

from models.errors import CqltlError
from service.errors import AmbiguousCommandError

_FURTHER = ("line", "column", "caret")


def refusal_data(error: CqltlError) -> dict[str, Any]:
    """The slug, the sentence, the places, and what only some refusals have."""
    data: dict[str, Any] = {
        "slug": error.slug,
        "detail": error.detail,
        "errors": [{"pointer": place.pointer, "detail": place.detail} for place in error.places],
    }
    data.update({name: getattr(error, name) for name in _FURTHER if hasattr(error, name)})
    if hasattr(error, "choices"):
        data["choices"] = list(error.choices)
    if isinstance(error, AmbiguousCommandError):
        data["question"] = asdict(error.question)
    return data


def failure_data() -> dict[str, Any]:
    """What is said of a failure of the service itself."""
    return {"slug": "internal", "detail": "the service failed on this; the failure is in its log", "errors": []}
