"""Measurements of several seeds as plain data: spreads of rates, and failures by cause."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import asdict
from typing import Any

from models.language.experiments.causes import Cause
from models.language.experiments.measurement import Measurement
from models.language.experiments.spread import Spread

MEASURES = ("query", "ltl", "text", "structure")


def scores(measurements: Sequence[Measurement]) -> dict[str, Any]:
    """One measurement per seed: by group, "overall" and every task class, how many commands and each rate's spread."""
    groups = [measurement.groups for measurement in measurements]
    return {
        name: {
            "commands": score.total,
            **{measure: spread([group[name].rate(measure) for group in groups]) for measure in MEASURES},
        }
        for name, score in groups[0].items()
    }


def curves(runs: Sequence[Sequence[Measurement]]) -> dict[str, Any]:
    """One list per seed, of the measurements at every epoch: by group and measure, the spread at every epoch."""
    epochs = [scores(at_epoch) for at_epoch in zip(*runs, strict=True)]
    return {
        group: {measure: [epoch[group][measure] for epoch in epochs] for measure in MEASURES} for group in epochs[0]
    }


def spread(values: Sequence[float]) -> dict[str, float]:
    """The spread of one number per seed, as plain data."""
    return asdict(Spread.of(values))


def failures(measurements: Sequence[Measurement]) -> dict[str, Any]:
    """By task class and cause: the count of each seed, and the first seed's commands that failed for it."""
    found: dict[str, Any] = {}
    for task in measurements[0].scores:
        for cause in Cause:
            kinds = [measurement.failures[task].get(cause) for measurement in measurements]
            shown = next((kind.examples for kind in kinds if kind is not None), None)
            if shown is not None:
                found.setdefault(task, {})[str(cause)] = {
                    "count": [0 if kind is None else kind.count for kind in kinds],
                    "examples": [asdict(failure) for failure in shown],
                }
    return found
