"""Asking back: questions with choices, and their answers, through `/translate` and `/plan`."""

from __future__ import annotations

from typing import Any

import httpx
import pytest

from tests.service.conftest import check_problem, learn

SHIP = "Put the sphere in the box, then put the box in the bedroom"
TWO_BOXES = {
    "name": "two-boxes",
    "kind": "oomdp",
    "domain": "toys",
    "grid": {"class": "cell", "map": ["KB"], "names": {"K": "kitchen", "B": "bedroom"}},
    "objects": {
        "small_box": {"class": "box"},
        "large_box": {"class": "box"},
        "sphere": {"class": "toy", "attributes": {"color": "red", "shape": "sphere"}},
    },
    "state": {
        "robot": {"at": "kitchen"},
        "small_box": {"in": "kitchen"},
        "large_box": {"in": "bedroom"},
        "sphere": {"in": "kitchen"},
    },
}


@pytest.fixture(scope="module")
def two_boxes(client: httpx.Client) -> str:
    created = client.put("/environments/two-boxes", json=TWO_BOXES)
    assert created.status_code in (200, 201), created.text
    return "two-boxes"


def ask(client: httpx.Client, text: str, environment: str, *answers: dict[str, Any]) -> dict[str, Any]:
    body = {"text": text, "environment": environment, "answers": list(answers)}
    found: dict[str, Any] = client.post("/translate", json=body).json()
    return found


def test_a_phrase_that_fits_several_is_asked_back(client: httpx.Client, two_boxes: str) -> None:
    answer = ask(client, SHIP, two_boxes)
    assert (answer["outcome"], answer["ltl"]) == ("ambiguous", None)
    assert answer["question"] == {
        "about": "thing",
        "part": "",
        "argument": 2,
        "text": "which box?",
        "choices": ["small_box", "large_box"],
        "says": ["small box: a box", "large box: a box"],
    }
    problem = check_problem(
        client.post("/plan", json={"text": SHIP, "environment": two_boxes}), "ambiguous-command", 422, ["/text"]
    )
    assert problem["choices"] == ["small_box", "large_box"]
    assert problem["question"] == answer["question"]
    query = {"contextual_query": "ship(sphere, box, bedroom)", "environment": two_boxes}
    problem = check_problem(
        client.post("/ground", json=query), "ambiguous-grounding", 422, ["/contextual_query/arguments/1"]
    )
    assert problem["choices"] == ["small_box", "large_box"]


def test_an_answer_settles_the_question(client: httpx.Client, two_boxes: str) -> None:
    chosen = {"choice": "large_box", "argument": 2}
    answer = ask(client, SHIP, two_boxes, chosen)
    assert (answer["outcome"], answer["question"]) == ("translated", None)
    assert answer["contextual_query"]["text"] == "ship(sphere, large_box, bedroom)"
    planned = client.post("/plan", json={"text": SHIP, "environment": two_boxes, "answers": [chosen]}).json()
    assert (planned["outcome"], planned["ltl"]) == ("solved", answer["ltl"])


@pytest.mark.parametrize(
    ("world", "text"),
    [("", SHIP), ("city", "visit the zoo twice"), ("house", "switch on the")],  # a thing, a reading, what is left out
)
def test_none_of_the_choices_may_be_right(client: httpx.Client, two_boxes: str, world: str, text: str) -> None:
    environment = world or two_boxes
    assert ask(client, text, environment)["outcome"] == "ambiguous"
    answer = ask(client, text, environment, {"choice": None})
    assert (answer["outcome"], answer["question"], answer["candidates"]) == ("unknown", None, [])
    assert len(answer["nearest"]) == 3
    body = {"text": text, "environment": environment, "answers": [{"choice": None}]}
    check_problem(client.post("/plan", json=body), "not-understood", 422, ["/text"])
    more = {**body, "answers": [{"choice": None}, {"choice": None}]}
    check_problem(client.post("/translate", json=more), "wrong-answer", 422, ["/answers/1"])


def test_an_unknown_word_is_asked_about_with_what_makes_sense_in_its_place(client: httpx.Client) -> None:
    answer = ask(client, "pick up the gizmo", "toys")
    assert answer["outcome"] == "ambiguous"
    question = answer["question"]
    assert (question["about"], question["argument"], question["text"]) == ("thing", 1, 'what is "gizmo"?')
    assert set(question["choices"]) >= {"sphere", "cylinder", "orange", "bag"}
    assert "kitchen" not in question["choices"]
    assert question["says"][question["choices"].index("cylinder")] == "cylinder: a toy, red, small"
    chosen = {"choice": "bag", "argument": 1}
    assert ask(client, "pick up the gizmo", "toys", chosen)["ltl"] == "F holding(bag)"


