"""The benchmark of slow clients: what it calls broken."""

from __future__ import annotations

from benchmarks.slow_clients import broken


def test_what_is_not_as_promised_is_told() -> None:
    quick = [5.0] * 200
    assert broken({"idle": [1.0, 9.9]}, {"livez": quick}) == []
    assert broken({"idle": [1.0, 10.5]}, {"livez": quick}) == ["idle: open for 10.5 s"]
    assert broken({"idle": [1.0]}, {"livez": [*quick, *[150.0] * 10]}) == ["livez: p99 of 150 ms"]
