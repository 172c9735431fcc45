"""An environment of an OO-MDP domain with every name resolved, ready to be compiled."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

from models.world.domain import Domain
from models.world.grid import Grid
from models.world.vocabulary import Symbol


@dataclass(frozen=True, slots=True)
class StateAttribute:
    """A state variable: an attribute of an object and the values it ranges over (None is `none`)."""

    owner: Symbol
    attribute: str
    values: tuple[Symbol | None, ...]


@dataclass(frozen=True, slots=True, eq=False)
class Model:
    """Domain and environment together."""

    name: str
    domain: Domain
    parameters: Mapping[str, float]
    symbols: tuple[Symbol, ...]  # objects, then attribute values
    objects: Mapping[str, Symbol]
    static: Mapping[Symbol, Mapping[str, Symbol]]
    variables: tuple[StateAttribute, ...]
    initial: tuple[int, ...]  # a digit for each variable
    grid: Grid | None = None  # where the cells are, if they were drawn as a map
