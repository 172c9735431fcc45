from __future__ import annotations

import pytest
from hypothesis import given
from hypothesis import strategies as st

from models.language.contraries import _CONTRARIES, contrary
from models.language.tokens import words
from models.queries import parse_task


@pytest.mark.parametrize(
    ("text", "task", "taught", "expected"),
    [
        ("unlock the cup", "lock_away(cup)", "lock the cup away", ("unlock", "lock")),
        ("Please unlock the tea cup", "lock_away(tea cup)", "", ("unlock", "lock")),
        ("lock the cup", "unlock(cup)", "", ("lock", "unlock")),
        ("empty the bucket", "top_up(bucket)", "fill the bucket", ("empty", "fill")),
        ("shut the gate", "open(gate)", "the gate ought to be opened", ("shut", "open")),
        ("unload the van", "fill_van(van)", "loading the van", ("unload", "load")),
        ("disconnect the pump", "hook_up(pump)", "connect the pump", ("disconnect", "connect")),
        ("turn off the lamp", "light(lamp)", "turn on the lamp", ("off", "on")),
        ("turn the old lamp off", "light(old lamp)", "turn the lamp on", ("off", "on")),
        ("leave the kitchen", "navigate_one(kitchen)", "", ("leave", "navigate")),
        # what only looks like it
        ("lock the cup", "lock_away(cup)", "lock the cup away", None),
        ("take the cover off the bed", "uncover(bed)", "", None),  # a thing, not a verb
        ("do not unlock the cup", "lock_away(cup)", "", None),
        ("leave the cup in the kitchen", "navigate_one(kitchen)", "", None),  # the cup, not the kitchen
        ("the lamp that is off", "light(lamp)", "turn on the lamp", None),
        ("turn off the lamp", "toggle(lamp)", "turn on or off the lamp", None),  # taught with both
        ("polish the cup", "lock_away(cup)", "lock the cup away", None),
        ("unlock", "lock_away(cup)", "", None),
    ],
)
def test_what_undoes_a_task_is_its_contrary(
    text: str, task: str, taught: str, expected: tuple[str, str] | None
) -> None:
    assert contrary(words(text), parse_task(task), words(taught)) == expected


VERBS = sorted({verb for line in _CONTRARIES.strip().splitlines() for verb in line.split() if verb != "|"})


@given(st.sampled_from(VERBS), st.sampled_from(VERBS))
def test_what_is_contrary_is_so_both_ways(one: str, other: str) -> None:
    query = parse_task("do(cup)")
    found = contrary([one, "the", "cup"], query, [other])
    assert (found is None) == (contrary([other, "cup"], query, [one]) is None)
    assert found in (None, (one, other))
