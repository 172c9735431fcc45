"""The sample that is translated."""

from __future__ import annotations

from benchmarks.translate import commands, measure


def test_the_sample_is_the_same_each_time_and_of_every_set() -> None:
    first, again = commands(3), commands(3)
    assert [command.text for command in first] == [command.text for command in again]
    assert [command.environment.name for command in first[::3]] == [
        "manipulation_seen",
        "manipulation_unseen",
        "navigation_seen",
        "navigation_unseen",
    ]


def test_a_measurement_has_a_round_that_does_not_count() -> None:
    sample = commands(1)
    asked = []
    found = measure(asked.append, sample)
    assert asked == [*sample, *sample]
    assert 0 <= found["median_ms"] <= found["p95_ms"]
