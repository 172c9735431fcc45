"""The same plan for any number of threads, level by level or group by group."""

from __future__ import annotations

import importlib
import os

import pytest

from models.logic import parse
from models.planning import Options, Plan, plan, to_bytes
from models.planning.dense.team import Team
from models.world import compile_world, load_environment, toys_spec

TASK = "F (in(cylinder, box) & F at(box, bedroom))"


def planned(monkeypatch: pytest.MonkeyPatch, *, threads: int, levels: bool) -> Plan:
    schedule = importlib.import_module("models.planning.dense.schedule")
    team = importlib.import_module("models.planning.dense.team")
    monkeypatch.setattr(team, "TOGETHER_FROM", 0)
    monkeypatch.setattr(os, "sched_getaffinity", lambda _: set(range(threads)), raising=False)
    monkeypatch.setattr(schedule, "FEW", 0 if levels else 10**6)
    world = compile_world(load_environment(toys_spec(columns=3, rows=2, toys=2, slip=0.1)))
    return plan(world, parse(TASK), options=Options(relevance=False))


def test_any_number_of_threads_gives_the_same_bytes(monkeypatch: pytest.MonkeyPatch) -> None:
    plans = [planned(monkeypatch, threads=threads, levels=levels) for threads in (1, 2, 5) for levels in (True, False)]
    policies = [to_bytes(found.policy) for found in plans if found.policy is not None]
    assert len(policies) == 6
    assert len(set(policies)) == 1
    assert len({(found.expected_steps, found.expected_steps_upper) for found in plans}) == 1


def test_a_range_is_shared_without_gaps(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(os, "sched_getaffinity", lambda _: set(range(4)), raising=False)
    with Team(10**9) as team:
        for count in (1, 3, 4, 5, 17):
            parts = team.share(lambda first, last: (first, last), 0, count)
            assert [place for first, last in parts for place in range(first, last)] == list(range(count))
