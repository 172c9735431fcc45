"""The evaluation on human commands, as plain data."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from dataclasses import asdict, dataclass, field
from pathlib import Path
from typing import Any

from models.language.human.data import Command, read_commands, read_few, read_utterances
from models.language.human.environment import DATASETS, environment
from models.language.human.lang2ltl import (
    UtteranceSplit,
    formula_holdout,
    measure_utterances,
    summary_of_utterances,
    utterance_holdout,
)
from models.language.human.measurement import measure, summary
from models.language.human.splits import Split, five_folds, unseen_formulas
from models.language.human.system import Plan

PARTS = (*DATASETS, "lang2ltl")
SETTINGS = {"drone": ("folds", "few", "unseen"), "cleanup": ("folds", "few", "unseen"), "pick": ("folds", "few")}
"""What is measured; Pick has five formulas of one template, too few to leave half of them out."""


@dataclass(frozen=True, slots=True)
class Extent:
    """How much is measured.

    Attributes:
        splits: at most so many of each setting, all if None.
        tested: at most so many test commands of a split, all if None.
    """

    seeds: Sequence[int] = (0, 1, 2, 3, 4)
    plan: Plan = field(default_factory=Plan)
    splits: int | None = None
    tested: int | None = None


def commands_part(folder: Path, name: str, extent: Extent, log: Callable[[str], None]) -> dict[str, Any]:
    """Every setting of one of `DATASETS`."""
    commands = read_commands(folder, name)
    found: dict[str, Any] = {}
    for setting in SETTINGS[name]:
        runs = []
        for number, split in enumerate(_splits(folder, name, setting, commands, extent)):
            say = _prefixed(log, f"{name} {setting} {split.name}")
            runs.append(measure(split, environment(name), seed=100 * number, plan=extent.plan, log=say))
            log(f"{name} {setting} {split.name}: {100 * summary(runs[-1:])['right'][0]:.2f}")
        found[setting] = summary(runs)
    return found


def utterances_part(
    folder: Path, extent: Extent, log: Callable[[str], None], keep: Callable[[dict[str, Any]], None]
) -> dict[str, Any]:
    """Both hold-outs of Lang2LTL; a run is a seed, with all parts of it. After each, `keep` is given what there is."""
    utterances = read_utterances(folder)
    found: dict[str, Any] = {}
    for setting, holdout in (("utterances", utterance_holdout), ("formulas", formula_holdout)):
        runs = []
        for seed in extent.seeds:
            outcomes = []
            for number, split in enumerate(list(holdout(utterances, seed))[: extent.splits]):
                say = _prefixed(log, f"lang2ltl {setting} seed {seed} part {number}")
                part = UtteranceSplit(split.training, split.test[: extent.tested])
                outcomes += measure_utterances(part, seed=100 * seed + 10 * number, plan=extent.plan, log=say)
            runs.append(outcomes)
            found[setting] = summary_of_utterances(runs)
            keep(found)
            log(f"lang2ltl {setting} seed {seed}: {100 * found[setting]['right'][-1]:.2f}")
    return found


def record(extent: Extent) -> dict[str, Any]:
    """What the results depend on."""
    plan = extent.plan
    return {
        "seeds": list(extent.seeds),
        "starts": list(plan.starts),
        "drawn": plan.drawn,
        "settings": asdict(plan.settings),
    }


def _splits(folder: Path, name: str, setting: str, commands: Sequence[Command], extent: Extent) -> Iterable[Split]:
    if setting == "few":
        splits = [Split("few", read_few(folder, name), commands)]
    else:
        splits = list(five_folds(commands) if setting == "folds" else unseen_formulas(commands, extent.seeds))
    for split in splits[: extent.splits]:
        yield Split(split.name, split.training, split.test[: extent.tested])


def _prefixed(log: Callable[[str], None], prefix: str) -> Callable[[str], None]:
    return lambda message: log(f"{prefix}, {message}")
