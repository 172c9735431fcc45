"""Comparing an answer with the right one: the query by its phrases, the formula by its meaning and by its shape."""

from __future__ import annotations

from functools import lru_cache

from models.language.dataset import Example
from models.language.tokens import words
from models.logic import Atom, Constant, Formula, FormulaTooLargeError, atoms, children, equivalent, map_atoms
from models.queries import ContextualQuery

Shape = tuple[object, ...]
"""The operators of a formula as nested tuples, every atom a leaf."""


def says(query: ContextualQuery | None, example: Example) -> bool:
    """Whether a query is exactly the example's; an argument that is misspelt in the text may be so in the query."""
    if query is None or query.task != example.task or len(query.arguments) != len(example.query.arguments):
        return False
    if query == example.query:
        return True
    spoken = words(example.text)
    return all(
        said == wanted or any(said == " ".join(spoken[start:end]) for start, end in places)
        for said, wanted, places in zip(query.arguments, example.query.arguments, example.mentions, strict=True)
    )


def same_meaning(left: Formula, right: Formula) -> bool:
    """Whether Spot says that the formulas are equivalent; False for a formula too large for it.

    Which atoms they hold does not matter, only which are the same, so the pairs are compared with their atoms numbered
    in order of occurrence, and each such pair once.

    Raises:
        SpotMissingError: Spot is not installed.
    """
    if left == right:
        return True
    numbers = {atom: Atom(f"a{n}") for n, atom in enumerate(dict.fromkeys((*atoms(left), *atoms(right))))}
    return _decide(map_atoms(left, numbers.__getitem__), map_atoms(right, numbers.__getitem__))


@lru_cache(maxsize=65_536)
def _decide(left: Formula, right: Formula) -> bool:
    try:
        return equivalent(left, right)
    except FormulaTooLargeError:
        return False


def shape(formula: Formula) -> Shape:
    """The formula's operators without its atoms: the task structures of the paper (§ Experimental Domains)."""
    if isinstance(formula, Atom):
        return ("atom",)
    if isinstance(formula, Constant):
        return (formula.value,)
    return (formula.op, *(shape(child) for child in children(formula)))
