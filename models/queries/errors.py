"""What queries and templates refuse.

CqltlError
├── QuerySyntaxError                  the text is not a contextual query: line, column, caret
├── AmbiguousParameterMappingError    two arguments could fill the same place: the paper's non-distinct groundings
├── UnusedParameterError              an argument names nothing the formula mentions
├── InconsistentExamplesError         the examples of one task have no template in common
├── ArityMismatchError                a query has more or fewer arguments than its template
├── AmbiguousGroundingError           a phrase fits several objects
├── CompositionError                  an operator has no meaning for its operands
└── ExplanationError                  the words for a task do not say its arguments
"""

from __future__ import annotations

from collections.abc import Sequence

from models.errors import CqltlError, Place
from models.world import Candidate


class QuerySyntaxError(CqltlError):
    """The text is not a contextual query; `line` and `column` are 1-based, `caret` marks the place."""

    slug = "query-syntax"

    def __init__(self, detail: str, *, line: int = 1, column: int = 1, caret: str = "") -> None:
        super().__init__(detail)
        self.line = line
        self.column = column
        self.caret = caret


class AmbiguousParameterMappingError(CqltlError):
    """More than one tie between arguments and places of the formula is possible (paper, § CQ-LTL Algorithm)."""

    slug = "ambiguous-parameter-mapping"


class UnusedParameterError(CqltlError):
    """An argument of the query grounds to nothing that the formula mentions."""

    slug = "unused-parameter"


class InconsistentExamplesError(CqltlError):
    """The examples given for one task differ in more than their arguments."""

    slug = "inconsistent-examples"


class ArityMismatchError(CqltlError):
    """The query's number of arguments is not the template's."""

    slug = "arity-mismatch"


class AmbiguousGroundingError(CqltlError):
    """The phrase of argument `position` (1-based) fits several objects: `candidates`, each with the reason."""

    slug = "ambiguous-grounding"

    def __init__(
        self,
        detail: str,
        *,
        position: int,
        phrase: str,
        candidates: Sequence[Candidate],
        places: Sequence[Place],
    ) -> None:
        super().__init__(detail, places=places)
        self.position = position
        self.phrase = phrase
        self.candidates = tuple(candidates)

    @property
    def choices(self) -> tuple[str, ...]:
        """The names of the candidates, with their kinds where two have the same name."""
        symbols = [candidate.symbol for candidate in self.candidates]
        names = [symbol.name for symbol in symbols]
        return tuple(s.name if names.count(s.name) == 1 else f"{s.kind}.{s.name}" for s in symbols)


class CompositionError(CqltlError):
    """An operator of a composed query has no meaning for its operands."""

    slug = "impossible-composition"


class ExplanationError(CqltlError):
    """The words for a task have a slot that is no argument, or lack one."""

    slug = "invalid-explanation"
