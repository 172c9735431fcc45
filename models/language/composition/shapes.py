"""Shapes of compositions: `then(1, or(2, 3))`, a composed query with numbers for its clauses."""

from __future__ import annotations

import re
from collections.abc import Mapping
from functools import lru_cache

from models.queries import Composition, ContextualQuery, Operator, Query, parse_query

ONE_CLAUSE = ("move_to", "pickup", "pickup_colored", "navigate_one")
"""Task classes that are said in one clause; others are said as sequences are, and preferred to them when understood."""
SEQUENCES = ("navigate_two", "navigate_three")
"""Task classes that say no more than their clauses one after the other: which of both is meant, the clauses tell."""
SINGLE = "1"
"""The shape of one command alone."""

_NUMBER = re.compile(r"\d")
_PLAIN_SEQUENCE = re.compile(r"then\([\d, ]+\)")
_PLAIN_LIST = re.compile(r"and\([\d, ]+\)")


@lru_cache(maxsize=256)
def read_shape(text: str) -> Query:
    """The shape as a query whose tasks are `clause(n)`; raises QuerySyntaxError."""
    return parse_query(_NUMBER.sub(lambda number: f"clause({number[0]})", text))


def filled(shape: Query, clauses: Mapping[int, Query]) -> Query:
    """The query of a shape with these clauses, by number; sequences and lists within their like become one, and
    what is listed twice is listed once.

    Raises QuerySyntaxError for a query beyond the limits.
    """
    if isinstance(shape, ContextualQuery):
        return clauses[int(shape.arguments[0])]
    operands: list[Query] = []
    for operand in shape.operands:
        made = filled(operand, clauses)
        flat = shape.operator in (Operator.AND, Operator.OR, Operator.THEN)
        if flat and isinstance(made, Composition) and made.operator is shape.operator:
            operands += made.operands
        else:
            operands.append(made)
    if shape.operator in (Operator.AND, Operator.OR):
        operands = list(dict.fromkeys(operands))  # "go to the kitchen and wait there"
        if len(operands) == 1:
            return operands[0]
    return Composition(shape.operator, tuple(operands))


@lru_cache(maxsize=256)
def forbidden(text: str) -> frozenset[int]:
    """The clauses of a shape that are avoided, or awaited by what is: a bare name there is a place to be at."""
    return frozenset(_inside(read_shape(text), within=False))


def _inside(shape: Query, *, within: bool) -> set[int]:
    if isinstance(shape, ContextualQuery):
        return {int(shape.arguments[0])} if within else set()
    within = within or shape.operator in (Operator.AVOID, Operator.UNTIL)
    return {number for operand in shape.operands for number in _inside(operand, within=within)}


def in_one_clause(query: Query) -> bool:
    """Whether it is of a task class that is said in one clause; the others are sequences of what others say."""
    return isinstance(query, ContextualQuery) and query.task in ONE_CLAUSE


def of_several_clauses(query: Query) -> bool:
    """Whether it is of a task class that takes several clauses to say, and says more than each of them: to put a thing
    in a box "and" carry that off.
    """
    return isinstance(query, ContextualQuery) and query.task not in (*ONE_CLAUSE, *SEQUENCES)


def has_several(shape: str) -> bool:
    """Whether a shape has more than one clause."""
    return shape != SINGLE


def forbids(shape: str) -> bool:
    """Whether it says of a clause that it must not be."""
    return "avoid(" in shape


def is_plain(shape: str) -> bool:
    """Whether a shape is one clause, or clauses one after the other and nothing else."""
    return not has_several(shape) or _PLAIN_SEQUENCE.fullmatch(shape) is not None


def is_listed(shape: str) -> bool:
    """As `_plain`, or clauses in any order."""
    return is_plain(shape) or _PLAIN_LIST.fullmatch(shape) is not None
