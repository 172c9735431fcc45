"""The sample that is translated."""

from __future__ import annotations

from benchmarks.translate import commands, measure


def test_the_sample_is_the_same_each_time_and_of_every_set() -> None:
    first, again = commands(3), commands(3)
    for one, other in zip(first, again, strict=True):
        assert [command.text for command in one] == [command.text for command in other]
        assert [command.environment.name for command in one[::3]] == [
            "manipulation_seen",
            "manipulation_unseen",
            "navigation_seen",
            "navigation_unseen",
        ]


def test_what_is_timed_was_not_asked_before() -> None:
    first, timed = commands(20)
    assert {command.text for command in first}.isdisjoint(command.text for command in timed)
    asked = []
    found = measure(asked.append, first, timed)
    assert asked == [*first, *timed]
    assert 0 <= found["median_ms"] <= found["p95_ms"]
