"""`/translate` over HTTP."""

from __future__ import annotations

from typing import Any

import httpx
import pytest

from tests.service.conftest import check_problem, learn

SHIP = "Put the cylinder in the box, then put the box in the bedroom"
SHIP_LTL = "F (in(cylinder, box) & F (in(cylinder, box) & at(box, bedroom)))"


def test_translates_the_papers_sentences(client: httpx.Client) -> None:
    answer = client.post("/translate", json={"text": SHIP, "environment": "toys"}).json()
    assert answer["outcome"] == "translated"
    assert answer["contextual_query"] == {
        "text": "ship(cylinder, box, bedroom)",
        "operator": None,
        "task": "ship",
        "arguments": ["cylinder", "box", "bedroom"],
        "operands": [],
    }
    assert answer["ltl"] == SHIP_LTL
    assert answer["explanation"] == (
        "eventually the cylinder is in the box, and then the box is in the bedroom while the cylinder is in the box"
    )
    assert 0.9 < answer["confidence"] <= 1
    assert answer["question"] is None
    answer = client.post("/translate", json={"text": "Pickup the sphere", "environment": "toys"}).json()
    assert answer["contextual_query"]["text"] == "pickup(sphere)"
    assert answer["ltl"] == "F holding(sphere)"


def test_without_an_environment_there_is_no_ltl(client: httpx.Client) -> None:
    answer = client.post("/translate", json={"text": SHIP}).json()
    assert answer["contextual_query"]["text"] == "ship(cylinder, box, bedroom)"
    assert answer["ltl"] is None
    assert answer["issues"] == []


def test_a_phrase_that_names_nothing_is_an_issue_with_its_place(client: httpx.Client) -> None:
    answer = client.post("/translate", json={"text": "Pickup the unicorn", "environment": "toys"}).json()
    assert answer["contextual_query"]["text"] == "pickup(unicorn)"
    assert answer["ltl"] is None
    assert [issue["pointer"] for issue in answer["issues"]] == ["/contextual_query/arguments/0"]
    assert "unicorn" in answer["issues"][0]["detail"]


@pytest.mark.parametrize("text", ["what is the weather today?", "asdf qwer", "", "🙂", "\x01\x02", "hello"])
def test_what_fits_no_task_is_unknown(client: httpx.Client, text: str) -> None:
    answer = client.post("/translate", json={"text": text, "environment": "toys"}).json()
    assert answer["outcome"] == "unknown"
    assert answer["contextual_query"] is None
    assert answer["candidates"] == []


def test_case_and_punctuation_change_nothing(client: httpx.Client) -> None:
    def translate(text: str) -> Any:
        return client.post("/translate", json={"text": text, "environment": "toys"}).json()["contextual_query"]

    assert translate(SHIP) == translate(SHIP.upper() + "!!") == translate(SHIP.replace(",", "").lower())


def test_candidates_come_best_first(client: httpx.Client) -> None:
    answer = client.post("/translate", json={"text": SHIP, "environment": "toys", "candidates": 3}).json()
    confidences = [candidate["confidence"] for candidate in answer["candidates"]]
    assert 1 <= len(confidences) <= 3
    assert confidences == sorted(confidences, reverse=True)
    assert answer["candidates"][0]["ltl"] == answer["ltl"]


def test_a_batch_is_its_translations(client: httpx.Client) -> None:
    texts = [SHIP, "Pickup the sphere", "nonsense"]
    answer = client.post("/translate/batch", json={"texts": texts, "environment": "toys"}).json()
    single = [client.post("/translate", json={"text": text, "environment": "toys"}).json() for text in texts]
    assert answer == {"items": single}


def test_equal_requests_get_equal_bytes(client: httpx.Client) -> None:
    body = {"text": SHIP, "environment": "toys", "candidates": 5}
    assert client.post("/translate", json=body).content == client.post("/translate", json=body).content


def test_a_taught_wording_gives_way_where_it_makes_no_sense(client: httpx.Client) -> None:
    assert learn(client, "collect(sphere)", "F holding(sphere)", "go to the sphere").status_code == 201
    taught = client.post("/translate", json={"text": "go to the cylinder", "environment": "toys"}).json()
    assert taught["ltl"] == "F holding(cylinder)"
    other = client.post("/translate", json={"text": "go to the kitchen", "environment": "toys"}).json()
    assert other["contextual_query"]["text"] == "navigate_one(kitchen)"
    assert other["ltl"] == "F at(robot, kitchen)"
    client.delete("/templates/collect")


def test_the_wording_taught_with_two_meanings_is_read_by_what_fits(client: httpx.Client) -> None:
    learn(client, "clean(kitchen)", "F at(robot, kitchen)", "tidy the kitchen")
    learn(client, "tidy_up(sphere)", "F in(sphere, box)", "tidy the sphere")

    def translate(text: str) -> str:
        return str(client.post("/translate", json={"text": text, "environment": "toys"}).json()["ltl"])

    assert translate("tidy the bedroom") == "F at(robot, bedroom)"
    assert translate("tidy the cylinder") == "F in(cylinder, box)"
    for task in ("clean", "tidy_up"):
        client.delete(f"/templates/{task}")


