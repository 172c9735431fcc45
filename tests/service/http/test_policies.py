"""`/policies` over HTTP: the control loop, the policy as arrays, the automaton."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any
from xml.etree import ElementTree

import httpx
import numpy as np
import pytest

from models.world import World, compile_world, load_environment
from tests.service.conftest import check_problem, plan

SHIP = "Put the cylinder in the box, then put the box in the bedroom"
WHERE = {"robot": {"at": "kitchen"}, "box": {"in": "kitchen"}, "sphere": {"in": "kitchen"}}
PATROL = "G F at(robot, kitchen) & G F at(robot, bathroom) & G !holding(sphere)"


@dataclass
class Robot:
    """What `docs/http.md` says a robot does with a policy and no network: it knows the JSON and nothing else."""

    policy: dict[str, Any]
    memory: int

    def act(self, state: dict[str, dict[str, str]]) -> tuple[str, str | None]:
        """Status and action; the memory moves on."""
        policy, automaton = self.policy, self.policy["automaton"]
        index = sum(v["stride"] * v["values"].index(state[v["object"]][v["attribute"]]) for v in policy["variables"])
        self.memory = automaton["successors"][self.memory][policy["letter"][index]]
        row = automaton["row"][self.memory]
        if row < 0:
            return ("satisfied" if automaton["accepted"][self.memory] else "lost"), None
        entry = row * policy["places"] + index
        action = policy["action"][entry]
        if action == -1:
            return "lost", None
        status = "sustaining" if policy["expected_steps"][entry] == 0 else "running"
        return status, policy["actions"][action] if action >= 0 else None


@dataclass
class Nature:
    """A stored environment that happens."""

    world: World
    state: int
    chance: np.random.Generator

    @classmethod
    def of(cls, client: httpx.Client, environment: str) -> Nature:
        spec = client.get(f"/environments/{environment}").json()["spec"]
        world = compile_world(load_environment(spec))
        return cls(world, world.initial, np.random.default_rng(1))

    def observed(self) -> dict[str, dict[str, str]]:
        return self.world.decode(self.state)

    def do(self, action: str | None) -> None:
        if action is None:
            return
        outcomes = self.world.outcomes(self.world.actions.index(action), np.array([self.state]))
        assert outcomes.enabled[0], f"{action} is not possible in {self.observed()}"
        kind = self.chance.choice(len(outcomes.probability), p=outcomes.probability[:, 0])
        self.state = int(outcomes.successor[kind, 0])


@pytest.mark.parametrize(
    ("task", "environment", "ending"),
    [
        ("F (in(cylinder, box) & F (in(cylinder, box) & at(box, bedroom)))", "toys-4x1-cylinder", "satisfied"),
        (PATROL, "toys-4x1-sphere", "sustaining"),
        ("F holding(sphere) & G !holding(box) & F G in(sphere, box)", "toys-4x1-sphere", "sustaining"),
        ("F holding(sphere)", "toys", "satisfied"),
    ],
)
def test_a_robot_with_the_json_alone_does_as_one_that_asks(
    client: httpx.Client, task: str, environment: str, ending: str
) -> None:
    answer = plan(client, ltl=task, environment=environment)
    url = answer["policy"]["url"]
    robot, nature = Robot(client.get(url).json(), answer["initial"]["memory"]), Nature.of(client, environment)
    asked, status, statuses = robot.memory, "", []
    for _ in range(60):
        state = nature.observed()
        status, action = robot.act(state)
        told = client.post(f"{url}/step", json={"state": state, "memory": asked}).json()
        asked = told["memory"]
        assert (told["status"], told["action"], told["memory"]) == (status, action, robot.memory)
        assert told["done"] == (status == "satisfied")
        statuses.append(status)
        if status == "satisfied":
            break
        nature.do(action)
    assert status == ending
    assert "lost" not in statuses
    assert "running" not in statuses[statuses.index(ending) :], "what is kept up stays kept up"


def test_a_patrol_goes_round_for_ever(client: httpx.Client) -> None:
    answer = plan(client, ltl=PATROL, environment="toys-4x1-sphere")
    robot = Robot(client.get(answer["policy"]["url"]).json(), answer["initial"]["memory"])
    nature, rooms = Nature.of(client, "toys-4x1-sphere"), []
    for _ in range(61):
        rooms.append(nature.observed()["robot"]["at"])
        nature.do(robot.act(nature.observed())[1])
    assert (rooms.count("bathroom"), rooms.count("kitchen")) == (10, 11)


def test_what_cannot_be_kept_any_more_is_lost(client: httpx.Client) -> None:
    answer = plan(client, ltl="G !holding(sphere)", environment="toys-4x1-sphere")
    held = {**answer["initial"]["state"], "sphere": {"in": "robot"}}
    told = client.post(f"{answer['policy']['url']}/step", json={"state": held}).json()
    assert (told["status"], told["action"], told["probability"], told["done"]) == ("lost", None, 0, False)
    robot = Robot(client.get(answer["policy"]["url"]).json(), 0)
    assert robot.act(held) == ("lost", None)


def test_a_moved_robot_goes_on_from_where_it_is(client: httpx.Client) -> None:
    answer = plan(client, text="Pickup the sphere", environment="toys-4x1-sphere")
    start = answer["initial"]["state"]
    moved = {**start, "robot": {"at": start["sphere"]["in"]}}
    told = client.post(f"{answer['policy']['url']}/step", json={"state": moved}).json()
    assert told["action"] == "pick(sphere)"
    assert told["expected_steps"] == 1


def test_the_arrays_have_the_sizes_that_are_documented(client: httpx.Client) -> None:
    answer = plan(client, text=SHIP, environment="toys-4x1-cylinder")
    policy = client.get(answer["policy"]["url"]).json()
    automaton = policy["automaton"]
    assert policy["memories"] == len(automaton["row"]) == len(automaton["accepted"]) == len(automaton["successors"])
    assert {len(row) for row in automaton["successors"]} == {2 ** len(policy["atoms"])}
    assert policy["places"] == len(policy["letter"])
    rows = sum(row >= 0 for row in automaton["row"])
    for member in ("action", "probability", "expected_steps"):
        assert len(policy[member]) == rows * policy["places"]


def test_the_automaton_in_every_format(client: httpx.Client) -> None:
    url = plan(client, ltl=PATROL, environment="toys-4x1-sphere")["policy"]["url"] + "/automaton"
    hoa, dot, svg = (client.get(url, params={"format": form}) for form in ("hoa", "dot", "svg"))
    assert client.get(url).text == hoa.text
    assert hoa.text.startswith("HOA: v1")
    assert "at(robot, kitchen)" in hoa.text
    assert dot.text.startswith("digraph")
    assert "2 lost" in dot.text
    words = [text.text for text in ElementTree.fromstring(svg.text).iter("{http://www.w3.org/2000/svg}text")]
    assert {"0", "1", "2", "lost", "holding(sphere)"} <= set(words)
    types = [response.headers["content-type"].partition(";")[0] for response in (hoa, dot, svg)]
    assert types == ["text/plain", "text/vnd.graphviz", "image/svg+xml"]


def test_pictures_that_are_refused(client: httpx.Client) -> None:
    rooms = [f"F at({thing}, {room})" for thing in ("robot", "box", "sphere") for room in ("kitchen", "bedroom")]
    url = plan(client, ltl=" & ".join(rooms), environment="toys-4x1-sphere")["policy"]["url"]
    refused = client.get(f"{url}/automaton", params={"format": "svg"})
    assert "dot" in check_problem(refused, "drawing-too-large", 422, ["/query/format"])["detail"]
    assert client.get(f"{url}/automaton", params={"format": "dot"}).status_code == 200
    check_problem(client.get(f"{url}/automaton", params={"format": "png"}), "validation", 422, ["/query/format"])


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
    check_problem(client.post("/policies/none/simulate", json={}), "unknown-policy", 404)


def test_policies_are_listed_and_deleted(client: httpx.Client) -> None:
    answer = plan(client, ltl="F (holding(sphere) & F holding(box))", environment="toys-4x1-sphere")
    rows, cursor = [], ""
    while cursor is not None:
        page = client.get("/policies", params={"limit": 3, "cursor": cursor}).json()
        rows += page["items"]
        cursor = page["next"]
    row = {"id": answer["id"], "environment": "toys-4x1-sphere", "ltl": answer["ltl"], "objective": "max"}
    assert row in rows
    assert len(rows) == len({row["id"] for row in rows})
    assert client.delete(answer["policy"]["url"]).status_code == 204
    check_problem(client.get(answer["policy"]["url"]), "unknown-policy", 404)
    check_problem(client.delete(answer["policy"]["url"]), "unknown-policy", 404)
