"""What a careful reader would say of a template: it is simpler than it looks, cannot hold, or keeps a constant."""

from __future__ import annotations

from collections.abc import Iterator

from models.logic import Name, atoms, is_satisfiable, is_valid, simplify, to_text
from models.queries.template import Template
from models.world import Environment, atom_symbols


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
