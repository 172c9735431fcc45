"""Queries with another thing as one of their arguments, and what they mean then."""

from __future__ import annotations

from collections import Counter
from dataclasses import replace

from models.language.reading import read
from models.language.scene import Scene
from models.language.translation import Translation
from models.queries import Composition, ContextualQuery, Path, Query, Template, parameter_kinds, pointer_of
from models.world import Environment, Symbol, TypeMismatchError, UnknownPropositionError
from service.taught import Taught
from service.understanding import Understanding, of_reading

MAX_CHOICES = 20
"""Most choices of a question."""


def things_for(template: Template, argument: int, environment: Environment) -> list[Symbol]:
    """What may be an argument: of the kinds that it was taught with, or where the environment has none of these, of any
    kind that it may have, those with the fewest things first; no more than a question may offer, and none where the
    environment has nothing that the template is about.
    """
    symbols = environment.symbols()
    try:
        possible = parameter_kinds(template.formula, environment, template.arity)[argument - 1]
    except (UnknownPropositionError, TypeMismatchError):
        return []
    taught = template.taught[argument - 1] if template.taught else frozenset()
    kinds = taught & {symbol.kind for symbol in symbols} or possible
    counts = Counter(symbol.kind for symbol in symbols if symbol.kind in kinds)
    offered: dict[str, int] = {}
    for kind, count in sorted(counts.items(), key=lambda item: (item[1], item[0])):
        if sum(offered.values()) + count <= MAX_CHOICES:
            offered[kind] = count
    return [symbol for symbol in symbols if symbol.kind in offered]


def reread(text: str, reading: Understanding, taught: Taught, environment: Environment | None) -> Understanding:
    """The same reading of its query as it is now."""
    assert reading.query is not None
    said = [Translation(reading.query, reading.confidence)]
    (found,) = read(said, Scene(text, environment, taught.template))
    return of_reading(found, taught.stored)


def task_at(query: Query, part: str) -> ContextualQuery | None:
    """The task of a query at a pointer, if there is one."""
    return next((task for path, task in query.tasks if pointer_of(path) == part), None)


def filled(query: Query, part: str, argument: int, phrase: str) -> Query:
    """The query with another phrase as an argument of its task at a pointer."""
    return _replaced(query, next(path for path, _ in query.tasks if pointer_of(path) == part), argument, phrase)


def _replaced(query: Query, path: Path, argument: int, phrase: str) -> Query:
    if isinstance(query, ContextualQuery):
        arguments = list(query.arguments)
        arguments[argument - 1] = phrase
        return replace(query, arguments=tuple(arguments))
    operands: list[Query] = list(query.operands)
    operands[path[0]] = _replaced(operands[path[0]], path[1:], argument, phrase)
    return Composition(query.operator, tuple(operands))