def test_a_wording_with_two_meanings_that_both_fit_is_not_planned(client: httpx.Client) -> None:
    learn(client, "fetch1(sphere)", "F holding(sphere)", "fetch me the sphere")
    learn(client, "fetch2(sphere)", "F in(sphere, box)", "fetch me the sphere")
    body = {"text": "fetch me the cylinder", "environment": "toys"}
    answer = client.post("/translate", json={**body, "candidates": 2}).json()
    assert [candidate["confidence"] for candidate in answer["candidates"]] == [0.5, 0.5]
    problem = check_problem(client.post("/plan", json=body), "ambiguous-command", 422, ["/text"])
    assert problem["choices"] == ["fetch1(cylinder)", "fetch2(cylinder)"]


@pytest.mark.parametrize(
    ("text", "ltl"),
    [
        ("pick up the red toy", "F (holding(cylinder) & colored(cylinder, red))"),
        ("take the toy that is green", "F (holding(sphere) & colored(sphere, green))"),
        ("pick up the orange orange", "F (holding(orange) & colored(orange, orange))"),
    ],
)
def test_attributes_find_the_object(client: httpx.Client, text: str, ltl: str) -> None:
    assert client.post("/translate", json={"text": text, "environment": "toys"}).json()["ltl"] == ltl


def test_warnings_come_with_the_translation(client: httpx.Client) -> None:
    warnings = client.get("/templates/ship").json()["warnings"]
    assert client.post("/translate", json={"text": SHIP, "environment": "toys"}).json()["warnings"] == warnings
    query = {"contextual_query": "ship(cylinder, box, bedroom)", "environment": "toys"}
    assert client.post("/ground", json=query).json()["warnings"] == warnings
    assert client.post("/plan", json=query).json()["warnings"] == warnings


def test_a_misspelt_name_is_understood_and_said_to_be_so(client: httpx.Client) -> None:
    answer = client.post("/translate", json={"text": "Pickup the sphre", "environment": "toys"}).json()
    assert (answer["contextual_query"]["text"], answer["ltl"]) == ("pickup(sphre)", "F holding(sphere)")
    assert answer["bindings"][0]["reason"] == 'a toy named sphere, reading "sphre" as "sphere"'
    planned = client.post("/plan", json={"text": "Pickup the sphre", "environment": "toys"}).json()
    assert (planned["outcome"], planned["bindings"]) == ("solved", answer["bindings"])


def test_a_name_with_two_mistakes_is_only_suggested(client: httpx.Client) -> None:
    response = client.post("/ground", json={"contextual_query": "pickup(clyinde)", "environment": "toys"})
    problem = check_problem(response, "unknown-object", 422, ["/contextual_query/arguments/0"])
    assert "did you mean cylinder?" in problem["detail"]


def test_a_text_of_a_batch_is_named(client: httpx.Client) -> None:
    body = {"texts": ["Pickup the sphere", "go " * 600]}
    check_problem(client.post("/translate/batch", json=body), "text-too-long", 422, ["/texts/1"])


@pytest.mark.parametrize(
    ("text", "ltl"),
    [
        ("never pick up the sphere", "G !holding(sphere)"),
        ("don't pick up the sphere", "G !holding(sphere)"),
        ("Do not go to the kitchen", "G !at(robot, kitchen)"),
        (
            "Pick up the ball, then go to the kitchen, but never go to the bathroom.",
            "F (holding(sphere) & F at(robot, kitchen)) & G !at(robot, bathroom)",
        ),
        ("go to the bedroom or the bathroom", "F at(robot, bedroom) | F at(robot, bathroom)"),
        ("Don't enter the bathroom until you have picked up the cylinder", "!at(robot, bathroom) U holding(cylinder)"),
        ("go to the kitchen again and again", "G F at(robot, kitchen)"),
    ],
)
def test_commands_are_put_together(client: httpx.Client, text: str, ltl: str) -> None:
    answer = client.post("/translate", json={"text": text, "environment": "toys", "candidates": 5}).json()
    assert (answer["outcome"], answer["ltl"]) == ("translated", ltl), answer
    assert answer["contextual_query"]["operator"] is not None
    grounded = client.post("/ground", json={"query": answer["contextual_query"], "environment": "toys"}).json()
    assert (grounded["ltl"], grounded["bindings"]) == (ltl, answer["bindings"])


def test_the_other_meanings_of_avoid_are_offered(client: httpx.Client) -> None:
    body = {"text": "visit the museum but avoid the bridge", "environment": "navigation", "candidates": 5}
    found = [candidate["ltl"] for candidate in client.post("/translate", json=body).json()["candidates"]]
    assert found[0] == "F at(robot, museum) & G !at(robot, bridge)"
    assert {"!at(robot, bridge) U at(robot, museum)", "F (at(robot, museum) & !at(robot, bridge))"} <= set(found)


