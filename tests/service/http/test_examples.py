"""Taught utterances over HTTP: marks, listing, deletion, conflicts."""

from __future__ import annotations

import httpx

from tests.service.conftest import Snapshot, check_problem, learn


def test_examples_are_listed_with_what_they_say(client: httpx.Client) -> None:
    said = [
        "stash the cylinder in the box",
        "the {2} is where {1: the sphere} belongs",
        "let the crate swallow the bag",
    ]
    assert learn(client, "stash(cylinder, box)", "F in(cylinder, box)", *said).status_code == 201
    items = client.get("/templates/stash/examples").json()["items"]
    assert {item["text"]: item["contextual_query"] for item in items} == {
        said[0]: "stash(cylinder, box)",
        said[1]: "stash(sphere, box)",
        said[2]: "stash(bag, crate)",
    }
    assert all(item["also_says"] == [] for item in items)
    first = client.get("/templates/stash/examples", params={"limit": 2}).json()
    rest = client.get("/templates/stash/examples", params={"cursor": first["next"]}).json()
    assert first["items"] + rest["items"] == items
    assert rest["next"] is None


def test_a_deleted_example_is_not_understood_any_more(client: httpx.Client) -> None:
    command = {"text": "zorble the sphere into the box", "environment": "toys"}
    learn(client, "zorble(cylinder, box)", "F in(cylinder, box)", "zorble the cylinder into the box")
    assert client.post("/translate", json=command).json()["contextual_query"]["text"] == "zorble(sphere, box)"
    (item,) = client.get("/templates/zorble/examples").json()["items"]
    assert client.delete(f"/templates/zorble/examples/{item['id']}").status_code == 204
    assert client.get("/templates/zorble").json()["revision"] == 2
    assert client.get("/templates/zorble/examples").json()["items"] == []
    answer = client.post("/translate", json=command).json()
    assert answer["contextual_query"] is None or answer["confidence"] < 1
    check_problem(client.delete(f"/templates/zorble/examples/{item['id']}"), "unknown-example", 404)
    check_problem(client.delete("/templates/nothing/examples/0"), "unknown-template", 404)
    check_problem(client.get("/templates/nothing/examples"), "unknown-template", 404)


def test_a_wording_taught_with_two_meanings_is_reported(client: httpx.Client) -> None:
    learn(client, "hoist(sphere)", "F holding(sphere)", "deal with the sphere")
    answer = learn(client, "shun(sphere)", "G !holding(sphere)", "deal with the cylinder now", "deal with the cylinder")
    assert answer.status_code == 201
    assert answer.json()["warnings"] == ['the wording "deal with the cylinder" was also taught for hoist']
    (item,) = client.get("/templates/hoist/examples").json()["items"]
    assert item["also_says"] == ["shun"]


def test_the_same_words_with_the_arguments_turned_round_are_reported(client: httpx.Client) -> None:
    ltl = "F (at(robot, kitchen) & F at(robot, bathroom))"
    learn(client, "commute(kitchen, bathroom)", ltl, "commute {1} {2}")
    answer = learn(client, "commute(kitchen, bathroom)", ltl, "commute {2} {1}")
    assert answer.json()["warnings"] == ['the wording "commute {2} {1}" was also taught for commute']


def test_arguments_that_cannot_be_found_are_refused(client: httpx.Client, snapshot: Snapshot) -> None:
    before = snapshot()
    for said, slug in (
        ("stash it away", "example-argument-not-found"),
        ("stash {1} in {7}", "example-mark"),
        ("{1} {2}", "example-too-general"),
    ):
        answer = learn(client, "stow9(cylinder, box)", "F in(cylinder, box)", "stow the cylinder in the box", said)
        check_problem(answer, slug, 422, ["/examples/1"])
    assert snapshot() == before
