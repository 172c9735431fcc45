"""A domain, read and checked: the values that the stages after loading work with."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

from models.world.degrees import Scale
from models.world.expression import Expression


@dataclass(frozen=True, slots=True)
class FunctionParameter:
    """A parameter of a propositional function, and the kinds of symbols it takes."""

    name: str
    kinds: frozenset[str]


@dataclass(frozen=True, slots=True)
class Function:
    """A propositional function: how it is called, read aloud and displayed."""

    name: str
    parameters: tuple[FunctionParameter, ...]
    says: str
    denies: str
    display: tuple[str, ...]


@dataclass(frozen=True, slots=True)
class Argument:
    """`x: box | toy`; kinds in the order written."""

    name: str
    kinds: tuple[str, ...]


@dataclass(frozen=True, slots=True)
class Definition:
    """A named expression; every propositional function is one too."""

    name: str
    arguments: tuple[Argument, ...]
    body: Expression


@dataclass(frozen=True, slots=True)
class Parameter:
    """A number that an environment may set."""

    default: float
    minimum: float
    maximum: float


@dataclass(frozen=True, slots=True)
class ObjectClass:
    """A class: attribute name to kinds, and the nouns for its objects."""

    name: str
    static: Mapping[str, tuple[str, ...]]
    state: Mapping[str, tuple[str, ...]]
    words: tuple[str, ...]

    def kinds(self, attribute: str) -> tuple[str, ...] | None:
        """The kinds of an attribute, or None for one that the class does not have."""
        return self.static.get(attribute, self.state.get(attribute))


@dataclass(frozen=True, slots=True)
class Effect:
    """`owner.attribute` becomes `value`."""

    owner: str
    attribute: str
    value: Expression
    target: str  # owner and attribute as written


@dataclass(frozen=True, slots=True)
class Outcome:
    """Effects that happen together with a probability."""

    probability: Expression
    effects: tuple[Effect, ...]


@dataclass(frozen=True, slots=True)
class Action:
    """An action with arguments."""

    name: str
    arguments: tuple[Argument, ...]
    guard: Expression
    cost: Expression  # of parameters only
    outcomes: tuple[Outcome, ...]


@dataclass(frozen=True, slots=True)
class Domain:
    """A checked domain: every expression in it is well typed."""

    name: str
    parameters: Mapping[str, Parameter]
    attributes: Mapping[str, tuple[str, ...]]
    classes: Mapping[str, ObjectClass]
    constants: Mapping[str, str]
    definitions: Mapping[str, Definition]
    functions: Mapping[str, Function]
    actions: tuple[Action, ...]
    constraints: tuple[Expression, ...]
    texts: tuple[str, ...]  # the constraints as written
    scales: Mapping[str, Scale]  # of the attribute types whose values are ordered
