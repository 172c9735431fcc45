"""The base of every refusal the core raises.

    CqltlError
    ├── models.logic    FormulaSyntaxError, FormulaTooLargeError, FormulaNotCosafeError, SpotMissingError, ...
    ├── models.world    WorldError, StateError, UnknownPropositionError, UnknownObjectError, ...
    ├── models.queries  QuerySyntaxError, AmbiguousParameterMappingError, ...
    ├── models.planning ModelTooLargeError, InvalidMemoryError, ...
    └── models.language TextTooLongError, ExampleArgumentNotFoundError, ...

Each class names its stable `slug`; the service turns slug and status into an RFC 9457 problem. A message is a
sentence for the caller, never a stack trace.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from typing import Any, ClassVar


@dataclass(frozen=True, slots=True)
class Place:
    """One wrong place: a JSON pointer relative to the value that was read (`""` is the whole), and what is wrong."""

    pointer: str
    detail: str


class CqltlError(Exception):
    """A refusal with a stable slug, a sentence, and the places it is about (possibly none)."""

    slug: ClassVar[str] = "error"

    def __init__(self, detail: str, *, places: Iterable[Place] = ()) -> None:
        super().__init__(detail)
        self.detail = detail
        self.places = tuple(places)
        self.placed = False
        """Whether `places` are relative to the whole request already."""

    def __reduce__(self) -> tuple[Any, ...]:
        # Subclasses take keyword-only arguments; worker processes send refusals back by pickle.
        return (_rebuild, (type(self), self.args, dict(self.__dict__)))


def _rebuild(kind: type[CqltlError], args: tuple[object, ...], attributes: dict[str, Any]) -> CqltlError:
    error = kind.__new__(kind, *args)
    error.args = args
    error.__dict__.update(attributes)
    return error