def test_an_unknown_word_within_a_composition(client: httpx.Client) -> None:
    text = "pick up the gizmo and then go to the kitchen"
    question = ask(client, text, "toys")["question"]
    assert (question["part"], question["argument"]) == ("/operands/0", 1)
    answer = ask(client, text, "toys", {"choice": "bag", "part": "/operands/0", "argument": 1})
    assert answer["ltl"] == "F (holding(bag) & F at(robot, kitchen))"


def test_an_unknown_word_is_asked_about_in_other_worlds_than_the_task_was_taught_in(client: httpx.Client) -> None:
    question = ask(client, "go to the frobnicator", "house")["question"]
    assert set(question["choices"]) >= {"kitchen", "bathroom"}


def test_how_often_is_not_passed_over(client: httpx.Client) -> None:
    text = "Visit the museum twice"
    answer = ask(client, text, "city")
    assert (answer["outcome"], answer["contextual_query"]["text"]) == ("ambiguous", "navigate_one(museum)")
    assert '"twice" is not understood' in answer["question"]["text"]
    assert ask(client, text, "city", {"choice": "navigate_one(museum)"})["outcome"] == "translated"
    taught = {"contextual_query": "visit_twice(museum)", "ltl": "F (at(robot, museum) & X F at(robot, museum))"}
    client.post("/learn", json={**taught, "environment": "city", "examples": [text]}).raise_for_status()
    assert ask(client, "visit the zoo twice", "city")["outcome"] == "translated"
    client.delete("/templates/visit_twice")


def test_conditions_are_not_passed_over(client: httpx.Client) -> None:
    question = ask(client, "Go to the zoo if it is open", "city")["question"]
    assert question["text"] == '"if it is open" is not understood; do you mean: eventually the robot is at the zoo?'
    assert ask(client, "Go to the zoo if it is no trouble", "city")["outcome"] == "translated"


def test_what_undoes_a_task_does_not_pass_for_it(client: httpx.Client) -> None:
    learn(client, "lock_away(sphere)", "F in(sphere, box)", "lock the sphere away")
    assert ask(client, "lock the cylinder away", "toys")["outcome"] == "translated"
    assert ask(client, "unlock the cylinder", "toys")["outcome"] != "translated"
    client.delete("/templates/lock_away")
    question = ask(client, "exit the kitchen", "toys")["question"]
    assert question["text"].startswith('"exit" is the contrary of "navigate"; do you mean: ')


def test_two_meanings_of_a_taught_wording_are_asked_about(client: httpx.Client) -> None:
    learn(client, "fetch1(sphere)", "F holding(sphere)", "fetch me the sphere")
    learn(client, "fetch2(sphere)", "F in(sphere, box)", "fetch me the sphere")
    answer = ask(client, "fetch me the cylinder", "toys")
    assert (answer["outcome"], answer["confidence"]) == ("ambiguous", 0.5)
    question = answer["question"]
    assert (question["about"], question["argument"]) == ("reading", None)
    assert question["choices"] == ["fetch1(cylinder)", "fetch2(cylinder)"]
    assert len(question["says"]) == 2
    settled = ask(client, "fetch me the cylinder", "toys", {"choice": "fetch2(cylinder)"})
    assert (settled["outcome"], settled["ltl"]) == ("translated", "F in(cylinder, box)")
    for task in ("fetch1", "fetch2"):
        client.delete(f"/templates/{task}")


@pytest.mark.parametrize(
    ("answers", "pointer"),
    [
        ([{"choice": "kitchen", "argument": 2}], "/answers/0/choice"),
        ([{"choice": "large_box", "argument": 1}], "/answers/0/argument"),
        ([{"choice": "large_box", "argument": 2, "part": "/operands/0"}], "/answers/0/argument"),
        ([{"choice": "large_box", "argument": 2}, {"choice": "large_box", "argument": 2}], "/answers/1"),
    ],
)
def test_an_answer_to_another_question_is_refused(
    client: httpx.Client, two_boxes: str, answers: list[dict[str, Any]], pointer: str
) -> None:
    body = {"text": SHIP, "environment": two_boxes, "answers": answers}
    check_problem(client.post("/translate", json=body), "wrong-answer", 422, [pointer])
    check_problem(client.post("/plan", json=body), "wrong-answer", 422, [pointer])


def test_answers_belong_to_a_text(client: httpx.Client) -> None:
    body = {"ltl": "F holding(bag)", "environment": "toys", "answers": [{"choice": "bag"}]}
    check_problem(client.post("/plan", json=body), "validation", 422)
