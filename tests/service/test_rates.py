"""Token buckets against a count by hand."""

from __future__ import annotations

from hypothesis import given
from hypothesis import strategies as st

from service.rates import MOST_CLIENTS, TokenBuckets


class Clock:
    now = 100.0

    def __call__(self) -> float:
        return self.now


def test_a_burst_and_then_the_rate() -> None:
    clock = Clock()
    buckets = TokenBuckets(2.0, 3, clock=clock)
    assert [buckets.take("a") for _ in range(5)] == [0.0, 0.0, 0.0, 0.5, 0.5]
    clock.now += 0.25
    assert buckets.take("a") == 0.25
    clock.now += 0.25
    assert [buckets.take("a"), buckets.take("a")] == [0.0, 0.5]
    clock.now += 1_000
    assert [buckets.take("a") for _ in range(4)] == [0.0, 0.0, 0.0, 0.5]


def test_clients_do_not_share() -> None:
    buckets = TokenBuckets(1.0, 1, clock=Clock())
    assert [buckets.take(name) for name in "abab"] == [0.0, 0.0, 1.0, 1.0]


def test_only_so_many_are_kept() -> None:
    buckets = TokenBuckets(1.0, 1, clock=Clock())
    for number in range(MOST_CLIENTS + 1):
        buckets.take(str(number))
    assert buckets.take("1") > 0
    assert buckets.take("0") == 0, "the one that was used longest ago is forgotten"


@given(st.lists(st.floats(0, 3), max_size=60), st.floats(0.1, 10), st.integers(1, 10))
def test_never_more_than_the_burst_and_the_rate_and_waiting_as_told_helps(
    pauses: list[float], rate: float, burst: int
) -> None:
    clock = Clock()
    buckets = TokenBuckets(rate, burst, clock=clock)
    taken = 0
    for pause in pauses:
        clock.now += pause
        wait = buckets.take("a")
        taken += wait == 0
        assert taken <= burst + (clock.now - Clock.now) * rate + 1e-6
    wait = buckets.take("a")
    if wait:
        clock.now += wait + 1e-6
        assert buckets.take("a") == 0
