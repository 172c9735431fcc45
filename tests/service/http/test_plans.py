"""`/plan` and `/policies` over HTTP."""

from __future__ import annotations

from typing import Any

import httpx
import pytest

from models.world import toys_spec
from tests.service.conftest import Snapshot, check_problem, plan

SHIP = "Put the cylinder in the box, then put the box in the bedroom"
TINY: dict[str, Any] = {
    "name": "tiny",
    "kind": "explicit",
    "states": 3,
    "initial": 0,
    "labels": {"a": [1], "b": [2]},
    "transitions": [
        {"from": 0, "action": "go", "to": [[1, 0.9], [0, 0.1]]},
        {"from": 1, "action": "go", "to": [[2, 0.5], [1, 0.5]]},
        {"from": 2, "action": "stay", "to": [[2, 1.0]]},
    ],
}
RISKY: dict[str, Any] = {
    "name": "risky",
    "kind": "explicit",
    "states": 3,
    "initial": 0,
    "labels": {"hurt": [1]},
    "transitions": [
        {"from": 0, "action": "run", "to": [[1, 0.9], [2, 0.1]]},
        {"from": 0, "action": "walk", "to": [[1, 0.3], [2, 0.7]]},
        {"from": 1, "action": "stay", "to": [[1, 1.0]]},
        {"from": 2, "action": "stay", "to": [[2, 1.0]]},
    ],
}


@pytest.mark.parametrize(
    ("text", "environment", "query"),
    [
        (SHIP, "toys-4x1-cylinder", "ship(cylinder, box, bedroom)"),
        ("Pickup the sphere", "toys-4x1-sphere", "pickup(sphere)"),
    ],
)
def test_both_sentences_of_the_paper_are_planned_and_driven_to_done(
    client: httpx.Client, text: str, environment: str, query: str
) -> None:
    answer = plan(client, text=text, environment=environment)
    assert answer["outcome"] == "solved"
    assert answer["contextual_query"]["text"] == query
    assert 0.9 < answer["confidence"] <= 1.0
    assert answer["probability"] == {"lower": 1.0, "upper": 1.0}
    assert answer["model"]["states"] == 4 * 5 * 6
    assert answer["trajectory_complete"]
    assert len(answer["trajectory"]) == answer["expected_steps"] + 1  # no slip here: the run is the plan
    actions = []
    for step in answer["trajectory"]:
        # the world is deterministic, so the trajectory says what the robot would observe
        told = client.post(
            f"{answer['policy']['url']}/step", json={"state": step["state"], "memory": step["memory"]}
        ).json()
        assert told["action"] == step["action"]
        actions.append(told["action"])
    assert told["done"]
    assert told["status"] == "satisfied"
    assert told["expected_steps"] == 0
    assert actions[-1] is None
    assert None not in actions[:-1]


def test_a_query_and_its_formula_give_the_same_plan(client: httpx.Client) -> None:
    one = plan(client, contextual_query="pickup(sphere)", environment="toys-4x1-sphere")
    two = plan(client, ltl="F holding(sphere)", environment="toys-4x1-sphere")
    assert (one["confidence"], two["confidence"]) == (None, None)
    assert one["id"] == two["id"]
    assert (one["trajectory"], one["probability"]) == (two["trajectory"], two["probability"])


def test_equal_requests_get_equal_answers_but_for_timing(client: httpx.Client) -> None:
    def answer() -> dict[str, Any]:
        found = plan(client, ltl="F holding(sphere)", environment="toys")
        del found["timing"]
        return found

    assert answer() == answer()


def test_an_explicit_environment_by_hand(client: httpx.Client) -> None:
    """From 0: 1/0.9 steps to 1, then 2 more to 2."""
    answer = plan(client, ltl="F (a & F b)", environment_spec=TINY)
    assert answer["probability"] == {"lower": 1.0, "upper": 1.0}
    assert answer["expected_steps"] == pytest.approx(1 / 0.9 + 2)
    assert [step["state"]["mdp"]["state"] for step in answer["trajectory"]] == ["0", "1", "2"]
    assert answer["trajectory_probability"] == pytest.approx(0.9 * 0.5)
    assert answer["trajectory_complete"]
    assert answer["initial"] == {"state": {"mdp": {"state": "0"}}, "memory": 0}


