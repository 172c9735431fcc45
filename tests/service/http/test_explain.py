"""`/explain` over HTTP, and the words that a task is read back in."""

from __future__ import annotations

from typing import Any

import httpx
import pytest

from tests.service.conftest import Snapshot, check_problem

PATROL = "G F at(robot, kitchen) & G F at(robot, bathroom)"


def explain(client: httpx.Client, **body: Any) -> dict[str, Any]:
    response = client.post("/explain", json=body)
    assert response.status_code == 200, response.text
    answer: dict[str, Any] = response.json()
    return answer


def teach(client: httpx.Client, task: str, **more: Any) -> httpx.Response:
    body = {"contextual_query": f"{task}(sphere, box)", "ltl": "F in(sphere, box)", "environment": "toys", **more}
    return client.post("/learn", json=body)


def test_a_formula_in_an_environment(client: httpx.Client) -> None:
    assert explain(client, ltl="F (cylinder_in_box & F at(box, bedroom)) & G !holding(sphere)", environment="toys") == {
        "contextual_query": None,
        "ltl": "F (in(cylinder, box) & F at(box, bedroom)) & G !holding(sphere)",
        "explanation": "eventually the cylinder is in the box, and then the box is in the bedroom; "
        "and the robot is never holding the sphere",
        "reading": "eventually the cylinder is in the box, and then the box is in the bedroom; "
        "and the robot is never holding the sphere",
        "kind": {"name": "obligation", "explanation": "combines what can be finished with what must be kept for ever"},
        "parts": [
            {
                "part": None,
                "ltl": "F (in(cylinder, box) & F at(box, bedroom))",
                "explanation": "eventually the cylinder is in the box, and then the box is in the bedroom",
                "parts": [
                    {
                        "part": None,
                        "ltl": "in(cylinder, box)",
                        "explanation": "the cylinder is in the box",
                        "parts": [],
                    },
                    {
                        "part": None,
                        "ltl": "F at(box, bedroom)",
                        "explanation": "eventually the box is in the bedroom",
                        "parts": [],
                    },
                ],
            },
            {
                "part": None,
                "ltl": "G !holding(sphere)",
                "explanation": "the robot is never holding the sphere",
                "parts": [],
            },
        ],
        "warnings": [],
    }


def test_a_formula_without_an_environment_is_read_as_written(client: httpx.Client) -> None:
    answer = explain(client, ltl="!wet(floor_2) U in($1, $2)")
    assert answer["reading"] == "eventually in($1, $2) holds, and until then wet(floor_2) does not hold"
    assert answer["kind"]["name"] == "guarantee"
    assert [part["ltl"] for part in answer["parts"]] == ["!wet(floor_2)", "in($1, $2)"]


@pytest.mark.parametrize(
    ("ltl", "kind"),
    [
        (PATROL, "recurrence"),
        ("F G at(robot, kitchen)", "persistence"),
        ("G !holding(sphere)", "safety"),
        ("F holding(sphere) & G !holding(sphere)", "never"),
    ],
)
def test_the_kind_of_a_formula(client: httpx.Client, ltl: str, kind: str) -> None:
    assert explain(client, ltl=ltl, environment="toys")["kind"]["name"] == kind


def test_a_formula_too_large_to_classify_is_read_all_the_same(client: httpx.Client) -> None:
    answer = explain(client, ltl=" & ".join(f"F x{number}" for number in range(30)))
    assert answer["kind"] is None
    assert answer["reading"].startswith("eventually x0 holds, and eventually x1 holds")
    assert "could not be told" in answer["warnings"][0]
    assert len(answer["parts"]) == 30


def test_a_query_is_read_as_its_formula_until_words_are_taught(client: httpx.Client) -> None:
    assert teach(client, "tuck").json()["explanation"] == "eventually {1} is in {2}"
    query = "then(tuck(the cylinder, box), move_to(kitchen))"
    plain = explain(client, contextual_query=query, environment="toys")
    assert plain["explanation"] == plain["reading"]
    assert plain["reading"] == "eventually the cylinder is in the box, and then the robot is at the kitchen"
    taught = teach(client, "tuck", explanation="the {1} ends up in the {2}.").json()
    assert (taught["explanation"], taught["reading"]) == ("the {1} ends up in the {2}", "eventually {1} is in {2}")
    assert taught["revision"] == 2
    assert client.get("/templates/tuck").json() == taught
    assert teach(client, "tuck").json() == taught
    answer = explain(client, contextual_query=query, environment="toys")
    assert answer["reading"] == plain["reading"]
    said = "the cylinder ends up in the box, and then the robot is at the kitchen"
    assert answer["explanation"] == said
    assert [(part["part"], part["ltl"], part["explanation"]) for part in answer["parts"]] == [
        ("/operands/0", "F in(cylinder, box)", "the cylinder ends up in the box"),
        ("/operands/1", "F near(robot, kitchen)", "eventually the robot is at the kitchen"),
    ]
    grounded = client.post("/ground", json={"contextual_query": query, "environment": "toys"}).json()
    assert grounded["explanation"] == said
    assert explain(client, query=grounded["contextual_query"], environment="toys") == answer
    planned = client.post("/plan", json={"contextual_query": query, "environment": "toys"}).json()
    assert planned["explanation"] == said
    assert (
        client.post("/plan", json={"ltl": planned["ltl"], "environment": "toys"}).json()["explanation"]
        == (plain["reading"])
    )


