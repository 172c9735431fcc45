"""Composed queries in an environment: every task through its template, then the operators' meanings."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass, replace

from models.errors import CqltlError, Place
from models.logic import Formula, FormulaTooLargeError, conjunction, disjunction
from models.queries.contextual_query import ContextualQuery, Query
from models.queries.errors import AmbiguousGroundingError, CompositionError
from models.queries.meaning import compose
from models.queries.sharing import agreed, choices
from models.queries.template import MAX_COMBINATIONS, Binding, GroundedTask
from models.world import Quantifier

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
    """Evaluate every task of a query with `ground`, and put them together; what several tasks say of any or all of some
    things is said of the same thing in each (`models.queries.sharing`).

    Raises:
        CompositionError: an operator has no meaning for its operands; the place names it.
        FormulaTooLargeError: the formula is beyond the limits of `models.logic`, or there are more than
            `MAX_COMBINATIONS` ways to choose the things that tasks share.
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
    agreeing = agreed(query, tasks)
    bindings = tuple((path, binding) for path, task in agreeing.items() for binding in task.bindings)
    parts = {path: _formula(part, agreeing, path, MAX_COMBINATIONS) for path, part in _parts(query, ())}
    return GroundedQuery(query, parts[()], bindings, tuple(parts.items()))


def _parts(query: Query, path: Path) -> Iterator[tuple[Path, Query]]:
    """A query and all its parts with their paths, the whole before its parts."""
    yield path, query
    if not isinstance(query, ContextualQuery):
        for place, operand in enumerate(query.operands):
            yield from _parts(operand, (*path, place))


def _formula(query: Query, tasks: Mapping[Path, GroundedTask], path: Path, most: int) -> Formula:
    """The formula of the part at a path, with at most so many choices of things that its tasks share."""
    if isinstance(query, ContextualQuery):
        return tasks[path].formula
    if (shared := choices(query, tasks, path)) is not None:
        quantifier, chosen = shared
        if len(chosen) > most:
            raise FormulaTooLargeError(f"{query} has more than {MAX_COMBINATIONS} combinations of things")
        join = conjunction if quantifier is Quantifier.ALL else disjunction
        return join(*(_formula(query, choice, path, most // len(chosen)) for choice in chosen))
    operands = [_formula(operand, tasks, (*path, place), most) for place, operand in enumerate(query.operands)]
    try:
        return compose(query.operator, operands)
    except CompositionError as error:
        detail = f"{query}: {error.detail}"
        raise CompositionError(detail, places=[Place(pointer_of(path), detail)]) from None


def pointer_of(path: Path) -> str:
    """The JSON pointer of a part in the JSON form of its query."""
    return "".join(f"/operands/{place}" for place in path)
