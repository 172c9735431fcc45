"""`/environments` and `/templates` over HTTP."""

from __future__ import annotations

from typing import Any

import httpx
import pytest

from models.world import toys_spec
from tests.service.conftest import Snapshot, check_problem


def named(name: str, **change: Any) -> dict[str, Any]:
    return {**toys_spec(columns=2, rows=1, toys=[("sphere", "red")]), "name": name, **change}


def test_the_built_in_worlds_are_there(client: httpx.Client) -> None:
    names = [item["name"] for item in client.get("/environments").json()["items"]]
    assert {"navigation", "toys", "toys-4x1-cylinder", "toys-4x1-sphere"} <= set(names)


def test_the_seven_templates_of_the_paper_are_there(client: httpx.Client) -> None:
    found = {item["task"]: item["template"] for item in client.get("/templates").json()["items"]}
    expected = {
        "move_to": "F near(robot, $1)",
        "pickup": "F holding($1)",
        "pickup_colored": "F (holding($1) & colored($1, $2))",
        "ship": "F (in($1, $2) & F (in($1, $2) & at($2, $3)))",
        "navigate_one": "F at(robot, $1)",
        "navigate_two": "F (at(robot, $1) & F at(robot, $2))",
        "navigate_three": "F (at(robot, $1) & F (at(robot, $2) & F at(robot, $3)))",
    }
    assert {task: found[task] for task in expected} == expected


def test_an_environment_comes_back_as_it_was_given(client: httpx.Client) -> None:
    spec = named("as-given")
    created = client.post("/environments", json=spec)
    assert created.status_code == 201
    assert created.headers["location"] == "/environments/as-given"
    got = client.get("/environments/as-given").json()
    assert got == created.json()
    assert (got["name"], got["kind"], got["revision"]) == ("as-given", "oomdp", 1)
    assert client.put("/environments/as-given", json=got["spec"]).json()["spec"] == got["spec"]


def test_put_replaces_and_delete_forgets(client: httpx.Client) -> None:
    assert client.put("/environments/put", json=named("put")).status_code == 201
    replaced = client.put("/environments/put", json=named("put", parameters={"slip": 0.5}))
    assert (replaced.status_code, replaced.json()["revision"]) == (200, 2)
    assert client.delete("/environments/put").status_code == 204
    check_problem(client.get("/environments/put"), "unknown-environment", 404)
    check_problem(client.delete("/environments/put"), "unknown-environment", 404)


def test_a_replaced_environment_is_planned_anew(client: httpx.Client) -> None:
    client.put("/environments/slippery", json=named("slippery", parameters={"slip": 0.0}))
    body = {"contextual_query": "pickup(sphere)", "environment": "slippery"}
    first = client.post("/plan", json=body).json()
    client.put("/environments/slippery", json=named("slippery", parameters={"slip": 0.5}))
    second = client.post("/plan", json=body).json()
    assert second["expected_steps"] > first["expected_steps"]
    assert second["id"] != first["id"]


@pytest.mark.parametrize(
    ("spec", "slug", "status", "pointers"),
    [
        (named("toys"), "environment-exists", 409, ["/name"]),
        (named("bad", domain="lego"), "invalid-environment", 422, ["/domain"]),
        (named("bad", color="red"), "validation", 422, ["/color"]),
        ({"name": "bad"}, "validation", 422, ["/kind"]),
        ({"name": "bad", "kind": "oomdp"}, "validation", 422, [""]),
        ([], "validation", 422, [""]),
        ({"name": "bad", "kind": "explicit", "states": 2, "initial": 2}, "invalid-environment", 422, ["/initial"]),
        ({"name": "bad", "kind": "explicit", "states": 10**9}, "validation", 422, ["/states"]),
    ],
)
def test_a_refused_environment_names_its_place_and_is_not_stored(
    client: httpx.Client, snapshot: Snapshot, spec: Any, slug: str, status: int, pointers: list[str]
) -> None:
    before = snapshot()
    check_problem(client.post("/environments", json=spec), slug, status, pointers)
    assert snapshot() == before


def test_put_under_another_name_is_refused(client: httpx.Client, snapshot: Snapshot) -> None:
    before = snapshot()
    check_problem(client.put("/environments/one", json=named("two")), "invalid-environment", 422, ["/name"])
    assert snapshot() == before


def test_lists_come_in_pages(client: httpx.Client) -> None:
    whole = client.get("/templates", params={"limit": 200}).json()
    assert whole["next"] is None
    items, cursor = [], ""
    while cursor is not None:
        page = client.get("/templates", params={"limit": 3, "cursor": cursor}).json()
        assert 1 <= len(page["items"]) <= 3
        items += page["items"]
        cursor = page["next"]
    assert items == whole["items"]
    check_problem(client.get("/environments", params={"limit": 0}), "validation", 422)


def test_a_deleted_template_is_gone(client: httpx.Client) -> None:
    lesson = {"contextual_query": "fleeting(sphere)", "ltl": "F holding(sphere)", "environment": "toys"}
    assert client.post("/learn", json=lesson).status_code == 201
    assert client.get("/templates/fleeting").json()["task"] == "fleeting"
    assert client.delete("/templates/fleeting").status_code == 204
    check_problem(client.get("/templates/fleeting"), "unknown-template", 404)
    check_problem(client.delete("/templates/fleeting"), "unknown-template", 404)


def test_names_in_any_script(client: httpx.Client) -> None:
    response = client.post("/environments", json=named("склад 1"))
    assert response.status_code == 201
    assert client.get(response.headers["location"]).json()["name"] == "склад 1"
    assert client.delete(response.headers["location"]).status_code == 204


@pytest.mark.parametrize("name", ["a/b", "..", "."])
def test_a_name_that_no_path_can_hold_is_refused(client: httpx.Client, name: str) -> None:
    check_problem(client.post("/environments", json=named(name)), "invalid-environment", 422, ["/name"])