@pytest.mark.parametrize(
    ("ltl", "objective", "outcome"),
    [
        ("a & !a", "max", "unsatisfiable"),
        ("F (b & X F a)", "max", "unreachable"),
        ("b", "max", "unreachable"),
        ("G F a", "max", "unreachable"),
        ("a | !a", "min", "unsatisfiable"),
        ("F b", "min", "unreachable"),
    ],
)
def test_what_cannot_be_done_is_an_outcome(client: httpx.Client, ltl: str, objective: str, outcome: str) -> None:
    answer = plan(client, ltl=ltl, environment_spec=TINY, options={"objective": objective, "verify": True})
    assert (answer["outcome"], answer["objective"]) == (outcome, objective)
    probability = 0.0 if objective == "max" else 1.0
    assert answer["probability"] == {"lower": probability, "upper": probability}
    for member in ("id", "policy", "expected_steps", "round_steps", "trajectory_loop", "verified"):
        assert answer[member] is None
    assert answer["trajectory"] == []


def test_why_it_cannot_be_done_here(client: httpx.Client) -> None:
    """The robot has one hand; and what the formula contradicts itself is no fault of the world."""
    both = plan(client, ltl="F (holding(sphere) & holding(cylinder))", environment="toys")
    (why,) = both["obstacles"]
    assert why["ltl"] == "G !(holding(sphere) & holding(cylinder))"
    assert why["explanation"].startswith("never both the robot is holding the sphere and")
    assert plan(client, ltl="F a & G !a", environment_spec=TINY)["obstacles"] == []
    assert plan(client, ltl="F a", environment_spec=TINY)["obstacles"] == []


def test_what_has_to_be_done_again_and_again(client: httpx.Client) -> None:
    """Kitchen and bathroom are three rooms apart, so a round is six steps, and the robot begins at one end."""
    patrol = "G F at(robot, kitchen) & G F at(robot, bathroom) & G !holding(sphere)"
    answer = plan(client, ltl=patrol, environment="toys-4x1-sphere")
    assert (answer["outcome"], answer["probability"]) == ("solved", {"lower": 1.0, "upper": 1.0})
    assert answer["round_steps"] == {"lower": pytest.approx(6), "upper": pytest.approx(6)}
    assert answer["trajectory_complete"]
    loop, steps = answer["trajectory_loop"], answer["trajectory"]
    assert steps[-1] == steps[loop]
    rooms = {step["state"]["robot"]["at"] for step in steps[loop:]}
    assert {"kitchen", "bathroom"} <= rooms
    assert {step["action"] for step in steps} <= {"east", "west"}


def test_what_has_to_be_kept(client: httpx.Client) -> None:
    answer = plan(client, ltl="G !holding(sphere)", environment="toys-4x1-sphere")
    assert (answer["outcome"], answer["probability"]) == ("solved", {"lower": 1.0, "upper": 1.0})
    assert answer["expected_steps"] == 0
    assert answer["trajectory_loop"] is not None


def test_a_task_that_ends_has_neither_rounds_nor_a_loop(client: httpx.Client) -> None:
    answer = plan(client, ltl="F b", environment_spec=TINY)
    assert (answer["round_steps"], answer["trajectory_loop"], answer["verified"]) == (None, None, None)
    assert answer["objective"] == "max"


@pytest.mark.parametrize(("objective", "probability"), [("max", 0.9), ("min", 0.3)])
def test_the_greatest_and_the_least_probability(client: httpx.Client, objective: str, probability: float) -> None:
    options = {"objective": objective, "verify": True}
    answer = plan(client, ltl="F hurt", environment_spec=RISKY, options=options)
    assert answer["ltl"] == "F hurt"
    assert answer["probability"]["lower"] <= probability + 1e-9
    assert answer["probability"]["upper"] >= probability - 1e-9
    assert answer["verified"] == {
        "probability": pytest.approx(probability),
        "expected_steps": pytest.approx(1.0),
        "sound": True,
        "states": 3,
    }
    policy = client.get(answer["policy"]["url"]).json()
    assert (policy["ltl"], policy["objective"]) == ("F hurt", objective)
    assert (policy["formula"] == "F hurt") == (objective == "max")
    told = client.post(f"{answer['policy']['url']}/step", json={"state": answer["initial"]["state"]}).json()
    assert told["action"] == {"max": "run", "min": "walk"}[objective]
    assert told["probability"] == pytest.approx({"max": 0.9, "min": 0.7}[objective]), "of the policy's own formula"


def test_a_loop_beyond_the_longest_trajectory_is_cut(client: httpx.Client) -> None:
    count = 1_200
    ring = {
        "name": "ring",
        "kind": "explicit",
        "states": count,
        "initial": 0,
        "labels": {"end": [count - 1]},
        "transitions": [{"from": state, "action": "on", "to": [[(state + 1) % count, 1.0]]} for state in range(count)],
    }
    answer = plan(client, ltl="G F end", environment_spec=ring)
    assert len(answer["trajectory"]) == 1_000
    assert (answer["trajectory_complete"], answer["trajectory_loop"]) == (False, None)
    assert answer["round_steps"]["lower"] <= count


