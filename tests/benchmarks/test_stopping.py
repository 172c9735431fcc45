"""Moments at which plans are stopped, and that they stop within a second, with fewer than the benchmark has."""

from __future__ import annotations

import pytest

from benchmarks.stopping import MOST_S, PLANS, main, orders, report


def test_moments_are_spread_over_the_seconds_of_each_plan() -> None:
    times = 5
    found = list(orders(times, seed=0))
    assert len(found) == times * len(PLANS)
    for number, (body, seconds) in enumerate(PLANS.values()):
        part = found[number * times : (number + 1) * times]
        assert [which for which, _ in part] == [body] * times
        assert [int(moment * times / seconds) for _, moment in part] == list(range(times))


def test_a_plan_that_stops_late_is_reported(capsys: pytest.CaptureFixture[str]) -> None:
    assert report("cancelled", {"graph": [0.1, MOST_S]})
    assert not report("cancelled", {"graph": [0.1], "probability": [0.2, 1.5, 0.1]})
    assert "cancelled, probability: 3 times, median 0.20 s, longest 1.50 s" in capsys.readouterr().out


@pytest.mark.long
def test_plans_stop_within_a_second() -> None:
    with pytest.raises(SystemExit) as ended:
        main(["--times", "2"])
    assert ended.value.code == 0
