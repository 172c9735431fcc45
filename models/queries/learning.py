"""The CQ-LTL algorithm: contextual query + grounded LTL → templated LTL (paper, § CQ-LTL Algorithm).

Step 1 lifts the formula. Step 2 grounds the query's arguments and matches them with the arguments of the
propositional functions. With several examples, the places of the formula that held the same object in each
example form a *column*; an argument can feed a column only if its groundings allow it in every example. The mapping
is accepted when exactly one way remains to give every argument a column of its own. The paper's demand that
groundings be distinct is the case where two arguments are left with one column.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

from models.errors import CqltlError, Place
from models.logic import Atom, Constant, Formula, Parameter, children
from models.logic.formula import build
from models.queries.contextual_query import ContextualQuery
from models.queries.errors import (
    AmbiguousParameterMappingError,
    InconsistentExamplesError,
    UnusedParameterError,
)
from models.queries.lifting import lift, resolve_grounded, shape, slots
from models.queries.template import Template, nothing_called, parameter_kinds
from models.world import Environment, Quantifier, Symbol, UnknownObjectError, ground

Column = tuple[Symbol, ...]
"""The symbols that a set of places of the formula holds, one per example."""


@dataclass(frozen=True, slots=True)
class Example:
    """One contextual query with the grounded LTL formula of the same task."""

    query: ContextualQuery
    formula: Formula


def learn(examples: Sequence[Example], environment: Environment) -> Template:
    """Derive the templated LTL of one task class from one or more examples.

    Objects that no argument grounds to stay constants of the template; an argument feeds every place that holds
    its object. Pointers of refusals are relative to the list of examples (`/0/query/arguments/1`).

    Raises:
        UnknownPropositionError, UnknownObjectError, TypeMismatchError: a formula does not fit the environment, or a
            phrase names nothing in it.
        UnusedParameterError: an argument grounds to nothing that the formula mentions.
        AmbiguousParameterMappingError: no mapping, or more than one, gives each argument places of its own.
        InconsistentExamplesError: the examples differ in task, arity, formula shape, or in a constant.
    """
    if not examples:
        raise ValueError("one example or more")
    task, arity = examples[0].query.task, len(examples[0].query.arguments)
    resolved = [_resolve(example.formula, index, environment) for index, example in enumerate(examples)]
    _require_same_shape(examples, resolved)
    columns = list(zip(*([symbol for _, symbol in slots(f, environment)] for f in resolved), strict=True))
    distinct = list(dict.fromkeys(columns))
    choices = [_feasible(examples, index, distinct, environment) for index in range(arity)]
    mapping = _only_mapping(examples[0].query, choices)
    positions = {column: position for position, column in enumerate(mapping, start=1)}
    _require_constant(columns, positions)
    formula = _tie(resolved[0], iter(columns), positions)
    kinds = parameter_kinds(formula, environment, arity)
    taught = tuple(frozenset(symbol.kind for symbol in column) for column in mapping)
    return Template(task, formula, lift(resolved[0], environment).formula, kinds, taught)


def _resolve(formula: Formula, index: int, environment: Environment) -> Formula:
    try:
        return resolve_grounded(formula, environment)
    except CqltlError as error:
        error.places = (Place(f"/{index}/formula", error.detail),)
        raise


def _require_same_shape(examples: Sequence[Example], formulas: Sequence[Formula]) -> None:
    first = examples[0].query
    for index, (example, formula) in enumerate(zip(examples, formulas, strict=True)):
        query, pointer = example.query, f"/{index}"
        if query.task != first.task or len(query.arguments) != len(first.arguments):
            detail = f"{query} is not of the same task as {first}"
            raise InconsistentExamplesError(detail, places=[Place(f"{pointer}/query", detail)])
        if shape(formula) != shape(formulas[0]):
            detail = f"the formula of {query} has another shape than the first example's"
            raise InconsistentExamplesError(detail, places=[Place(f"{pointer}/formula", detail)])


def _feasible(
    examples: Sequence[Example], index: int, columns: Sequence[Column], environment: Environment
) -> list[Column]:
    """The columns that argument `index` may feed in every example."""
    remaining = list(columns)
    for number, example in enumerate(examples):
        phrase = example.query.arguments[index]
        pointer = f"/{number}/query/arguments/{index}"
        found = ground(phrase, environment)
        if found.quantifier is not Quantifier.ONE:
            detail = f'"{phrase}" speaks of {found.quantifier.value} of several things; in an example, name one'
            raise UnknownObjectError(detail, places=[Place(pointer, detail)])
        symbols = {each.symbol for each in found.candidates if each.misspelt is None}  # what is taught is exact
        if not symbols:
            detail = nothing_called(phrase, environment)
            raise UnknownObjectError(detail, places=[Place(pointer, detail)])
        remaining = [column for column in remaining if column[number] in symbols]
        if not remaining:
            detail = f'the formula does not mention "{phrase}"' + (" where the examples before it do" if number else "")
            raise UnusedParameterError(detail, places=[Place(pointer, detail)])
    return remaining


def _only_mapping(query: ContextualQuery, choices: Sequence[Sequence[Column]]) -> tuple[Column, ...]:
    """The one way to give each argument a column of its own.

    Arguments with one column left take it, until none is left. If every remaining argument still has two or more,
    there are several mappings or none: following alternating edges from any one mapping leads to another.

    Raises:
        AmbiguousParameterMappingError: there is no mapping, or there are several.
    """
    left = {index: list(columns) for index, columns in enumerate(choices)}
    mapping: dict[int, Column] = {}
    while left:
        decided = next((index for index, columns in left.items() if len(columns) == 1), None)
        if decided is None:
            raise _ambiguous(query, list(left))
        column = left.pop(decided)[0]
        mapping[decided] = column
        clash = [index for index, columns in left.items() if columns == [column]]
        if clash:
            raise _ambiguous(query, [decided, *clash])
        left = {index: [c for c in columns if c != column] for index, columns in left.items()}
    return tuple(mapping[index] for index in range(len(choices)))


def _ambiguous(query: ContextualQuery, culprits: Sequence[int]) -> AmbiguousParameterMappingError:
    named = " and ".join(f'{index + 1} ("{query.arguments[index]}")' for index in sorted(culprits))
    what = "arguments" if len(culprits) > 1 else "argument"
    detail = (
        f"{what} {named} of {query} could stand at more than one place of the formula, so which is which cannot be "
        "told; give an example whose arguments are distinct objects"
    )
    places = [Place(f"/0/query/arguments/{index}", "its place cannot be told") for index in sorted(culprits)]
    return AmbiguousParameterMappingError(detail, places=places)


def _require_constant(columns: Sequence[Column], positions: dict[Column, int]) -> None:
    for column in columns:
        if column not in positions and len(set(column)) > 1:
            names = " and ".join(dict.fromkeys(symbol.name for symbol in column))
            raise InconsistentExamplesError(
                f"the examples name {names} at the same place, and no argument of the query accounts for it"
            )


def _tie(formula: Formula, columns: Iterator[Column], positions: dict[Column, int]) -> Formula:
    """Replace, occurrence by occurrence from the left, the symbols of mapped columns by their parameters."""
    if isinstance(formula, Atom):
        found = [(term, positions.get(next(columns))) for term in formula.arguments]
        return Atom(formula.function, tuple(term if at is None else Parameter(at) for term, at in found))
    if isinstance(formula, Constant):
        return formula
    return build(formula.op, [_tie(child, columns, positions) for child in children(formula)])
