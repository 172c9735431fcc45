"""Step 1 of the CQ-LTL algorithm: grounded LTL to lifted LTL (paper, § CQ-LTL Algorithm)."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator
from dataclasses import dataclass

from models.logic import Atom, Constant, Formula, Name, Op, Parameter, atoms, children, map_atoms
from models.world import Environment, Symbol, UnknownObjectError, atom_symbols, resolve

Shape = tuple[object, ...]
"""A formula without its names, as nested tuples: two formulas lift to the same LTL when their shapes are equal."""


@dataclass(frozen=True, slots=True)
class LiftedFormula:
    """Lifted LTL: propositional functions over variables, and what each variable stood for."""

    formula: Formula
    variables: tuple[tuple[str, Symbol], ...]


def resolve_grounded(formula: Formula, environment: Environment) -> Formula:
    """Resolve a formula that must be grounded: it names objects, and has no parameters such as `$1`.

    Raises:
        UnknownObjectError: it has a parameter; and what `models.world.resolve` raises.
    """
    if any(isinstance(term, Parameter) for atom in atoms(formula) for term in atom.arguments):
        raise UnknownObjectError("a grounded formula names objects, not parameters such as $1")
    return resolve(formula, environment)


def lift(formula: Formula, environment: Environment) -> LiftedFormula:
    """Replace every object and attribute value by a variable named after its kind.

    The same object becomes the same variable: `F (in(cylinder, box) & at(box, bedroom))` lifts to
    `F (in(t, b) & at(b, c))`. Kinds that share a first letter, or several of a kind, are numbered.
    """
    symbols = tuple(dict.fromkeys(symbol for _, symbol in slots(formula, environment)))
    letters = Counter(symbol.kind[0].lower() for symbol in symbols)
    seen: Counter[str] = Counter()
    names: dict[Symbol, str] = {}
    for symbol in symbols:
        letter = symbol.kind[0].lower()
        seen[letter] += 1
        names[symbol] = letter if letters[letter] == 1 else f"{letter}{seen[letter]}"

    def rename(atom: Atom) -> Atom:
        terms = atom_symbols(atom, environment)
        return Atom(
            atom.function,
            tuple(
                argument if symbol is None else Name(names[symbol])
                for argument, symbol in zip(atom.arguments, terms, strict=True)
            ),
        )

    return LiftedFormula(map_atoms(formula, rename), tuple((name, symbol) for symbol, name in names.items()))


def occurrences(formula: Formula) -> Iterator[Atom]:
    """Every occurrence of an atom, left to right (an atom used twice comes twice)."""
    stack = [formula]
    while stack:
        node = stack.pop()
        if isinstance(node, Atom):
            yield node
        stack.extend(reversed(children(node)))


def slots(formula: Formula, environment: Environment) -> tuple[tuple[Atom, Symbol], ...]:
    """The symbol at every argument place of every atom occurrence, left to right, with its atom."""
    known = {atom: atom_symbols(atom, environment) for atom in atoms(formula)}
    return tuple((atom, symbol) for atom in occurrences(formula) for symbol in known[atom] if symbol is not None)


def shape(formula: Formula) -> Shape:
    """The formula's operators and propositional functions, without any name."""
    match formula:
        case Constant(value=value):
            return (value,)
        case Atom(function=function, arguments=arguments):
            return (function, len(arguments), any(isinstance(a, Parameter) for a in arguments))
        case _:
            op: Op = formula.op
            return (op, *(shape(child) for child in children(formula)))
