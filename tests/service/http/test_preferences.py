"""`Prefer`, as RFC 7240 has it."""

from __future__ import annotations

import pytest

from service.http.preferences import Wait, wait_of


@pytest.mark.parametrize(
    ("prefer", "wait"),
    [
        ("", Wait(5.0, None)),
        ("wait=2", Wait(2.0, "wait=2")),
        ("Wait = 2", Wait(2.0, "wait=2")),
        ('wait="2"', Wait(2.0, "wait=2")),
        ("wait=0", Wait(0.0, "wait=0")),
        ("wait=1000", Wait(60.0, "wait=60")),
        ("respond-async", Wait(0.0, "respond-async")),
        ("respond-async, wait=10", Wait(10.0, "wait=10")),
        ("return=minimal; foo=1, wait=3; bar", Wait(3.0, "wait=3")),
        ("wait=3, wait=7", Wait(3.0, "wait=3")),
        ("wait", Wait(5.0, None)),
        ("wait=soon", Wait(5.0, None)),
        ("wait=-1", Wait(5.0, None)),
        ("wait=1e3", Wait(5.0, None)),
        ("wait=99999999999999999999", Wait(5.0, None)),
        (",;=,,", Wait(5.0, None)),
    ],
)
def test_preferences(prefer: str, wait: Wait) -> None:
    assert wait_of(prefer, default_s=5.0, longest_s=60.0) == wait
