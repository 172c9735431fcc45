"""Spreads over seeds, by hand."""

from __future__ import annotations

import pytest

from models.language.experiments.causes import Cause
from models.language.experiments.measurement import Failure, Failures, Measurement, Score
from models.language.experiments.spread import Spread
from models.language.experiments.summary import curves, failures, scores

FAILED = Failure("Grab the ball", "pickup(cube)", "pickup(ball)")


def _measurement(right: int, wrong: Cause | None = None, count: int = 0) -> Measurement:
    found = {} if wrong is None else {wrong: Failures(count, [FAILED])}
    score = Score(total=10, query=right, ltl=right, text=0, structure=10)
    return Measurement({"pickup": score, "ship": Score(total=10)}, {"pickup": found, "ship": {}}, ())


def test_spread() -> None:
    assert Spread.of([0.5, 0.7, 0.9]) == Spread(mean=0.7, deviation=0.2, low=0.5, high=0.9)
    assert Spread.of([1 / 3]) == Spread(mean=0.3333, deviation=0.0, low=0.3333, high=0.3333)


def test_scores() -> None:
    table = scores([_measurement(6), _measurement(8)])
    assert list(table) == ["overall", "pickup", "ship"]
    assert table["pickup"]["commands"] == 10
    assert table["pickup"]["ltl"] == {"mean": 0.7, "deviation": 0.1414, "low": 0.6, "high": 0.8}
    assert table["overall"]["ltl"]["mean"] == pytest.approx(0.35)
    assert table["pickup"]["structure"]["low"] == 1.0
    assert table["ship"]["query"]["high"] == 0.0


def test_curves_hold_one_spread_per_epoch() -> None:
    found = curves([[_measurement(1), _measurement(5)], [_measurement(3), _measurement(5)]])
    assert [spread["mean"] for spread in found["pickup"]["query"]] == [0.2, 0.5]
    assert [spread["low"] for spread in found["pickup"]["query"]] == [0.1, 0.5]
    assert [spread["mean"] for spread in found["overall"]["text"]] == [0.0, 0.0]


def test_failures_count_every_seed_and_show_the_first_that_has_them() -> None:
    found = failures(
        [_measurement(10), _measurement(7, Cause.WRONG_ARGUMENT, 3), _measurement(9, Cause.WRONG_CLASS, 1)]
    )
    assert found == {
        "pickup": {
            "wrong class": {"count": [0, 0, 1], "examples": [_as_data(FAILED)]},
            "wrong argument": {"count": [0, 3, 0], "examples": [_as_data(FAILED)]},
        }
    }


def _as_data(failure: Failure) -> dict[str, str]:
    return {"text": failure.text, "answer": failure.answer, "expected": failure.expected}
