"""`/learn` and `/ground` over HTTP."""

from __future__ import annotations

from typing import Any

import httpx
import pytest

from tests.service.conftest import Snapshot, check_problem, learn


def test_learns_a_class_and_grounds_it_on_other_objects(client: httpx.Client) -> None:
    lesson = {
        "contextual_query": "stow(cylinder, box)",
        "ltl": "F in(cylinder, box)",
        "environment": "toys",
        "examples": ["stow the cylinder away in the box"],
    }
    response = client.post("/learn", json=lesson)
    assert response.status_code == 201
    assert response.headers["location"] == "/templates/stow"
    assert response.json() == {
        "task": "stow",
        "arity": 2,
        "parameters": [
            {"position": 1, "type": "toy", "taught": "toy"},
            {"position": 2, "type": "box", "taught": "box"},
        ],
        "template": "F in($1, $2)",
        "explanation": "eventually {1} is in {2}",
        "reading": "eventually {1} is in {2}",
        "lifted": "F in(t, b)",
        "pairs": [{"contextual_query": "stow(cylinder, box)", "ltl": "F in(cylinder, box)", "environment": "toys"}],
        "examples": ["stow the cylinder away in the box"],
        "revision": 1,
        "warnings": [],
    }
    grounded = client.post("/ground", json={"contextual_query": "stow(the sphere, box)", "environment": "toys"}).json()
    assert grounded["ltl"] == "F in(sphere, box)"
    assert [(b["argument"], b["phrase"], b["name"]) for b in grounded["bindings"]] == [
        (1, "the sphere", "sphere"),
        (2, "box", "box"),
    ]
    taught = client.post("/translate", json={"text": "Stow a sphere away in the box!", "environment": "toys"}).json()
    assert (taught["ltl"], taught["confidence"]) == ("F in(sphere, box)", 1.0)


def test_learning_the_same_again_changes_nothing(client: httpx.Client, snapshot: Snapshot) -> None:
    lesson = {"contextual_query": "again(sphere)", "ltl": "F holding(sphere)", "environment": "toys"}
    first = client.post("/learn", json=lesson)
    before = snapshot()
    second = client.post("/learn", json=lesson)
    assert (first.status_code, second.status_code) == (201, 200)
    assert first.json() == second.json()
    assert snapshot() == before


def test_the_same_template_from_another_example_adds_the_example(client: httpx.Client) -> None:
    for number, toy in enumerate(("sphere", "cylinder"), start=1):
        lesson = {"contextual_query": f"more({toy})", "ltl": f"F holding({toy})", "environment": "toys"}
        answer = client.post("/learn", json=lesson).json()
        assert answer["revision"] == number
        assert len(answer["pairs"]) == number


def test_another_template_is_a_conflict_unless_it_replaces(client: httpx.Client, snapshot: Snapshot) -> None:
    lesson = {"contextual_query": "grab(sphere)", "ltl": "F holding(sphere)", "environment": "toys"}
    assert client.post("/learn", json=lesson).status_code == 201
    other = {**lesson, "ltl": "G !holding(sphere)"}
    before = snapshot()
    check_problem(client.post("/learn", json=other), "template-conflict", 409)
    assert snapshot() == before
    replaced = client.post("/learn", json={**other, "replace": True})
    assert replaced.status_code == 200
    assert (replaced.json()["template"], replaced.json()["revision"]) == ("G !holding($1)", 2)


def test_further_examples_settle_an_open_mapping(client: httpx.Client) -> None:
    vague = {"contextual_query": "tour2(library, library)", "ltl": "F (at(robot, library) & F at(robot, library))"}
    clear = {"contextual_query": "tour2(bakery, museum)", "ltl": "F (at(robot, museum) & F at(robot, bakery))"}
    alone = client.post("/learn", json={**vague, "environment": "navigation"})
    check_problem(
        alone,
        "ambiguous-parameter-mapping",
        422,
        ["/contextual_query/arguments/0", "/contextual_query/arguments/1"],
    )
    both = client.post("/learn", json={**vague, "environment": "navigation", "more": [clear]})
    assert both.json()["template"] == "F (at(robot, $2) & F at(robot, $1))"


@pytest.mark.parametrize(
    ("change", "slug", "status", "pointers"),
    [
        ({"ltl": "F (holding(sphere)"}, "formula-syntax", 422, ["/ltl"]),
        ({"ltl": "F" + "(" * 300 + "a" + ")" * 300}, "formula-too-large", 422, ["/ltl"]),
        ({"contextual_query": "hold(sphere"}, "query-syntax", 422, ["/contextual_query"]),
        ({"ltl": "F hugging(sphere)"}, "unknown-proposition", 422, ["/ltl"]),
        ({"ltl": "F holding(moon)"}, "unknown-object", 422, ["/ltl"]),
        ({"contextual_query": "hold(moon)"}, "unknown-object", 422, ["/contextual_query/arguments/0"]),
        ({"ltl": "F holding(kitchen)"}, "type-mismatch", 422, ["/ltl"]),
        ({"contextual_query": "hold(cylinder)"}, "unused-parameter", 422, ["/contextual_query/arguments/0"]),
        (
            {"contextual_query": "hold(sphere, sphere)"},
            "ambiguous-parameter-mapping",
            422,
            ["/contextual_query/arguments/0", "/contextual_query/arguments/1"],
        ),
        (
            {"more": [{"contextual_query": "hold(cylinder)", "ltl": "G holding(cylinder)"}]},
            "inconsistent-examples",
            422,
            ["/more/0/ltl"],
        ),
        ({"examples": ["fetch it", "fetch the sphere"]}, "example-argument-not-found", 422, ["/examples/0"]),
        ({"environment": "atlantis"}, "unknown-environment", 404, ["/environment"]),
        ({"colour": "red"}, "validation", 422, ["/colour"]),
        ({"ltl": 7}, "validation", 422, ["/ltl"]),
        ({"ltl": None}, "validation", 422, ["/ltl"]),
        ({"examples": ["x" * 2001]}, "validation", 422, ["/examples/0"]),
    ],
)
def test_a_refused_lesson_names_its_place_and_stores_nothing(
    client: httpx.Client, snapshot: Snapshot, change: dict[str, Any], slug: str, status: int, pointers: list[str]
) -> None:
    before = snapshot()
    lesson = {"contextual_query": "hold(sphere)", "ltl": "F holding(sphere)", "environment": "toys", **change}
    check_problem(client.post("/learn", json=lesson), slug, status, pointers)
    assert snapshot() == before


