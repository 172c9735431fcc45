"""Linear temporal logic over propositional functions: reading, writing, comparing, and automata."""

from models.logic.automaton import Automaton, Pair
from models.logic.dialect import Dialect
from models.logic.errors import (
    FormulaSyntaxError,
    FormulaTooLargeError,
    InvalidNameError,
    SpotMissingError,
)
from models.logic.formula import (
    FALSE,
    MAX_DEPTH,
    MAX_SIZE,
    TRUE,
    Atom,
    Binary,
    Constant,
    Formula,
    Name,
    Nary,
    Op,
    Parameter,
    Term,
    Unary,
    atoms,
    children,
    conjunction,
    disjunction,
    fold,
    map_atoms,
    nary,
    substitute,
    walk,
)
from models.logic.hierarchy import PropertyClass, classify
from models.logic.parser import MAX_TEXT, parse
from models.logic.printer import atom_text, to_text
from models.logic.simpler import simplify
from models.logic.spot import MAX_ATOMS, equivalent, is_satisfiable, is_valid
from models.logic.translation import MAX_TABLE, is_cosafe, translate

__all__ = [
    "FALSE",
    "MAX_ATOMS",
    "MAX_DEPTH",
    "MAX_SIZE",
    "MAX_TABLE",
    "MAX_TEXT",
    "TRUE",
    "Atom",
    "Automaton",
    "Binary",
    "Constant",
    "Dialect",
    "Formula",
    "FormulaSyntaxError",
    "FormulaTooLargeError",
    "InvalidNameError",
    "Name",
    "Nary",
    "Op",
    "Pair",
    "Parameter",
    "PropertyClass",
    "SpotMissingError",
    "Term",
    "Unary",
    "atom_text",
    "atoms",
    "children",
    "classify",
    "conjunction",
    "disjunction",
    "equivalent",
    "fold",
    "is_cosafe",
    "is_satisfiable",
    "is_valid",
    "map_atoms",
    "nary",
    "parse",
    "simplify",
    "substitute",
    "to_text",
    "translate",
    "walk",
]
