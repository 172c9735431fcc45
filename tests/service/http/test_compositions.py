"""Composed queries over HTTP: as text, in parts, grounded and planned."""

from __future__ import annotations

from typing import Any

import httpx
import pytest

from tests.service.conftest import check_problem

TEXT = "and(then(pickup(ball), move_to(kitchen)), avoid(move_to(bathroom)))"
TREE = {
    "operator": "and",
    "operands": [
        {
            "operator": "then",
            "operands": [
                {"task": "pickup", "arguments": ["ball"]},
                {"task": "move_to", "arguments": ["kitchen"]},
            ],
        },
        {"operator": "avoid", "operands": [{"task": "move_to", "arguments": ["bathroom"]}]},
    ],
}
LTL = "F (holding(sphere) & F near(robot, kitchen)) & G !near(robot, bathroom)"


def test_a_composition_is_grounded_as_text_and_in_parts(client: httpx.Client) -> None:
    as_text = client.post("/ground", json={"contextual_query": TEXT, "environment": "toys"}).json()
    in_parts = client.post("/ground", json={"query": TREE, "environment": "toys"}).json()
    assert as_text == in_parts
    assert as_text["ltl"] == LTL
    assert [(b["part"], b["argument"], b["phrase"], b["name"]) for b in as_text["bindings"]] == [
        ("/operands/0/operands/0", 1, "ball", "sphere"),
        ("/operands/0/operands/1", 1, "kitchen", "kitchen"),
        ("/operands/1/operands/0", 1, "bathroom", "bathroom"),
    ]
    assert as_text["contextual_query"]["text"] == TEXT
    sent_back = client.post("/ground", json={"query": as_text["contextual_query"], "environment": "toys"}).json()
    assert sent_back == as_text


def test_a_composition_is_planned(client: httpx.Client) -> None:
    plan = client.post("/plan", json={"query": TREE, "environment": "toys"}).json()
    assert plan["outcome"] == "solved"
    assert plan["ltl"] == LTL
    assert plan["contextual_query"]["text"] == TEXT
    rooms = [step["state"]["robot"]["at"] for step in plan["trajectory"]]
    assert "bathroom" not in rooms
    assert plan["trajectory_complete"] or plan["trajectory_loop"] is not None


@pytest.mark.parametrize(
    ("tree", "slug", "pointer"),
    [
        ({"operator": "then", "operands": [TREE]}, "query-syntax", "/query"),
        (
            {"operator": "avoid", "operands": [{"operator": "or", "operands": []}]},
            "query-syntax",
            "/query/operands/0",
        ),
        (
            {"operator": "repeat", "operands": [{"task": "pickup", "arguments": ["ghost"]}]},
            "unknown-object",
            "/query/operands/0/arguments/0",
        ),
        (
            {"operator": "repeat", "operands": [{"task": "pickup", "arguments": ["a", "b"]}]},
            "arity-mismatch",
            "/query/operands/0",
        ),
        (
            {"operator": "then", "operands": [{"operator": "repeat", "operands": [TREE["operands"][0]]}, TREE]},
            "impossible-composition",
            "/query",
        ),
        ({"task": "no such"}, "query-syntax", "/query"),
        ({"task": "pickup", "operator": "then"}, "validation", "/query"),
        ({}, "validation", "/query"),
        ({"operator": "then", "arguments": ["x"]}, "validation", "/query"),
        ({"operator": "xor"}, "validation", "/query/operator"),
    ],
)
def test_what_is_wrong_in_a_composition_has_its_place(
    client: httpx.Client, tree: dict[str, Any], slug: str, pointer: str
) -> None:
    for path in ("/ground", "/plan"):
        answer = client.post(path, json={"query": tree, "environment": "toys"})
        check_problem(answer, slug, 422, [pointer])


def test_a_task_that_is_not_stored(client: httpx.Client) -> None:
    answer = client.post("/ground", json={"contextual_query": "repeat(juggle(ball))", "environment": "toys"})
    check_problem(answer, "unknown-template", 404)


def test_exactly_one_form_of_a_query(client: httpx.Client) -> None:
    for body in ({}, {"contextual_query": TEXT, "query": TREE}):
        check_problem(client.post("/ground", json={"environment": "toys", **body}), "validation", 422)


def test_a_composition_is_not_taught(client: httpx.Client) -> None:
    body = {"contextual_query": TEXT, "ltl": "F holding(sphere)", "environment": "toys"}
    check_problem(client.post("/learn", json=body), "query-syntax", 422, ["/contextual_query"])


def test_a_question_names_the_part_in_doubt(client: httpx.Client) -> None:
    answer = client.post("/translate", json={"text": "go to the kitchen, then pick up the toy", "environment": "toys"})
    question = answer.json()["question"]
    assert (question["part"], question["argument"]) == ("/operands/1", 1)
    assert {"cylinder", "sphere"} <= set(question["choices"])
