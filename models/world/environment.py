"""An environment, read, checked and compiled."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

from models.world.domain import Function
from models.world.vocabulary import Symbol, Vocabulary
from models.world.world import World


@dataclass(frozen=True, slots=True, eq=False)
class Environment:
    """Read-only. What `load_environment` returns; every expression in it has been checked."""

    name: str
    kind: str
    domain: str | None  # the domain's name; None for an explicit environment
    vocabulary: Vocabulary
    world: World

    @property
    def functions(self) -> Mapping[str, Function]:
        """The propositional functions by name."""
        return self.vocabulary.functions

    def symbols(self, *kinds: str) -> tuple[Symbol, ...]:
        """Objects, then attribute values, of the given kinds or all, in a fixed order."""
        return self.vocabulary.symbols(*kinds)


def compile_world(environment: Environment) -> World:
    """The world that planning works on. Loading has compiled it already, so this costs nothing."""
    return environment.world
