"""What the world refuses.

CqltlError
├── WorldError               the data of an environment or domain is wrong; `places` point into the data
├── StateError               a state names something the world does not have, or breaks a constraint
├── UnknownPropositionError  a formula uses a propositional function that the environment does not have
├── UnknownObjectError       a formula names an object or value the environment does not have
└── TypeMismatchError        a formula gives a propositional function an argument of the wrong kind
"""

from __future__ import annotations

from models.errors import CqltlError


class WorldError(CqltlError):
    """The data of an environment is not a well-formed world."""

    slug = "invalid-environment"


class StateError(CqltlError):
    """A state is not a state of the world."""

    slug = "invalid-state"


class UnknownPropositionError(CqltlError):
    """No propositional function reads like this atom."""

    slug = "unknown-proposition"


class UnknownObjectError(CqltlError):
    """No object or attribute value has this name."""

    slug = "unknown-object"


class TypeMismatchError(CqltlError):
    """The argument exists and is of a kind the propositional function does not take."""

    slug = "type-mismatch"
