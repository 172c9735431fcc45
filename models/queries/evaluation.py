"""Composed queries in an environment: every task through its template, then the operators' meanings."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace

from models.errors import CqltlError, Place
from models.logic import Formula
from models.queries.contextual_query import ContextualQuery, Query
from models.queries.errors import AmbiguousGroundingError, CompositionError
from models.queries.meaning import compose
from models.queries.template import Binding, GroundedTask

Path = tuple[int, ...]
"""From the root of a query to one of its parts: the places of the operands."""


@dataclass(frozen=True, slots=True)
class GroundedQuery:
    """A query evaluated: grounded LTL and the binding of every argument, with the path of its task; and the formula of
    every part by its path.
    """

    query: Query
    formula: Formula
    bindings: tuple[tuple[Path, Binding], ...]
    parts: tuple[tuple[Path, Formula], ...]


def evaluate_query(query: Query, ground: Callable[[ContextualQuery], GroundedTask]) -> GroundedQuery:
    """Evaluate every task of a query with `ground`, and put them together.

    Raises:
        CompositionError: an operator has no meaning for its operands; the place names it.
        FormulaTooLargeError: the formula is beyond the limits of `models.logic`.
        AmbiguousGroundingError: that of the first task which is ambiguous, if no other is refused.
        CqltlError: what else `ground` raises, with its places within the whole query.
    """
    tasks: dict[Path, GroundedTask] = {}
    doubt: AmbiguousGroundingError | None = None
    for path, task in query.tasks:
        try:
            tasks[path] = ground(task)
        except CqltlError as error:
            error.places = tuple(replace(place, pointer=pointer_of(path) + place.pointer) for place in error.places)
            if not isinstance(error, AmbiguousGroundingError):
                raise
            doubt = doubt or error
    if doubt is not None:
        raise doubt
    bindings = tuple((path, binding) for path, task in tasks.items() for binding in task.bindings)
    formulas = {path: task.formula for path, task in tasks.items()}
    return GroundedQuery(query, _formula(query, formulas, ()), bindings, tuple(formulas.items()))


def _formula(query: Query, formulas: dict[Path, Formula], path: Path) -> Formula:
    """The formula of the part at a path, which is noted, as are those of its parts; those of tasks are known."""
    if isinstance(query, ContextualQuery):
        return formulas[path]
    operands = [_formula(operand, formulas, (*path, place)) for place, operand in enumerate(query.operands)]
    try:
        formulas[path] = compose(query.operator, operands)
        return formulas[path]
    except CompositionError as error:
        detail = f"{query}: {error.detail}"
        raise CompositionError(detail, places=[Place(pointer_of(path), detail)]) from None


def pointer_of(path: Path) -> str:
    """The JSON pointer of a part in the JSON form of its query."""
    return "".join(f"/operands/{place}" for place in path)
