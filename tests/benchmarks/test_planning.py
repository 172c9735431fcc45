"""What is planned, what it is given as, and how results are compared; the measuring needs solvers and minutes."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

from benchmarks.planning.cases import CASES, LARGE, TITLES, Random, Toys, case_of, routes
from benchmarks.planning.measuring import failure, summary
from benchmarks.planning.random_mdp import listed_world, random_mdp
from benchmarks.planning.report import agree, mismatches, seconds, tables
from benchmarks.planning.run import prepares
from benchmarks.planning.toys import prism_text
from models.logic import parse
from models.planning import plan


@pytest.mark.parametrize("case", [*CASES, LARGE], ids=str)
def test_a_case_is_read_back_and_its_routes_are_known(case: Toys | Random) -> None:
    assert case_of(str(case)) == case
    assert type(case.small) is type(case)
    assert set(routes(case, gpu=True)) <= prepares().keys() == TITLES.keys()
    assert "ours-gpu" not in set(routes(case, gpu=False))


def test_a_case_of_no_kind() -> None:
    with pytest.raises(ValueError, match="neither"):
        case_of("sail-4x1-1")


def test_the_model_for_storm_has_a_goal() -> None:
    text = prism_text(Toys("ship", 4, 1, 1))
    assert 'label "goal" = (cylinder_in = box) & (box_in = bedroom);\n' in text.model
    assert text.model.count("module world") == 1
    assert text.ltl == 'Pmax=? [ (F ("in_cylinder_box" & (F ("in_cylinder_box" & "at_box_bedroom")))) ]'
    assert "goal" not in prism_text(Toys("then", 4, 1, 1)).model


def test_a_random_mdp_is_one() -> None:
    mdp = random_mdp(1000)
    counts = np.diff(mdp.first_choice)
    assert np.unique(counts).tolist() == [1, 2, 3, 4]
    assert len(mdp.successor) == pytest.approx(10_000, rel=0.05)
    choice = np.repeat(np.arange(len(mdp.action)), np.diff(mdp.first_outcome))
    np.testing.assert_allclose(np.bincount(choice, weights=mdp.probability), 1)
    assert (np.diff(choice * 1000 + mdp.successor) > 0).all()  # in order, none twice
    np.testing.assert_array_equal(random_mdp(1000).probability, mdp.probability)


def test_the_goal_of_a_random_mdp_is_possible_and_not_sure() -> None:
    assert 0.5 < plan(listed_world(random_mdp(1000)), parse("F goal")).lower < 0.99


@pytest.mark.parametrize(
    ("left", "right", "same"),
    [((5, 5), (5.00001, 5.00001), True), ((5, 5), (5.001, 5.001), False), ((4, 6), (5.5, 9), True)],
)
def test_values_agree_within_bounds_and_tolerance(left: Any, right: Any, same: bool) -> None:
    assert agree(left, right) is agree(right, left) is same


def run(route: str, taken: float, steps: float) -> dict[str, Any]:
    found = {"seconds": {"plan": taken}, "values": {"steps": [steps, steps]}, "notes": {"product_states": 240}}
    return summary("ship-4x1-1", route, [{**found, "bytes": 2**20}], "done")


def test_values_that_differ_are_named() -> None:
    results = [run("ours", 0.5, 7), run("storm-ltl", 1, 7), run("mdpsolver", 1, 8), summary("c", "ours", [], "refused")]
    assert mismatches(results[:2]) == []
    assert [line.split(":")[0] for line in mismatches(results)] == ["ship-4x1-1, steps"] * 2


def test_tables_have_the_ratio_and_the_reason_where_there_is_none() -> None:
    lines = list(
        tables([run("ours", 0.5, 7), run("storm-ltl", 1.5, 7), summary("ship-4x1-1", "mdpsolver", [], "over")])
    )
    assert "| ship-4x1-1 | 240 | 500 ms | 1.5 s (3×) | over |" in lines
    assert "| ship-4x1-1 | 240 | plan 500 ms | plan 1.5 s | over |" in lines
    assert "| ship-4x1-1 | 240 | 1.0 MiB | 1.0 MiB | over |" in lines


def test_runs_that_were_done_count_however_the_process_ended() -> None:
    assert run("ours", 0.5, 7)["status"] == "done"
    assert summary("c", "ours", [], "over 9 s")["status"] == "over 9 s"


@pytest.mark.parametrize(
    ("status", "errors", "expected"),
    [
        (-9, "", "killed by SIGKILL"),
        (-6, "terminate called after throwing an instance of 'std::bad_alloc'", "out of memory"),
        (1, "models.planning.errors.ModelTooLargeError: no", "refused"),
        (1, "Traceback\nValueError: no", "failed: ValueError: no"),
        (3, "", "failed: status 3"),
    ],
)
def test_why_a_process_ended(status: int, errors: str, expected: str) -> None:
    assert failure(status, errors) == expected


@pytest.mark.parametrize(
    ("value", "expected"), [(0.00123456, "1.23 ms"), (0.5, "500 ms"), (12.345, "12.3 s"), (1234.5, "1,234 s")]
)
def test_seconds_have_three_digits(value: float, expected: str) -> None:
    assert seconds(value) == expected
