"""Results of an evaluation, small enough to know every number."""

from __future__ import annotations

from typing import Any

import pytest

from models.language.experiments.commands import AS_IS
from models.language.experiments.default import WITH, WITHOUT
from models.language.experiments.paper_systems import CQ, LTL, NAMES, POS
from models.language.experiments.summary import MEASURES
from models.language.experiments.variants import WAYS

TASKS = {
    "manipulation": ("move_to", "pickup", "pickup_colored", "ship"),
    "navigation": ("navigate_one", "navigate_two", "navigate_three"),
}
RATES = {CQ: 0.75, POS: 0.5, LTL: 0.25}


def _spread(mean: float) -> dict[str, float]:
    return {"mean": mean, "deviation": 0.1, "low": round(mean - 0.125, 4), "high": round(mean + 0.125, 4)}


def _groups(domain: str, mean: float) -> dict[str, Any]:
    return {
        group: {"commands": 40, **{measure: _spread(mean) for measure in MEASURES}}
        for group in ("overall", *TASKS[domain])
    }


def _curves(domain: str, mean: float) -> dict[str, Any]:
    rising = [_spread(mean * share) for share in (0.0, 0.5, 1.0)]
    return {group: dict.fromkeys(MEASURES, rising) for group in ("overall", *TASKS[domain])}


def _failures(domain: str) -> dict[str, Any]:
    shown = [{"text": "Take the ball", "answer": "pickup(cube)", "expected": "pickup(ball)"}]
    return {TASKS[domain][0]: {"wrong argument": {"count": [1, 2], "examples": shown}}}


def _paper(domain: str) -> dict[str, Any]:
    lesson = {"templates": ["F holding($1)"], "accurate": [7, 8]}
    return {
        "epochs": [1, 7, 60],
        "seeds": [0, 1],
        "curves": {name: {part: _curves(domain, RATES[name]) for part in "SU"} for name in NAMES},
        "final": {name: {part: _groups(domain, RATES[name]) for part in "SU"} for name in NAMES},
        "failures": {name: {part: _failures(domain) for part in "SU"} for name in NAMES},
        "lessons": {CQ: {TASKS[domain][0]: lesson}, POS: {}},
    }


def _default() -> dict[str, Any]:
    sets = {AS_IS: "SUW"} | dict.fromkeys(WAYS, "SU")
    row = {"low": 0.9333, "high": 1.0, "count": 9, "confidence": 0.98, "accuracy": 1.0}
    error = {"mean": 0.02, "deviation": 0.0, "low": 0.01, "high": 0.03}
    entry = {"answers": [9, 9], "error": error, "reliability": [row]}
    return {
        "seeds": [0, 1],
        "accuracy": {
            said: {part: {d: {WITH: _groups(d, 0.875), WITHOUT: _groups(d, 0.625)} for d in TASKS} for part in parts}
            for said, parts in sets.items()
        },
        "failures": {
            said: {part: {"manipulation": _failures("manipulation"), "navigation": {}} for part in parts}
            for said, parts in sets.items()
        },
        "changed": {"S": [0, 0], "U": [0, 1]},
        "refusals": {"texts": [50, 50], "refused": [49, 50], "accepted": [{"text": "Open it", "answer": "pickup(it)"}]},
        "calibration": {choice: dict.fromkeys("SUW", entry) for choice in (WITH, WITHOUT)},
    }


@pytest.fixture
def results() -> dict[str, Any]:
    """Both parts, as `results.json` has them."""
    return {"paper": {domain: _paper(domain) for domain in TASKS}, "default": _default()}
