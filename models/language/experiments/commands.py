"""Sets of commands with what they ask for, and the environment that they are grounded in."""

from __future__ import annotations

import random
from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from functools import cache

from models.language.dataset import Domain, Example, Part, by_task, generate, grounding_environment
from models.logic import Formula, parse
from models.world import Environment, load_environment, resolve

AS_IS = "as it is"
"""How commands are said that nothing was done to."""


@dataclass(frozen=True, slots=True, eq=False)
class CommandSet:
    """Commands of one domain, each with its right formula, resolved in the environment of the set.

    Attributes:
        name: which set: "S", "U" or "W".
        expected: the formula of every example, in the same order.
        said: how the commands are said, if not as the set has them.
    """

    name: str
    domain: Domain
    environment: Environment
    examples: tuple[Example, ...]
    expected: tuple[Formula, ...]
    said: str = AS_IS

    @classmethod
    def of(cls, name: str, examples: Sequence[Example], environment: Environment, *, said: str = AS_IS) -> CommandSet:
        """The set of some examples of one domain; raises ValueError when there is none."""
        if not examples:
            raise ValueError("a set of commands has at least one")
        formulas = {ltl: resolve(parse(ltl), environment) for ltl in dict.fromkeys(e.ltl for e in examples)}
        expected = tuple(formulas[example.ltl] for example in examples)
        return cls(name, examples[0].domain, environment, tuple(examples), expected, said)

    @property
    def texts(self) -> tuple[str, ...]:
        """What is said."""
        return tuple(example.text for example in self.examples)

    def changed(self, said: str, change: Callable[[Example], Example]) -> CommandSet:
        """The set with every command said otherwise; what the commands mean must stay."""
        return replace(self, said=said, examples=tuple(map(change, self.examples)))

    def thinned(self, most: int | None) -> CommandSet:
        """At most so many commands of each task class, drawn at random but always the same; all for None."""
        if most is None:
            return self
        kept = {id(example) for group in by_task(self.examples).values() for example in _drawn(group, most)}
        pairs = [pair for pair in zip(self.examples, self.expected, strict=True) if id(pair[0]) in kept]
        examples, expected = zip(*pairs, strict=True)
        return replace(self, examples=examples, expected=expected)


@cache
def paper_sets(domain: Domain) -> tuple[CommandSet, CommandSet]:
    """S and U of a domain (paper, Table I), each with the environment of its vocabulary."""
    dataset = generate(domain)
    return (
        CommandSet.of("S", dataset.seen, load_environment(grounding_environment(domain, Part.SEEN))),
        CommandSet.of("U", dataset.unseen, load_environment(grounding_environment(domain, Part.UNSEEN))),
    )


def _drawn(group: Sequence[Example], most: int) -> list[Example]:
    return random.Random(group[0].task).sample(group, min(most, len(group)))
