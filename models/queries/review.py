"""What a careful reader would say of a template: it is simpler than it looks, cannot hold, or keeps a constant."""

from __future__ import annotations

from collections.abc import Iterator

from models.logic import (
    Binary,
    Formula,
    Name,
    Nary,
    Unary,
    atoms,
    equivalent,
    is_satisfiable,
    is_valid,
    to_text,
)
from models.logic.formula import nary
from models.queries.template import Template
from models.world import Environment, atom_symbols

MAX_REVIEWED_SIZE = 60
"""Templates with more nodes than this are not searched for a simpler equivalent."""


def review(template: Template, environment: Environment) -> tuple[str, ...]:
    """Warnings about a template, in a fixed order; empty when there is nothing to say.

    Equivalence is decided by Spot, with atoms taken as independent propositions.
    """
    formula = template.formula
    if not is_satisfiable(formula):
        return (f"{to_text(formula)} can never hold",)
    if is_valid(formula):
        return (f"{to_text(formula)} always holds, so it asks for nothing",)
    warnings = []
    simpler = simplest_equivalent(formula) if formula.size <= MAX_REVIEWED_SIZE else formula
    if simpler != formula:
        warnings.append(
            f"{to_text(formula)} is equivalent to {to_text(simpler)}: what it has beyond that, "
            "such as an order, it does not demand"
        )
    warnings.extend(_constants(template, environment))
    return tuple(warnings)


def simplest_equivalent(formula: Formula) -> Formula:
    """The smallest equivalent formula reached by repeatedly putting an operand in its operator's place.

    `F (a & F (a & b))` becomes `F (a & b)`, since F includes now. The search is greedy, so the result is a simpler
    formula, not always the smallest there is.
    """
    for candidate in sorted(dict.fromkeys(_contractions(formula)), key=lambda f: (f.size, to_text(f))):
        if equivalent(candidate, formula):
            return simplest_equivalent(candidate)
    return formula


def _contractions(formula: Formula) -> Iterator[Formula]:
    """Every formula with one node replaced by one of its operands, or an operand of `&` or `|` left out."""
    match formula:
        case Unary(op=op, operand=operand):
            yield operand
            yield from (Unary(op, smaller) for smaller in _contractions(operand))
        case Binary(op=op, left=left, right=right):
            yield from (left, right)
            yield from (Binary(op, smaller, right) for smaller in _contractions(left))
            yield from (Binary(op, left, smaller) for smaller in _contractions(right))
        case Nary(op=op, operands=operands):
            for index, operand in enumerate(operands):
                rest = (operands[:index], operands[index + 1 :])
                yield nary(op, *rest[0], *rest[1])
                yield from (nary(op, *rest[0], smaller, *rest[1]) for smaller in _contractions(operand))
        case _:
            return


def _constants(template: Template, environment: Environment) -> Iterator[str]:
    """Constants of a kind that has more than one member: they look like arguments that the query lacks."""
    seen = set()
    for atom in atoms(template.formula):
        for term, symbol in zip(atom.arguments, atom_symbols(atom, environment), strict=True):
            if not isinstance(term, Name) or symbol is None or symbol in seen:
                continue
            seen.add(symbol)
            if len(environment.symbols(symbol.kind)) > 1:
                yield (
                    f"{symbol.name} is no argument of {template.task} and stays a constant: "
                    f"every {template.task} will mean this {symbol.kind}"
                )
