"""`/translate`, `/learn`, `/ground` over HTTP."""

from __future__ import annotations

from typing import Any

import httpx
import pytest

from tests.service.conftest import Snapshot, check_problem

SHIP = "Put the cylinder in the box, then put the box in the bedroom"
SHIP_LTL = "F (in(cylinder, box) & F (in(cylinder, box) & at(box, bedroom)))"


def test_translates_the_papers_sentences(client: httpx.Client) -> None:
    answer = client.post("/translate", json={"text": SHIP, "environment": "toys"}).json()
    assert answer["outcome"] == "translated"
    assert answer["contextual_query"] == {
        "text": "ship(cylinder, box, bedroom)",
        "task": "ship",
        "arguments": ["cylinder", "box", "bedroom"],
    }
    assert answer["ltl"] == SHIP_LTL
    assert answer["explanation"] == (
        "eventually cylinder is in box, and then box is at bedroom while cylinder is in box"
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


def test_a_phrase_that_fits_several_is_asked_back(client: httpx.Client) -> None:
    spec = {
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
    created = client.post("/environments", json=spec)
    assert created.status_code == 201, created.text
    text = "Put the sphere in the box, then put the box in the bedroom"
    answer = client.post("/translate", json={"text": text, "environment": "two-boxes"}).json()
    assert answer["outcome"] == "ambiguous"
    assert answer["ltl"] is None
    assert answer["question"] == {"argument": 2, "text": "which box?", "choices": ["small_box", "large_box"]}
    planned = client.post("/plan", json={"text": text, "environment": "two-boxes"})
    problem = check_problem(planned, "ambiguous-command", 422, ["/text"])
    assert problem["choices"] == ["small_box", "large_box"]
    query = {"contextual_query": "ship(sphere, box, bedroom)", "environment": "two-boxes"}
    problem = check_problem(
        client.post("/ground", json=query), "ambiguous-grounding", 422, ["/contextual_query/arguments/1"]
    )
    assert problem["choices"] == ["small_box", "large_box"]


@pytest.mark.parametrize("text", ["what is the weather today?", "asdf qwer", "", "🙂", "\x00\x01", "hello"])
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
        "parameters": [{"position": 1, "type": "toy"}, {"position": 2, "type": "box"}],
        "template": "F in($1, $2)",
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


def learn(client: httpx.Client, query: str, ltl: str, *examples: str, environment: str = "toys") -> httpx.Response:
    body = {"contextual_query": query, "ltl": ltl, "environment": environment, "examples": list(examples)}
    return client.post("/learn", json=body)


def test_an_utterance_of_nothing_but_arguments_is_refused(client: httpx.Client, snapshot: Snapshot) -> None:
    before = snapshot()
    response = learn(client, "gogo(kitchen)", "F at(robot, kitchen)", "kitchen")
    check_problem(response, "example-too-general", 422, ["/examples/0"])
    assert snapshot() == before


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
        ("pick up the green one", "F (holding(sphere) & colored(sphere, green))"),
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


def test_a_misspelt_name_is_suggested(client: httpx.Client) -> None:
    response = client.post("/ground", json={"contextual_query": "pickup(sphre)", "environment": "toys"})
    problem = check_problem(response, "unknown-object", 422, ["/contextual_query/arguments/0"])
    assert "did you mean sphere?" in problem["detail"]


def test_a_text_of_a_batch_is_named(client: httpx.Client) -> None:
    body = {"texts": ["Pickup the sphere", "go " * 600]}
    check_problem(client.post("/translate/batch", json=body), "text-too-long", 422, ["/texts/1"])


@pytest.mark.parametrize("text", ["never pick up the sphere", "don't pick up the sphere", "Do not go to the kitchen"])
def test_a_command_turned_round_is_not_obeyed(client: httpx.Client, text: str) -> None:
    assert client.post("/translate", json={"text": text, "environment": "toys"}).json()["outcome"] == "unknown"
    check_problem(client.post("/plan", json={"text": text, "environment": "toys"}), "not-understood", 422, ["/text"])


def test_a_task_that_is_not_stored_is_unknown(client: httpx.Client) -> None:
    move_to = client.get("/templates/move_to").json()
    assert client.delete("/templates/move_to").status_code == 204
    answer = client.post("/translate", json={"text": "Move to the sphere", "environment": "toys"}).json()
    assert (answer["outcome"], answer["contextual_query"]) == ("unknown", None)
    pair = {name: move_to["pairs"][0][name] for name in ("contextual_query", "ltl", "environment")}
    assert client.post("/learn", json=pair).status_code == 201
    again = client.post("/translate", json={"text": "Move to the sphere", "environment": "toys"}).json()
    assert again["contextual_query"]["text"] == "move_to(sphere)"


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
