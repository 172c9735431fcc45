"""Exact match of formulas: of all test commands, and apart of those that were also training commands."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any

from models.language.human.baseline import LinearBaseline
from models.language.human.environment import Environment
from models.language.human.lifting import lift
from models.language.human.splits import Split
from models.language.human.system import Plan, fit


@dataclass(frozen=True, slots=True)
class Outcome:
    """One test command: whether its very text was in the training set, and which systems got it right."""

    duplicate: bool
    right: bool
    baseline: bool


def measure(
    split: Split, environment: Environment, *, seed: int, plan: Plan, log: Callable[[str], None]
) -> list[Outcome]:
    """Train on one part of a split and test on the other."""
    lifted = [lift(command, environment) for command in split.training]
    sentences = [environment.sentence(command.text) for command in split.test]
    system = fit(lifted, environment, seed=seed, plan=plan, log=log)
    said = [next(iter(formulas), "") for formulas in system.formulas(sentences)]
    linear = LinearBaseline.fit(lifted, environment).formulas(sentences)
    seen = {command.text for command in split.training}
    return [
        Outcome(command.text in seen, one == command.formula, other == command.formula)
        for command, one, other in zip(split.test, said, linear, strict=True)
    ]


def summary(runs: Sequence[Sequence[Outcome]]) -> dict[str, Any]:
    """Rates of each run, and over all test commands those of duplicates and of the others."""
    every = [outcome for run in runs for outcome in run]
    return {
        "tested": [len(run) for run in runs],
        "right": [_right(run) for run in runs],
        "baseline": [_baseline(run) for run in runs],
        "duplicates": _part([outcome for outcome in every if outcome.duplicate]),
        "others": _part([outcome for outcome in every if not outcome.duplicate]),
    }


def _part(outcomes: Sequence[Outcome]) -> dict[str, Any]:
    if not outcomes:
        return {"tested": 0, "right": None, "baseline": None}
    return {"tested": len(outcomes), "right": _right(outcomes), "baseline": _baseline(outcomes)}


def _right(outcomes: Sequence[Outcome]) -> float:
    return sum(outcome.right for outcome in outcomes) / len(outcomes)


def _baseline(outcomes: Sequence[Outcome]) -> float:
    return sum(outcome.baseline for outcome in outcomes) / len(outcomes)
