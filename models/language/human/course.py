"""What the default translator's networks are taught for an evaluation: lifted commands, as they are and renamed."""

from __future__ import annotations

import random
from collections import Counter
from collections.abc import Sequence
from dataclasses import dataclass

from models.language.human.environment import Environment, Sentence
from models.language.human.lifting import Lifted, arity
from models.language.human.own import OwnCommands
from models.language.spans.items import Item

CHECKED = 0.05
"""Part of the training commands that is only looked at, for the temperature."""
LEAST = 4
"""Templates with fewer commands are not taught: most are slips of the labels."""
OWN = 0.2
"""Commands of this repository, to each of the training set."""
RENAMED = 0.5
"""Part of the commands that are drawn with their things renamed in order."""


@dataclass(frozen=True, slots=True)
class HumanCourse:
    """Training commands of one split.

    Attributes:
        checked: those that are only looked at.
        own: what the translator can say of the templates itself.
        known: words that get embeddings besides those of the commands.
        drawn: commands in an epoch.
    """

    commands: Sequence[Lifted]
    checked: Sequence[Lifted]
    environment: Environment
    own: OwnCommands
    known: frozenset[str] = frozenset()
    drawn: int = 1500

    @classmethod
    def of(
        cls,
        commands: Sequence[Lifted],
        environment: Environment,
        *,
        seed: int,
        known: Sequence[str] = (),
        drawn: int = 1500,
    ) -> HumanCourse:
        """Part the commands; the same seed parts them alike."""
        counts = Counter(command.template for command in commands)
        least = min(LEAST, max(counts.values()))
        kept = [command for command in commands if counts[command.template] >= least]
        shuffled = random.Random(f"human/{seed}").sample(kept, len(kept))
        held = max(1, round(CHECKED * len(kept)))
        taught = {command.template for command in shuffled[held:]}
        checked = [command for command in shuffled[:held] if command.template in taught]
        own = OwnCommands.of((command.template for command in kept), environment)
        return cls(shuffled[held:], checked, environment, own, frozenset(known), drawn)

    @property
    def tasks(self) -> tuple[tuple[str, int], ...]:
        """The templates with their numbers of holes."""
        templates = {one.template for one in self.commands} | set(self.own.ways)
        return tuple((template, arity(template)) for template in sorted(templates))

    @property
    def words(self) -> tuple[str, ...]:
        """The words that were said more than once, and those that are known anyway.

        Names are among them: what is read is renamed half of the time, so that they are not learned by heart, and the
        rest may say what is meant ("the yellow, green and blue blocks", where the only others are red).
        """
        counts = Counter(word for command in self.commands for word in command.sentence.words)
        counts.update(word for command in self.commands for word in self._renamed(command).words)
        return tuple(sorted({word for word, count in counts.items() if count > 1} | self.known))

    def epoch(self, generator: random.Random) -> list[Item]:
        """`drawn` commands, each as often as the others, and a part of that which the translator knew before."""
        drawn = generator.choices(self.commands, k=self.drawn)
        drawn += self.own.draw(round(OWN * self.drawn), generator)
        return [self._item(command, generator) for command in drawn]

    def checks(self, generator: random.Random) -> list[Item]:
        """Those that are only looked at."""
        return [self._item(command, generator) for command in self.checked]

    def _item(self, command: Lifted, generator: random.Random) -> Item:
        return command.item(self._renamed(command) if generator.random() < RENAMED else command.sentence)

    def _renamed(self, command: Lifted) -> Sentence:
        return self.environment.in_order(command.sentence)
