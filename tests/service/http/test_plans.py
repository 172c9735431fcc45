"""`/plan` and `/policies` over HTTP."""

from __future__ import annotations

from typing import Any

import httpx
import pytest

from models.world import toys_spec
from tests.service.conftest import Snapshot, check_problem

SHIP = "Put the cylinder in the box, then put the box in the bedroom"
WHERE = {"robot": {"at": "kitchen"}, "box": {"in": "kitchen"}, "sphere": {"in": "kitchen"}}
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


def plan(client: httpx.Client, **body: Any) -> dict[str, Any]:
    response = client.post("/plan", json=body)
    assert response.status_code == 200, response.text
    answer: dict[str, Any] = response.json()
    return answer


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
    ("ltl", "outcome"),
    [("a & !a", "unsatisfiable"), ("F (b & X F a)", "unreachable"), ("b", "unreachable"), ("X F b", "solved")],
)
def test_what_cannot_be_done_is_an_outcome(client: httpx.Client, ltl: str, outcome: str) -> None:
    answer = plan(client, ltl=ltl, environment_spec=TINY)
    assert answer["outcome"] == outcome
    if outcome != "solved":
        assert answer["probability"] == {"lower": 0.0, "upper": 0.0}
        assert (answer["id"], answer["policy"], answer["expected_steps"]) == (None, None, None)
        assert answer["trajectory"] == []


def test_planning_from_a_given_state(client: httpx.Client) -> None:
    held = {"sphere": {"in": "robot"}}
    answer = plan(client, ltl="F holding(sphere)", environment="toys-4x1-sphere", state=held)
    assert answer["expected_steps"] == 0
    assert answer["initial"]["state"]["sphere"] == {"in": "robot"}


def test_a_moved_robot_goes_on_from_where_it_is(client: httpx.Client) -> None:
    answer = plan(client, text="Pickup the sphere", environment="toys-4x1-sphere")
    start = answer["initial"]["state"]
    moved = {**start, "robot": {"at": start["sphere"]["in"]}}
    told = client.post(f"{answer['policy']['url']}/step", json={"state": moved}).json()
    assert told["action"] == "pick(sphere)"
    assert told["expected_steps"] == 1


def test_the_whole_policy_decodes_as_documented(client: httpx.Client) -> None:
    answer = plan(client, text=SHIP, environment="toys-4x1-cylinder")
    policy = client.get(answer["policy"]["url"]).json()
    assert policy["states"] * policy["memories"] == len(policy["action"]) == len(policy["next_memory"])
    memory = answer["initial"]["memory"]
    for step in answer["trajectory"]:
        index = sum(
            variable["stride"] * variable["values"].index(step["state"][variable["object"]][variable["attribute"]])
            for variable in policy["variables"]
        )
        entry = memory * policy["states"] + index
        action = policy["action"][entry]
        assert (policy["actions"][action] if action >= 0 else None) == step["action"]
        assert memory == step["memory"]
        memory = policy["next_memory"][entry]
    assert policy["accepted"][memory] == 1


def test_the_automaton_as_hoa(client: httpx.Client) -> None:
    answer = plan(client, text=SHIP, environment="toys-4x1-cylinder")
    response = client.get(f"{answer['policy']['url']}/automaton")
    assert response.text.startswith("HOA: v1")
    assert "in(cylinder, box)" in response.text


@pytest.mark.parametrize(
    ("change", "slug", "status", "pointers"),
    [
        ({"ltl": "G F holding(sphere)"}, "formula-not-cosafe", 422, ["/ltl"]),
        ({"ltl": "G !holding(sphere)"}, "formula-not-cosafe", 422, ["/ltl"]),
        ({"ltl": "F"}, "formula-syntax", 422, ["/ltl"]),
        ({"ltl": "F holding(box, sphere)"}, "unknown-proposition", 422, ["/ltl"]),
        ({"ltl": "F in(box, sphere)"}, "type-mismatch", 422, ["/ltl"]),
        ({"ltl": "F holding($1)"}, "unknown-object", 422, ["/ltl"]),
        ({"ltl": None, "text": "sing me a song"}, "not-understood", 422, ["/text"]),
        ({"ltl": None, "text": "pick up the unicorn"}, "unknown-object", 422, ["/text"]),
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
    large = toys_spec(columns=5, rows=4, toys=[("sphere", "red"), ("cube", "blue"), ("cone", "green")], slip=0.1)
    body = {"contextual_query": "pickup(sphere)", "environment_spec": large, "options": {"timeout_s": 0.05}}
    check_problem(client.post("/plan", json=body), "out-of-time", 422)
    assert client.get("/livez").status_code == 200


@pytest.mark.parametrize(
    ("body", "slug", "pointers"),
    [
        ({"state": {"robot": {"at": "moon"}}}, "invalid-state", None),
        ({"state": {"moon": {"at": "kitchen"}}}, "invalid-state", None),
        ({"state": {**WHERE, "box": {"in": "robot"}, "sphere": {"in": "robot"}}}, "invalid-state", None),
        ({"state": {}}, "invalid-state", ["/state/robot/at", "/state/box/in", "/state/sphere/in"]),
        ({"state": {"robot": {"at": "kitchen"}, "box": {"in": "kitchen"}}}, "invalid-state", ["/state/sphere/in"]),
        ({"state": WHERE, "memory": 99}, "invalid-memory", ["/memory"]),
        ({"state": WHERE, "memory": -1}, "validation", ["/memory"]),
        ({"memory": 0}, "validation", ["/state"]),
    ],
)
def test_step_refuses_with_the_place(
    client: httpx.Client, body: dict[str, Any], slug: str, pointers: list[str] | None
) -> None:
    url = plan(client, text="Pickup the sphere", environment="toys-4x1-sphere")["policy"]["url"]
    problem = check_problem(client.post(f"{url}/step", json=body), slug, 422, pointers)
    if slug == "invalid-state":
        assert problem["errors"][0]["pointer"].startswith("/state")


def test_unknown_policies(client: httpx.Client) -> None:
    check_problem(client.get("/policies/none"), "unknown-policy", 404)
    check_problem(client.get("/policies/none/automaton"), "unknown-policy", 404)
    check_problem(client.post("/policies/none/step", json={"state": {}}), "unknown-policy", 404)


def test_policies_are_listed_and_deleted(client: httpx.Client) -> None:
    answer = plan(client, ltl="F (holding(sphere) & F holding(box))", environment="toys-4x1-sphere")
    rows, cursor = [], ""
    while cursor is not None:
        page = client.get("/policies", params={"limit": 3, "cursor": cursor}).json()
        rows += page["items"]
        cursor = page["next"]
    assert {"id": answer["id"], "environment": "toys-4x1-sphere", "ltl": answer["ltl"]} in rows
    assert len(rows) == len({row["id"] for row in rows})
    assert client.delete(answer["policy"]["url"]).status_code == 204
    check_problem(client.get(answer["policy"]["url"]), "unknown-policy", 404)
    check_problem(client.delete(answer["policy"]["url"]), "unknown-policy", 404)
