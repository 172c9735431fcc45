"""What routes receive, and how they document their refusals."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Annotated, Any, TypeVar

from fastapi import Depends, Query, Request

from service.http.problems import MEDIA_TYPE, STATUS
from service.http.schemas.problems import Problem
from service.services import Services

T = TypeVar("T")


async def _services(request: Request) -> Services:  # not in a thread: that costs more than it does
    services: Services = request.state.services
    return services


ServicesDep = Annotated[Services, Depends(_services)]

Cursor = Annotated[str, Query(max_length=200, description="`next` of the page before; empty for the first.")]
Limit = Annotated[int, Query(ge=1, le=200, description="Most items of the page.")]


def page_of(found: Sequence[T], limit: int, key: Callable[[T], str]) -> tuple[Sequence[T], str | None]:
    """A page and the cursor of the next one, from up to `limit + 1` rows in the order of their keys."""
    return found[:limit], key(found[limit - 1]) if len(found) > limit else None


def refusals(*slugs: str) -> dict[int | str, dict[str, Any]]:
    """The `responses` argument of a route that may answer with these problems."""
    by_status: dict[int, list[str]] = {}
    for slug in slugs:
        by_status.setdefault(STATUS[slug], []).append(slug)
    return {
        status: {
            "model": Problem,
            "description": ", ".join(f"`{slug}`" for slug in found),
            "content": {MEDIA_TYPE: {}},
        }
        for status, found in sorted(by_status.items())
    }


BODY = ("malformed-json", "body-too-large", "body-too-deep", "unsupported-media-type", "validation")
"""What any route with a body may refuse."""
GROUNDING = (
    "query-syntax",
    "arity-mismatch",
    "impossible-composition",
    "unknown-object",
    "unknown-proposition",
    "type-mismatch",
    "ambiguous-grounding",
)
"""What grounding a contextual query may refuse."""