def test_planning_from_a_given_state(client: httpx.Client) -> None:
    held = {"sphere": {"in": "robot"}}
    answer = plan(client, ltl="F holding(sphere)", environment="toys-4x1-sphere", state=held)
    assert answer["expected_steps"] == 0
    assert answer["initial"]["state"]["sphere"] == {"in": "robot"}


@pytest.mark.parametrize(
    ("change", "slug", "status", "pointers"),
    [
        ({"ltl": "F"}, "formula-syntax", 422, ["/ltl"]),
        ({"ltl": "F holding(box, sphere)"}, "unknown-proposition", 422, ["/ltl"]),
        ({"ltl": "F in(box, sphere)"}, "type-mismatch", 422, ["/ltl"]),
        ({"ltl": "F holding($1)"}, "unknown-object", 422, ["/ltl"]),
        ({"ltl": None, "text": "sing me a song"}, "not-understood", 422, ["/text"]),
        ({"ltl": None, "text": "pick up the unicorn"}, "ambiguous-command", 422, ["/text"]),
        ({"ltl": None, "contextual_query": "sing(song)"}, "unknown-template", 404, ["/contextual_query"]),
        ({"ltl": None, "contextual_query": "pickup(song)"}, "unknown-object", 422, ["/contextual_query/arguments/0"]),
        ({"environment": "atlantis"}, "unknown-environment", 404, ["/environment"]),
        ({"state": {"robot": {"at": "moon"}}}, "invalid-state", 422, None),
        ({"state": {"robot": "kitchen"}}, "validation", 422, ["/state/robot"]),
        ({"text": "Pickup the sphere"}, "validation", 422, [""]),
        ({"ltl": None}, "validation", 422, [""]),
        ({"environment_spec": TINY}, "validation", 422, [""]),
        ({"environment": None}, "validation", 422, [""]),
        ({"options": {"epsilon": 0}}, "validation", 422, ["/options/epsilon"]),
        ({"options": {"max_states": 10}}, "model-too-large", 422, ["/options/max_states"]),
        ({"options": {"objective": "average"}}, "validation", 422, ["/options/objective"]),
        ({"options": {"verify": 1}}, "validation", 422, ["/options/verify"]),
        ({"options": {"speed": "fast"}}, "validation", 422, ["/options/speed"]),
        (
            {"environment": None, "environment_spec": {**TINY, "initial": 9}},
            "invalid-environment",
            422,
            ["/environment_spec/initial"],
        ),
        (
            {"environment": None, "environment_spec": {**TINY, "states": "3"}},
            "validation",
            422,
            ["/environment_spec/states"],
        ),
        (
            {"environment": None, "environment_spec": {**TINY, "kind": "magic"}},
            "validation",
            422,
            ["/environment_spec/kind"],
        ),
    ],
)
def test_refusals(
    client: httpx.Client,
    snapshot: Snapshot,
    change: dict[str, Any],
    slug: str,
    status: int,
    pointers: list[str] | None,
) -> None:
    before = snapshot()
    body = {"ltl": "F holding(sphere)", "environment": "toys", **change}
    response = client.post("/plan", json={name: value for name, value in body.items() if value is not None})
    problem = check_problem(response, slug, status, pointers)
    if slug == "invalid-state":
        assert problem["errors"][0]["pointer"].startswith("/state")
    assert snapshot() == before


def test_a_plan_that_takes_too_long_is_stopped(client: httpx.Client) -> None:
    toys = [("sphere", "red"), ("cube", "blue"), ("cone", "red")]
    large = toys_spec(columns=4, rows=4, toys=toys, slip=0.1)  # only to list its transitions takes seconds
    task = "G F holding(sphere) & G F holding(cube)"
    body = {"ltl": task, "environment_spec": large, "options": {"timeout_s": 0.2}}
    check_problem(client.post("/plan", json=body), "out-of-time", 422)
    assert client.get("/livez").status_code == 200


def test_a_plan_that_runs_out_of_time_answers_with_the_bounds_it_reached(client: httpx.Client) -> None:
    """A walk between winning and losing, far too long for its values to settle in a second; the true value is 1/2."""
    size = 4_001
    steps = [{"from": s, "action": "go", "to": [[s - 1, 0.5], [s + 1, 0.5]]} for s in range(1, size - 1)]
    spec = {
        "name": "walk",
        "kind": "explicit",
        "states": size,
        "initial": size // 2,
        "labels": {"a": [size - 1]},
        "transitions": steps,
    }
    answer = plan(client, ltl="F a", environment_spec=spec, options={"timeout_s": 2, "verify": False})
    assert answer["outcome"] == "solved"
    assert answer["probability"]["lower"] <= 0.5 <= answer["probability"]["upper"]
    assert answer["probability"]["upper"] - answer["probability"]["lower"] > 0.1
