"""What a careful reader would say of a template: it is simpler than it looks, cannot hold, or keeps a constant."""

from __future__ import annotations

from collections.abc import Iterator

from models.logic import (
    FormulaTooLargeError,
    Name,
    SpotMissingError,
    atoms,
    is_satisfiable,
    is_valid,
    simplify,
    to_text,
)
from models.queries.contextual_query import Composition
from models.queries.evaluation import GroundedQuery
from models.queries.template import Template
from models.world import Environment, atom_symbols

MOST_REVIEWED = 600
"""Characters of a composed query's formula beyond which Spot is not asked about it: it answers the others in a
millisecond.
"""


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
    simpler = simplify(formula)
    if simpler != formula:
        warnings.append(
            f"{to_text(formula)} is equivalent to {to_text(simpler)}: what it has beyond that, "
            "such as an order, it does not demand"
        )
    warnings.extend(_constants(template, environment))
    return tuple(warnings)


def review_composition(grounded: GroundedQuery) -> tuple[str, ...]:
    """A warning about a composed query whose parts contradict each other, or that asks for nothing; none about a single
    task, whose template was reviewed, nor where the formula is too large to be looked at in passing.
    """
    formula = grounded.formula
    if not isinstance(grounded.query, Composition) or len(to_text(formula)) > MOST_REVIEWED:
        return ()
    try:
        if not is_satisfiable(formula):
            return ("the parts contradict each other: no run can do all of this",)
        return ("this always holds, so it asks for nothing",) if is_valid(formula) else ()
    except (FormulaTooLargeError, SpotMissingError):
        return ()


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
