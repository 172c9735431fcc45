"""How the published commands are parted into what is learned from and what is tested."""

from __future__ import annotations

import random
from collections.abc import Iterator, Sequence
from dataclasses import dataclass

from models.language.human.data import FOLDS, Command


@dataclass(frozen=True, slots=True)
class Split:
    """One training set and one test set."""

    name: str
    training: Sequence[Command]
    test: Sequence[Command]


def five_folds(commands: Sequence[Command]) -> Iterator[Split]:
    """The published folds: each is tested once by what is learned from the other four."""
    for fold in range(FOLDS):
        training = [command for command in commands if command.fold != fold]
        yield Split(f"fold {fold}", training, [command for command in commands if command.fold == fold])


def unseen_formulas(commands: Sequence[Command], seeds: Sequence[int]) -> Iterator[Split]:
    """For each seed, learn from the commands of a random half of the formulas and test on those of the others."""
    formulas = sorted({command.formula for command in commands})
    for seed in seeds:
        half = set(random.Random(f"unseen/{seed}").sample(formulas, len(formulas) // 2))
        training = [command for command in commands if command.formula in half]
        yield Split(f"seed {seed}", training, [command for command in commands if command.formula not in half])