def test_a_command_is_read_back_in_the_words_that_were_taught(client: httpx.Client) -> None:
    words = {"explanation": "the {1} is shelved in the {2}", "examples": ["shelve the sphere in the box"]}
    assert teach(client, "shelve", **words).status_code == 201
    answer = client.post("/translate", json={"text": "Shelve the cylinder in the box!", "environment": "toys"}).json()
    assert answer["explanation"] == "the cylinder is shelved in the box"


def test_without_an_environment_phrases_stand_in_the_template(client: httpx.Client) -> None:
    teach(client, "nest", explanation="the {1} rests in the {2}")
    answer = explain(client, contextual_query="and(nest(a tiny egg, basket), avoid(pickup(fox)))")
    assert answer["ltl"] == 'F in("a tiny egg", basket) & G !holding(fox)'
    assert answer["explanation"] == (
        "the tiny egg rests in the basket, and it never happens that eventually the robot is holding fox"
    )
    assert answer["reading"] == 'eventually in("a tiny egg", basket) holds, and holding(fox) never holds'


def test_another_template_does_not_keep_the_words(client: httpx.Client) -> None:
    teach(client, "fetch_back", explanation="the {1} gets into the {2}")
    replaced = teach(client, "fetch_back", ltl="G !in(sphere, box)", replace=True).json()
    assert replaced["explanation"] == replaced["reading"] == "{1} is never in {2}"


@pytest.mark.parametrize(
    ("words", "detail"),
    [
        ("the {1} ends up in the {3}", "character 24: {3} is no argument"),
        ("the {1} is put away", "{2} is missing"),
        ("put {1} in {2", "a lone {"),
        ("  ", "1 to 500 characters"),
    ],
)
def test_words_that_do_not_say_the_task_are_refused(
    client: httpx.Client, snapshot: Snapshot, words: str, detail: str
) -> None:
    before = snapshot()
    problem = check_problem(teach(client, "wrong", explanation=words), "invalid-explanation", 422, ["/explanation"])
    assert detail in problem["detail"]
    assert snapshot() == before


@pytest.mark.parametrize(
    ("body", "slug", "status", "pointers"),
    [
        ({}, "validation", 422, [""]),
        ({"ltl": "F a", "contextual_query": "pickup(ball)"}, "validation", 422, [""]),
        ({"ltl": "F (a", "environment": "toys"}, "formula-syntax", 422, ["/ltl"]),
        ({"ltl": "F (a"}, "formula-syntax", 422, ["/ltl"]),
        ({"ltl": "F flies(sphere)", "environment": "toys"}, "unknown-proposition", 422, ["/ltl"]),
        ({"ltl": "F holding(ghost)", "environment": "toys"}, "unknown-object", 422, ["/ltl"]),
        ({"ltl": "F holding($1)", "environment": "toys"}, "unknown-object", 422, ["/ltl"]),
        ({"ltl": "F a", "environment": "atlantis"}, "unknown-environment", 404, ["/environment"]),
        ({"contextual_query": "pickup(ball"}, "query-syntax", 422, ["/contextual_query"]),
        ({"contextual_query": "pickup(ghost)", "environment": "toys"}, "unknown-object", 422, None),
        ({"contextual_query": "pickup(a, b)"}, "arity-mismatch", 422, ["/contextual_query"]),
        ({"contextual_query": "then(avoid(pickup(a)), pickup(b))"}, "impossible-composition", 422, None),
        ({"contextual_query": "juggle(ball)"}, "unknown-template", 404, ["/contextual_query"]),
        (
            {"query": {"operator": "repeat", "operands": [{"task": "pickup", "arguments": []}]}},
            "arity-mismatch",
            422,
            ["/query/operands/0"],
        ),
        ({"text": "pick up the ball"}, "validation", 422, None),
    ],
)
def test_refusals_have_their_place(
    client: httpx.Client, body: dict[str, Any], slug: str, status: int, pointers: list[str] | None
) -> None:
    check_problem(client.post("/explain", json=body), slug, status, pointers)


def test_the_tasks_that_are_there_at_first_can_be_read(client: httpx.Client) -> None:
    read = {
        task: client.get(f"/templates/{task}").json()["explanation"]
        for task in ("pickup", "ship", "navigate_two", "pickup_colored")
    }
    assert read == {
        "pickup": "eventually the robot is holding {1}",
        "ship": "eventually {1} is in {2}, and then {2} is in {3} while {1} is in {2}",
        "navigate_two": "eventually the robot is at {1}, and then the robot is at {2}",
        "pickup_colored": "eventually both the robot is holding {1} and {1} is {2}",
    }
