"""Where a formula stands in the hierarchy of Manna and Pnueli ("A hierarchy of temporal properties", PODC 1990)."""

from __future__ import annotations

from enum import StrEnum

from models.logic.formula import Formula
from models.logic.spot import Vocabulary, is_satisfiable, is_valid, library


class PropertyClass(StrEnum):
    """The least class of the hierarchy that a formula's language is in; what never or always holds is apart."""

    NEVER = "never"
    ALWAYS = "always"
    BOUNDED = "bounded"
    GUARANTEE = "guarantee"
    SAFETY = "safety"
    OBLIGATION = "obligation"
    RECURRENCE = "recurrence"
    PERSISTENCE = "persistence"
    REACTIVITY = "reactivity"

    @property
    def plain(self) -> str:
        """The class in plain words."""
        return _PLAIN[self]


_PLAIN = {
    PropertyClass.NEVER: "cannot be done at all",
    PropertyClass.ALWAYS: "asks for nothing",
    PropertyClass.BOUNDED: "is decided after a fixed number of steps",
    PropertyClass.GUARANTEE: "can be finished: once it is done, nothing that follows undoes it",
    PropertyClass.SAFETY: "must be kept up: once it is broken, nothing that follows mends it",
    PropertyClass.OBLIGATION: "combines what can be finished with what must be kept for ever",
    PropertyClass.RECURRENCE: "depends on what is done again and again, for ever",
    PropertyClass.PERSISTENCE: "depends on what is kept for ever from some time on",
    PropertyClass.REACTIVITY: "depends on what is done again and again and on what is kept from some time on",
}

_LETTERS = {
    "B": PropertyClass.BOUNDED,
    "G": PropertyClass.GUARANTEE,
    "S": PropertyClass.SAFETY,
    "O": PropertyClass.OBLIGATION,
    "R": PropertyClass.RECURRENCE,
    "P": PropertyClass.PERSISTENCE,
    "T": PropertyClass.REACTIVITY,
}
"""What Spot calls them."""


def classify(formula: Formula) -> PropertyClass:
    """The class of a formula, decided on its meaning and not on how it is written.

    Exponential in the formula, like every translation to automata. Raises FormulaTooLargeError and SpotMissingError.
    """
    if not is_satisfiable(formula):
        return PropertyClass.NEVER
    if is_valid(formula):
        return PropertyClass.ALWAYS
    return _LETTERS[library().mp_class(Vocabulary.of(formula).encode(formula))]
