"""Pictures of worlds and policies, one run of a policy, and the page's address."""

from __future__ import annotations

import json
from typing import Any
from xml.etree import ElementTree

import httpx
import pytest

from models.world import toys_spec
from service.http.page import POLICY
from tests.service.conftest import check_problem, plan

SVG = "{http://www.w3.org/2000/svg}"


def drawn(response: httpx.Response) -> dict[str, str]:
    """Where each thing is drawn."""
    assert response.status_code == 200, response.text
    assert response.headers["content-type"].startswith("image/svg+xml")
    groups = ElementTree.fromstring(response.text).iter(f"{SVG}g")
    return {group.get("data-object", ""): group.get("transform", "") for group in groups if group.get("data-object")}


def test_a_world_is_drawn_at_first_and_in_a_state(client: httpx.Client) -> None:
    first = drawn(client.get("/environments/house/image"))
    assert {"robot", "cup", "basket", "oven"} <= set(first)
    state = json.dumps({"cup": {"in": "basket"}})
    other = drawn(client.get("/environments/house/image", params={"state": state}))
    assert {name for name in first if first[name] != other[name]} == {"cup"}
    assert "scale" in other["cup"]


@pytest.mark.parametrize(
    ("state", "slug", "pointer"),
    [
        ("{", "invalid-state", "/query/state"),
        ("[]", "invalid-state", "/query/state"),
        ('{"cup": {"in": "moon"}}', "invalid-state", "/query/state/cup/in"),
    ],
)
def test_a_state_that_is_none_is_refused(client: httpx.Client, state: str, slug: str, pointer: str) -> None:
    check_problem(client.get("/environments/house/image", params={"state": state}), slug, 422, [pointer])


def test_unknown_things_have_no_picture(client: httpx.Client) -> None:
    check_problem(client.get("/environments/atlantis/image"), "unknown-environment", 404)
    check_problem(client.get("/policies/none/image"), "unknown-policy", 404)
    check_problem(client.post("/policies/none/run", json={}), "unknown-policy", 404)


def test_too_large_a_world_is_not_drawn(client: httpx.Client) -> None:
    spec = {**toys_spec(columns=51, rows=50, toys=1), "name": "plain"}
    assert client.put("/environments/plain", json=spec).status_code == 201
    check_problem(client.get("/environments/plain/image"), "drawing-too-large", 422)
    client.delete("/environments/plain")


def test_a_policy_is_drawn_with_the_most_probable_run(client: httpx.Client) -> None:
    answer = plan(client, text="Pickup the sphere", environment="toys-4x1-sphere")
    url = answer["policy"]["url"]
    for step in (0, 2, len(answer["trajectory"]) - 1):
        state = json.dumps(answer["trajectory"][step]["state"])
        expected = drawn(client.get("/environments/toys-4x1-sphere/image", params={"state": state}))
        assert drawn(client.get(f"{url}/image", params={"step": step})) == expected
    whole = client.get(f"{url}/image").text
    assert "step 4 of 4" in whole
    assert whole.count('class="trail"') == 3, "the robot moves three times, and picks"
    check_problem(client.get(f"{url}/image", params={"step": -1}), "validation", 422)


def test_a_run_is_what_step_says_step_by_step(client: httpx.Client) -> None:
    url = plan(client, text="Pickup the sphere", environment="toys")["policy"]["url"]
    answer = client.post(f"{url}/run", json={"seed": 3}).json()
    assert (answer["seed"], answer["status"]) == (3, "satisfied")
    for moment in answer["steps"]:
        step = client.post(f"{url}/step", json={"state": moment["state"], "memory": moment["memory"]}).json()
        assert {name: moment[name] for name in ("action", "probability", "expected_steps", "status")} == {
            name: step[name] for name in ("action", "probability", "expected_steps", "status")
        }
        assert moment["memory_after"] == step["memory"]
    assert client.post(f"{url}/run", json={"seed": 3}).json() == answer


def test_a_run_goes_on_from_where_things_were_moved(client: httpx.Client) -> None:
    url = plan(client, text="Pickup the sphere", environment="toys")["policy"]["url"]
    first = client.post(f"{url}/run", json={}).json()["steps"][1]
    moved = {**first["state"], "sphere": {"in": "bathroom"}}
    answer = client.post(f"{url}/run", json={"state": moved, "memory": first["memory"]}).json()
    assert answer["steps"][0]["state"] == moved
    assert answer["status"] == "satisfied"


@pytest.mark.parametrize(
    ("body", "slug", "pointer"),
    [
        ({"state": {"robot": {"at": "moon"}}}, "invalid-state", "/state/robot/at"),
        ({"memory": 99}, "invalid-memory", "/memory"),
        ({"max_steps": 0}, "validation", "/max_steps"),
    ],
)
def test_a_run_from_nowhere_is_refused(client: httpx.Client, body: dict[str, Any], slug: str, pointer: str) -> None:
    url = plan(client, text="Pickup the sphere", environment="toys")["policy"]["url"]
    check_problem(client.post(f"{url}/run", json=body), slug, 422, [pointer])


def test_the_states_of_an_automaton_can_be_found_in_its_picture(client: httpx.Client) -> None:
    answer = plan(client, text="Pickup the sphere", environment="toys")
    picture = client.get(f"{answer['policy']['url']}/automaton", params={"format": "svg"}).text
    states = [group.get("data-state") for group in ElementTree.fromstring(picture).iter(f"{SVG}g")]
    assert sorted(state for state in states if state) == [str(n) for n in range(answer["policy"]["memories"])]


def test_the_page_and_its_files_are_served_and_undocumented(client: httpx.Client) -> None:
    page = client.get("/")
    assert page.status_code == 200
    assert page.headers["content-type"].startswith("text/html")
    assert page.headers["content-security-policy"] == POLICY
    assert (
        client.get("/static/main.js").headers["content-type"].startswith(("text/javascript", "application/javascript"))
    )
    check_problem(client.get("/static/nothing.js"), "not-found", 404)
    check_problem(client.get("/static/..%2fpage.py"), "not-found", 404)
    assert not {"/", "/static"} & set(client.get("/openapi.json").json()["paths"])
