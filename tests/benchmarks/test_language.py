"""The benchmark of understanding counts what is right, and takes for the same what an environment cannot tell apart."""

from __future__ import annotations

import pytest

from benchmarks.language import PARTS, Bench, read, same
from models.logic import parse
from models.queries import resolve_grounded


@pytest.fixture(scope="module")
def bench() -> Bench:
    return Bench.load()


def test_formulas_are_the_same_up_to_what_the_environment_tells_apart(bench: Bench) -> None:
    toys = bench.environments["toys"]
    at, near, far, moved = (
        resolve_grounded(parse(text), toys)
        for text in ("F at(robot, kitchen)", "F near(robot, kitchen)", "F at(robot, bedroom)", "F at(box, kitchen)")
    )
    assert same(at, near, toys)
    assert not same(at, far, toys)
    assert not same(at, moved, toys)


def test_commands_are_counted_by_kind(bench: Bench) -> None:
    items = [
        {"environment": "toys", "kind": ["then"], "text": "pick up the ball", "ltl": "F holding(sphere)"},
        {"environment": "toys", "kind": ["then"], "text": "pick up the ball", "ltl": "F holding(cylinder)"},
        {"environment": "toys", "text": "qwertz asdf", "ltl": "F holding(cylinder)"},
    ]
    seconds: list[float] = []
    counts = bench.commands(items, seconds)
    assert (counts["then"].right, counts["then"].wrong, counts["plain"].unknown) == (1, 1, 1)
    assert len(seconds) == 3
    assert bench.refusals(["pick up the ball", "qwertz asdf"]).failures == ["pick up the ball"]


def test_the_halves_share_no_text() -> None:
    for name in ("compositions", "valid"):
        one, other = ({item["text"].lower() for item in read(name, part)} for part in PARTS)
        assert len(one) >= 100
        assert not one & other
    refused, held = (set(read("refusals", part)) for part in PARTS)
    assert len(refused) >= 100
    assert not refused & held