def test_a_syntax_error_has_line_column_and_caret(client: httpx.Client) -> None:
    lesson = {"contextual_query": "hold(sphere)", "ltl": "F (holding(sphere) &\n  | X)", "environment": "toys"}
    problem = check_problem(client.post("/learn", json=lesson), "formula-syntax", 422, ["/ltl"])
    assert (problem["line"], problem["column"]) == (2, 3)
    assert problem["caret"] == "  | X)\n  ^"


def test_the_ship_template_comes_with_a_warning(client: httpx.Client) -> None:
    ship = client.get("/templates/ship").json()
    assert ship["template"] == "F (in($1, $2) & F (in($1, $2) & at($2, $3)))"
    assert len(ship["warnings"]) == 1
    assert "equivalent to F (in($1, $2) & at($2, $3))" in ship["warnings"][0]


@pytest.mark.parametrize(
    ("query", "slug", "status", "pointers"),
    [
        ("ship(cylinder, box)", "arity-mismatch", 422, ["/contextual_query"]),
        ("ship(cylinder, box, moon)", "unknown-object", 422, ["/contextual_query/arguments/2"]),
        ("ship(box, cylinder, bedroom)", "type-mismatch", 422, ["/contextual_query/arguments/0"]),
        ("juggle(sphere)", "unknown-template", 404, ["/contextual_query"]),
        ("ship(", "query-syntax", 422, ["/contextual_query"]),
    ],
)
def test_ground_refuses_with_the_place(
    client: httpx.Client, query: str, slug: str, status: int, pointers: list[str]
) -> None:
    response = client.post("/ground", json={"contextual_query": query, "environment": "toys"})
    check_problem(response, slug, status, pointers)


def test_a_template_of_one_domain_needs_the_functions_of_another(client: httpx.Client) -> None:
    response = client.post("/ground", json={"contextual_query": "pickup(library)", "environment": "navigation"})
    check_problem(response, "unknown-proposition", 422, ["/contextual_query"])


def test_a_template_works_in_any_domain_with_its_functions(client: httpx.Client) -> None:
    response = client.post("/ground", json={"contextual_query": "navigate_one(bedroom)", "environment": "toys"})
    assert response.json()["ltl"] == "F at(robot, bedroom)"


def test_an_utterance_of_nothing_but_arguments_is_refused(client: httpx.Client, snapshot: Snapshot) -> None:
    before = snapshot()
    response = learn(client, "gogo(kitchen)", "F at(robot, kitchen)", "kitchen")
    check_problem(response, "example-too-general", 422, ["/examples/0"])
    assert snapshot() == before


def test_replacing_keeps_what_people_say(client: httpx.Client) -> None:
    learn(client, "keep(sphere)", "F holding(sphere)", "keep hold of the sphere")
    body = {"contextual_query": "keep(sphere)", "ltl": "F in(sphere, box)", "environment": "toys", "replace": True}
    assert client.post("/learn", json=body).json()["examples"] == ["keep hold of the sphere"]
    wider = {**body, "contextual_query": "keep(sphere, box)"}
    assert client.post("/learn", json=wider).json()["examples"] == []


def test_names_in_any_script(client: httpx.Client) -> None:
    response = learn(client, "взять(sphere)", "F holding(sphere)")
    assert response.status_code == 201
    location = response.headers["location"]
    assert location.isascii()
    assert client.get(location).json()["task"] == "взять"


def test_utterances_beyond_the_limit_are_refused(client: httpx.Client, snapshot: Snapshot) -> None:
    texts = [f"perform act {number} on the sphere" for number in range(101)]
    assert learn(client, "act(sphere)", "F holding(sphere)", *texts[:50]).status_code == 201
    assert learn(client, "act(sphere)", "F holding(sphere)", *texts[50:100]).status_code == 200
    before = snapshot()
    check_problem(learn(client, "act(sphere)", "F holding(sphere)", texts[100]), "too-many-examples", 422)
    assert snapshot() == before


def test_a_template_too_hard_to_review_is_learned_with_a_word_of_warning(client: httpx.Client) -> None:
    toys = ("cylinder", "sphere", "orange", "bag")
    rooms = ("kitchen", "bedroom", "living_room", "bathroom")
    ltl = " & ".join(f"F at({toy}, {room})" for toy in toys for room in rooms[:3])
    answer = learn(client, "everywhere(cylinder)", ltl)
    assert answer.status_code == 201, answer.text
    assert any("was not checked" in warning for warning in answer.json()["warnings"])
