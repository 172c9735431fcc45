"""Formulas against an environment: which function, which objects, which compound names."""

from __future__ import annotations

from collections.abc import Mapping
from types import MappingProxyType
from typing import TYPE_CHECKING

from models.logic.formula import Atom, Formula, Name, Parameter, Term, atoms, map_atoms, with_terms
from models.world.compound import readings, unknown_part
from models.world.domain import Function, FunctionParameter
from models.world.errors import TypeMismatchError, UnknownObjectError, UnknownPropositionError
from models.world.names import application, hint, listing
from models.world.vocabulary import Symbol, Vocabulary

if TYPE_CHECKING:
    from models.world.environment import Environment

_NO_TERMS: Mapping[Term, Term] = MappingProxyType({})


def resolve(formula: Formula, environment: Environment, terms: Mapping[Term, Term] = _NO_TERMS) -> Formula:
    """The formula with terms replaced as by `substitute`, compound names read back, and every name canonical: each atom
    is a function of the environment applied to its own names; Parameter terms that are left are left alone.

    Raises UnknownPropositionError, UnknownObjectError or TypeMismatchError.
    """
    resolved = {atom: resolve_atom(with_terms(atom, terms), environment.vocabulary) for atom in atoms(formula)}
    return map_atoms(formula, resolved.__getitem__)


def atom_symbols(atom: Atom, environment: Environment) -> tuple[Symbol | None, ...]:
    """The typed symbol at each argument of an atom; None for a Parameter term. Raises as `resolve`."""
    return bind(atom, environment.vocabulary)


def resolve_atom(atom: Atom, vocabulary: Vocabulary) -> Atom:
    """`resolve` for one atom."""
    if not atom.arguments and not _is_nullary(atom, vocabulary):
        atom = _compound(atom, vocabulary)
    symbols = bind(atom, vocabulary)
    parameters = vocabulary.functions[atom.function].parameters
    terms = (
        Name(_canonical(symbol, parameter, vocabulary)) if symbol else term
        for symbol, term, parameter in zip(symbols, atom.arguments, parameters, strict=True)
    )
    return Atom(atom.function, tuple(terms))


def qualified_name(symbol: Symbol) -> str:
    """The name with its kind, `color.orange`: formulas may write it where the name alone has several meanings."""
    return f"{symbol.kind}.{symbol.name}"


def distinct_name(symbol: Symbol, environment: Environment) -> str:
    """The name, with its kind if something else has the same name."""
    return qualified_name(symbol) if len(environment.vocabulary.named(symbol.name)) > 1 else symbol.name


def _canonical(symbol: Symbol, parameter: FunctionParameter, vocabulary: Vocabulary) -> str:
    """The name, with its kind if the parameter takes something else of that name."""
    homonyms = [other for other in vocabulary.named(symbol.name) if other.kind in parameter.kinds]
    return qualified_name(symbol) if len(homonyms) > 1 else symbol.name


def _qualified(name: str, vocabulary: Vocabulary) -> tuple[Symbol, ...]:
    kind, dot, rest = name.partition(".")
    return tuple(symbol for symbol in vocabulary.named(rest) if symbol.kind == kind) if dot else ()


def bind(atom: Atom, vocabulary: Vocabulary) -> tuple[Symbol | None, ...]:
    """`atom_symbols` in a vocabulary."""
    function = vocabulary.functions.get(atom.function)
    if function is None:
        known = vocabulary.functions
        raise UnknownPropositionError(
            f"the environment has no propositional function {atom.function}{hint(atom.function, known)}"
        )
    if len(atom.arguments) != len(function.parameters):
        signature = _signature(function)
        raise UnknownPropositionError(
            f"{signature} takes {len(function.parameters)} arguments, not {len(atom.arguments)}"
        )
    return tuple(
        None if isinstance(term, Parameter) else _argument(term.text, parameter, function, vocabulary)
        for term, parameter in zip(atom.arguments, function.parameters, strict=True)
    )


def bind_names(atom: Atom, vocabulary: Vocabulary) -> tuple[Symbol, ...]:
    """`bind` for an atom without Parameter terms. Raises UnknownObjectError for one with them."""
    symbols = bind(atom, vocabulary)
    bound = tuple(symbol for symbol in symbols if symbol is not None)
    if len(bound) < len(symbols):
        raise UnknownObjectError(f"{atom.function} is applied to a parameter; give it an object")
    return bound


def _is_nullary(atom: Atom, vocabulary: Vocabulary) -> bool:
    function = vocabulary.functions.get(atom.function)
    return function is not None and not function.parameters


def _compound(atom: Atom, vocabulary: Vocabulary) -> Atom:
    found = readings(atom.function, vocabulary)
    if len(found) == 1:
        return found[0]
    if found:
        ways = listing(application(a.function, (t.text for t in a.arguments if isinstance(t, Name))) for a in found)
        raise UnknownPropositionError(f"{atom.function} can be read as {ways}: write the one that is meant")
    missing = unknown_part(atom.function, vocabulary)
    if missing is not None and atom.function not in vocabulary.functions:
        name, function = missing
        known = (symbol.name for symbol in vocabulary.symbols())
        raise UnknownObjectError(
            f"nothing is called {name}{hint(name, known)}, in {atom.function} as {_signature(function)}"
        )
    return atom


def _argument(name: str, parameter: FunctionParameter, function: Function, vocabulary: Vocabulary) -> Symbol:
    named = vocabulary.named(name) or _qualified(name, vocabulary) or vocabulary.loosely_named(name)
    fitting = [symbol for symbol in named if symbol.kind in parameter.kinds]
    if len(fitting) == 1:
        return fitting[0]
    kinds = listing(sorted(parameter.kinds))
    place = f"{parameter.name} of {_signature(function)}"
    if len(fitting) > 1:
        choices = listing((f"{symbol.name} ({symbol.kind})" for symbol in fitting), "and")
        ways = " or ".join(f'"{qualified_name(symbol)}"' for symbol in fitting)
        raise TypeMismatchError(f"{place} could be any of {choices}: write {ways}")
    if named:
        actual = listing(dict.fromkeys(symbol.kind for symbol in named), "and")
        raise TypeMismatchError(f"{place} must be {kinds}, but {name} is {actual}")
    known = [symbol.name for symbol in vocabulary.symbols(*parameter.kinds)]
    raise UnknownObjectError(f"nothing is called {name}{hint(name, known)}; {place} must be {kinds}")


def _signature(function: Function) -> str:
    return f"{function.name}({', '.join(parameter.name for parameter in function.parameters)})"
