"""The promises about kills, writers and long runs, with fewer of each than `python -m benchmarks.reliability` has."""

from __future__ import annotations

from pathlib import Path

import pytest

from benchmarks.processes import Usage
from benchmarks.reliability import Soak, soak, survive, write_at_once


def test_what_was_acknowledged_survives_kills_at_random_moments(tmp_path: Path) -> None:
    found = survive(tmp_path, kills=20)
    assert (found.lost, found.refused, found.corrupt) == ([], [], [])
    assert found.good


@pytest.mark.long
def test_a_file_that_was_tampered_with_is_noticed(tmp_path: Path) -> None:
    assert not survive(tmp_path, kills=0).corrupt
    path = tmp_path / "cqltl.sqlite3"
    data = bytearray(path.read_bytes())
    data[4096 : 3 * 4096] = bytes(2 * 4096)
    path.write_bytes(data)
    from benchmarks.reliability import _problems

    assert _problems(tmp_path)


@pytest.mark.long
def test_eight_writers_on_two_services_are_all_answered(tmp_path: Path) -> None:
    assert write_at_once(tmp_path, writes=30) == []


@pytest.mark.long
def test_a_long_run_gathers_nothing(tmp_path: Path) -> None:
    found = soak(tmp_path, requests=500, jobs=25)
    assert found.after.descriptors <= found.before.descriptors + 2
    assert found.after.threads <= found.before.threads + 2


def test_a_soak_that_gathers_something_is_not_good() -> None:
    before = Usage(50, 20, 1_000_000)
    assert Soak(before, Usage(52, 22, 1_050_000)).good
    assert not Soak(before, Usage(53, 20, 1_000_000)).good
    assert not Soak(before, Usage(50, 23, 1_000_000)).good
    assert not Soak(before, Usage(50, 20, 1_060_000)).good
