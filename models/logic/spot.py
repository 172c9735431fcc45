"""The bridge to Spot, and the comparison of formulas. `translation` makes automata.

Spot (Duret-Lutz et al., "From Spot 2.0 to Spot 2.10", CAV 2022) is imported here and nowhere else, when first needed.
It never sees a caller's text: formulas are built with its constructors over the propositions p0, p1, ...
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

from models.logic.effort import obligations
from models.logic.errors import FormulaTooLargeError, SpotMissingError
from models.logic.formula import FALSE, TRUE, Atom, Constant, Formula, Op, atoms, fold

MAX_ATOMS = 16
"""Most distinct atoms in what is translated or compared."""
MAX_OBLIGATIONS = 2_048
"""Largest guess at the work (`effort.obligations`) with which Spot is called at all."""
FEW_ATOMS = 6
MAX_OBLIGATIONS_OF_FEW = 1 << 27
"""The same for at most FEW_ATOMS: parts of a long formula over few atoms repeat each other, so the guess is high."""


@dataclass(frozen=True, slots=True)
class Vocabulary:
    """The atoms that stand behind Spot's p0, p1, ..., in that order."""

    atoms: tuple[Atom, ...]

    @classmethod
    def of(cls, *formulas: Formula) -> Vocabulary:
        found = tuple(dict.fromkeys(atom for formula in formulas for atom in atoms(formula)))
        if len(found) > MAX_ATOMS:
            raise FormulaTooLargeError(f"there are {len(found)} different atoms; at most {MAX_ATOMS} can be handled")
        limit = MAX_OBLIGATIONS_OF_FEW if len(found) <= FEW_ATOMS else MAX_OBLIGATIONS
        if any(obligations(formula) > limit for formula in formulas):
            raise FormulaTooLargeError("the formula asks for too many things at once for an automaton to keep apart")
        return cls(found)

    def encode(self, formula: Formula) -> Any:
        """The formula as Spot's."""
        spot = library()
        index = {atom: spot.formula.ap(f"p{i}") for i, atom in enumerate(self.atoms)}
        make = {op: getattr(spot.formula, name) for op, name in _SPOT_OPERATORS.items()}

        def combine(node: Formula, operands: tuple[Any, ...]) -> Any:
            if isinstance(node, Atom):
                return index[node]
            if isinstance(node, Constant):
                return spot.formula.tt() if node.value else spot.formula.ff()
            return make[node.op](list(operands)) if node.op in (Op.AND, Op.OR) else make[node.op](*operands)

        return fold(formula, combine)


_SPOT_OPERATORS = {
    Op.NOT: "Not",
    Op.NEXT: "X",
    Op.FINALLY: "F",
    Op.GLOBALLY: "G",
    Op.AND: "And",
    Op.OR: "Or",
    Op.IMPLIES: "Implies",
    Op.IFF: "Equiv",
    Op.UNTIL: "U",
    Op.RELEASE: "R",
    Op.WEAK_UNTIL: "W",
    Op.STRONG_RELEASE: "M",
}


def equivalent(left: Formula, right: Formula) -> bool:
    """Whether the same infinite words satisfy both formulas.

    Raises FormulaTooLargeError beyond MAX_ATOMS, and SpotMissingError.
    """
    if left == right:
        return True
    vocabulary = Vocabulary.of(left, right)
    return bool(library().are_equivalent(vocabulary.encode(left), vocabulary.encode(right)))


def is_satisfiable(formula: Formula) -> bool:
    """Whether some infinite word satisfies the formula. Raises as `equivalent` does."""
    return not equivalent(formula, FALSE)


def is_valid(formula: Formula) -> bool:
    """Whether every infinite word satisfies the formula. Raises as `equivalent` does."""
    return equivalent(formula, TRUE)


def library() -> Any:
    """Spot's module. Raises SpotMissingError where it is not installed."""
    try:
        import spot
    except ImportError as error:
        raise SpotMissingError(
            "Spot is not installed, and automata and equivalence need it: on Linux x86-64 `pip install spottl`, "
            "elsewhere take it from Homebrew or conda"
        ) from error
    if not hasattr(spot, "translate"):
        raise SpotMissingError("the module `spot` found here is not the Spot library: install `spottl` instead")
    return spot
