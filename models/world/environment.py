"""An environment, read, checked and compiled."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace
from functools import cached_property

from models.world.domain import Function
from models.world.grid import Grid
from models.world.oomdp import OomdpWorld
from models.world.situation import Situation
from models.world.vocabulary import Symbol, Vocabulary
from models.world.world import State, World


@dataclass(frozen=True, eq=False)
class Environment:
    """Read-only. What `load_environment` returns; every expression in it has been checked."""

    name: str
    kind: str
    domain: str | None  # the domain's name; None for an explicit environment
    vocabulary: Vocabulary
    world: World
    now: int | None = None
    """The state that phrases about where things are go by; None for the initial one. See `in_state`."""

    @property
    def functions(self) -> Mapping[str, Function]:
        """The propositional functions by name."""
        return self.vocabulary.functions

    @property
    def grid(self) -> Grid | None:
        """Where the cells are; None where they were not drawn as a map."""
        return self.world.model.grid if isinstance(self.world, OomdpWorld) else None

    @cached_property
    def situation(self) -> Situation:
        """How things stand now."""
        return Situation(self.vocabulary, self.world, self.world.initial if self.now is None else self.now)

    def in_state(self, state: State) -> Environment:
        """The environment with phrases going by another state; what that leaves out is as in the initial state.

        Raises StateError, with places in `state`.
        """
        return replace(self, now=self.world.encode(state))

    def symbols(self, *kinds: str) -> tuple[Symbol, ...]:
        """Objects, then attribute values, of the given kinds or all, in a fixed order."""
        return self.vocabulary.symbols(*kinds)


def compile_world(environment: Environment) -> World:
    """The world that planning works on. Loading has compiled it already, so this costs nothing."""
    return environment.world
