"""`POST /policies/{id}/simulate`."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import httpx
import pytest

from benchmarks.server import serving
from tests.service.conftest import check_problem, plan

COIN: dict[str, Any] = {
    "name": "coin",
    "kind": "explicit",
    "states": 4,
    "initial": 0,
    "labels": {"won": [2], "broken": [3]},
    "transitions": [
        {"from": 0, "action": "on", "to": [[1, 1.0]]},
        {"from": 1, "action": "throw", "to": [[2, 0.5], [0, 0.25], [3, 0.25]]},
        {"from": 2, "action": "stay", "to": [[2, 1.0]]},
        {"from": 3, "action": "stay", "to": [[3, 1.0]]},
    ],
}
"""Every second step a throw: won with 1/2, lost with 1/4, else once more."""


def simulate(client: httpx.Client, url: str, **body: Any) -> dict[str, Any]:
    response = client.post(f"{url}/simulate", json=body)
    assert response.status_code == 200, response.text
    answer: dict[str, Any] = response.json()
    return answer


def test_runs_end_as_often_as_they_should(client: httpx.Client) -> None:
    answer = plan(client, ltl="F won", environment_spec=COIN)
    found = simulate(client, answer["policy"]["url"], runs=20_000)
    assert (found["runs"], found["seed"], found["undecided"]) == (20_000, 0, 0)
    assert found["satisfied"] + found["lost"] == 20_000
    assert found["success_rate"] == found["satisfied"] / 20_000
    assert found["success_rate"] == pytest.approx(answer["probability"]["lower"], abs=0.02)
    assert found["mean_steps"] == pytest.approx(answer["expected_steps"], abs=0.05)
    histogram = found["steps"]["histogram"]
    assert [steps for steps, _ in histogram] == sorted({steps for steps, _ in histogram})
    assert {steps % 2 for steps, _ in histogram} == {0}
    assert sum(count for _, count in histogram) == 20_000
    assert sum(steps * count for steps, count in histogram) / 20_000 == pytest.approx(found["mean_steps"])


def test_the_seed_decides(client: httpx.Client) -> None:
    url = plan(client, ltl="F won", environment_spec=COIN)["policy"]["url"]
    assert simulate(client, url, seed=5) == simulate(client, url, seed=5)
    assert simulate(client, url, seed=5)["steps"] != simulate(client, url, seed=6)["steps"]


def test_runs_are_cut_off_and_begin_where_they_are_told(client: httpx.Client) -> None:
    url = plan(client, ltl="F won", environment_spec=COIN)["policy"]["url"]
    cut = simulate(client, url, runs=10, max_steps=1)
    assert (cut["undecided"], cut["steps"]["histogram"]) == (10, [[1, 10]])
    later = simulate(client, url, runs=1_000, state={"mdp": {"state": "1"}})
    assert {steps % 2 for steps, _ in later["steps"]["histogram"]} == {1}
    won = simulate(client, url, runs=3, state={"mdp": {"state": "2"}})
    assert (won["satisfied"], won["steps"]["histogram"]) == (3, [[0, 3]])


def test_what_is_left_out_of_a_state_is_as_where_the_plan_began(client: httpx.Client) -> None:
    held = {"sphere": {"in": "robot"}}
    url = plan(client, ltl="F holding(sphere)", environment="toys-4x1-sphere", state=held)["policy"]["url"]
    found = simulate(client, url, runs=1, state={"robot": {"at": "bedroom"}})
    assert found["steps"]["histogram"] == [[0, 1]]


def test_what_has_to_be_kept_up_counts_as_satisfied(client: httpx.Client) -> None:
    patrol = "G F at(robot, kitchen) & G F at(robot, bathroom)"
    url = plan(client, ltl=patrol, environment="toys-4x1-sphere")["policy"]["url"]
    assert simulate(client, url, runs=7)["satisfied"] == 7


def test_the_world_is_the_one_that_was_planned_in(client: httpx.Client) -> None:
    """Whatever is called so by now: another world, or nothing."""
    world = {**COIN, "name": "changing"}
    assert client.post("/environments", json=world).status_code == 201
    url = plan(client, ltl="F won", environment="changing")["policy"]["url"]
    before = simulate(client, url)
    sure = {"from": 1, "action": "throw", "to": [[2, 1.0]]}
    changed = {**world, "transitions": [sure if part["from"] == 1 else part for part in world["transitions"]]}
    assert client.put("/environments/changing", json=changed).status_code == 200
    assert simulate(client, url) == before
    fresh = plan(client, ltl="F won", environment="changing")["policy"]["url"]
    assert fresh != url
    assert simulate(client, fresh)["success_rate"] == 1
    assert client.delete("/environments/changing").status_code == 204
    assert simulate(client, url) == before


@pytest.mark.parametrize(
    ("body", "slug", "pointers"),
    [
        ({"runs": 0}, "validation", ["/runs"]),
        ({"runs": 100_001}, "validation", ["/runs"]),
        ({"seed": -1}, "validation", ["/seed"]),
        ({"max_steps": 0}, "validation", ["/max_steps"]),
        ({"max_steps": 1e5}, "validation", ["/max_steps"]),
        ({"runs": 100_000, "max_steps": 100_000}, "validation", [""]),
        ({"walks": 3}, "validation", ["/walks"]),
        ({"state": {"mdp": {"state": "9"}}}, "invalid-state", ["/state/mdp/state"]),
    ],
)
def test_refusals(client: httpx.Client, body: dict[str, Any], slug: str, pointers: list[str]) -> None:
    url = plan(client, ltl="F won", environment_spec=COIN)["policy"]["url"]
    check_problem(client.post(f"{url}/simulate", json=body), slug, 422, pointers)


def test_a_simulation_that_takes_too_long_is_stopped(tmp_path: Path) -> None:
    slow = {**COIN, "transitions": [{"from": 0, "action": "on", "to": [[0, 0.999999], [2, 0.000001]]}]}
    with serving(tmp_path, CQLTL_PLAN_TIMEOUT_S="1") as client:
        url = plan(client, ltl="F won", environment_spec=slow)["policy"]["url"]
        response = client.post(f"{url}/simulate", json={"runs": 100_000, "max_steps": 10_000})
        check_problem(response, "out-of-time", 422)
        assert simulate(client, url, runs=1, max_steps=10)["undecided"] == 1