def test_taught_tasks_are_clauses_too(client: httpx.Client) -> None:
    pair = {"contextual_query": "stow_away(sphere, box)", "ltl": "F in(sphere, box)", "environment": "toys"}
    client.post("/learn", json={**pair, "examples": ["stow the sphere in the box"]}).raise_for_status()
    body = {"text": "pick up the cylinder and then stow it in the crate", "environment": "toys"}
    answer = client.post("/translate", json=body).json()
    assert answer["contextual_query"]["text"] == "then(pickup(cylinder), stow_away(cylinder, crate))"
    client.delete("/templates/stow_away")
    assert answer["ltl"] == "F (holding(cylinder) & F in(cylinder, box))"


def test_a_task_that_is_not_stored_is_unknown(client: httpx.Client) -> None:
    move_to = client.get("/templates/move_to").json()
    assert client.delete("/templates/move_to").status_code == 204
    answer = client.post("/translate", json={"text": "Move to the sphere", "environment": "toys"}).json()
    assert (answer["outcome"], answer["contextual_query"]) == ("unknown", None)
    pair = {name: move_to["pairs"][0][name] for name in ("contextual_query", "ltl", "environment")}
    assert client.post("/learn", json=pair).status_code == 201
    again = client.post("/translate", json={"text": "Move to the sphere", "environment": "toys"}).json()
    assert again["contextual_query"]["text"] == "move_to(sphere)"


@pytest.mark.parametrize("change", [{"candidates": "3"}, {"candidates": True}, {"candidates": 2.5}])
def test_numbers_are_numbers(client: httpx.Client, change: dict[str, Any]) -> None:
    body = {"text": SHIP, "environment": "toys", **change}
    check_problem(client.post("/translate", json=body), "validation", 422, ["/candidates"])


def test_the_part_of_speech_in_the_sentence_decides_between_homonyms(client: httpx.Client) -> None:
    domain = {
        "name": "talks",
        "attributes": {"color": ["orange", "red"], "power": ["up", "down"]},
        "classes": {"robot": {"state": {"on": "power"}}, "thing": {}},
        "constants": {"robot": "robot"},
        "functions": {"about": {"arguments": ["x: thing | color"], "is": "x is thing", "says": "it is about {x}"}},
        "actions": {"wait": {"outcomes": [{}]}},
    }
    spec = {
        "name": "talks",
        "kind": "oomdp",
        "domain_spec": domain,
        "objects": {"orange": {"class": "thing"}, "ball": {"class": "thing"}},
        "state": {"robot": {"on": "up"}},
    }
    assert client.post("/environments", json=spec).status_code == 201
    lesson = learn(client, "talk(ball)", "F about(ball)", "talk to me about the ball", environment="talks")
    assert lesson.status_code == 201, lesson.text
    body = {"text": "talk to me about the orange", "environment": "talks"}
    answer = client.post("/translate", json=body).json()
    assert answer["ltl"] == 'F about("thing.orange")'
    assert client.post("/plan", json=body).json()["outcome"] == "solved"
    asked = client.post("/ground", json={"contextual_query": "talk(orange)", "environment": "talks"})
    problem = check_problem(asked, "ambiguous-grounding", 422, ["/contextual_query/arguments/0"])
    assert problem["choices"] == ["thing.orange", "color.orange"]


@pytest.mark.parametrize(
    ("path", "body", "pointer", "says"),
    [
        ("/translate", {"txt": "go"}, "/txt", 'did you mean "text"?'),
        (
            "/plan",
            {"ltl": "F holding(bag)", "environment": "toys", "options": {"epsilo": 1}},
            "/options/epsilo",
            "epsilon",
        ),
        ("/translate", {"text": "go", "answers": [{"choic": "x"}]}, "/answers/0/choic", 'did you mean "choice"?'),
        ("/plan", {"query": {"operandz": []}, "environment": "toys"}, "/query/operandz", '"operands"'),
        ("/translate", {"text": "go", "xyz": 1}, "/xyz", "there are answers, candidates, environment"),
    ],
)
def test_a_member_that_there_is_not_is_named_with_those_that_there_are(
    client: httpx.Client, path: str, body: dict[str, Any], pointer: str, says: str
) -> None:
    problem = client.post(path, json=body).json()
    assert problem["detail"].startswith(f"{pointer}: there is no such member")
    assert says in problem["detail"]
    assert pointer in [error["pointer"] for error in problem["errors"]]


def test_parts_that_contradict_each_other_are_told(client: httpx.Client) -> None:
    body = {"text": "go to the kitchen but never enter the kitchen", "environment": "toys"}
    assert client.post("/translate", json=body).json()["warnings"] == [
        "the parts contradict each other: no run can do all of this"
    ]
