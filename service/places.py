"""Says where in the request a refusal of the core belongs."""

from __future__ import annotations

from collections.abc import Iterator, Set
from contextlib import contextmanager

from models.errors import CqltlError, Place


@contextmanager
def at(pointer: str, *, only: Set[str] | None = None) -> Iterator[None]:
    """Prefix the places of a refusal raised inside with `pointer`, or name `pointer` itself when it has none.

    With `only`, refusals with other slugs pass unchanged, and so do those that an inner `at` has placed.
    """
    try:
        yield
    except CqltlError as error:
        if (only is None or error.slug in only) and not error.placed:
            error.places = tuple(Place(pointer + place.pointer, place.detail) for place in error.places) or (
                Place(pointer, error.detail),
            )
            error.placed = True
        raise
