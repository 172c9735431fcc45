"""What a command leaves out is asked for, by a service that was taught nothing else."""

from __future__ import annotations

from collections.abc import Iterator

import httpx
import pytest

from benchmarks.server import serving
from tests.service.conftest import check_problem
from tests.service.http.test_questions import ask


@pytest.fixture(scope="module")
def client() -> Iterator[httpx.Client]:
    """Of a server of its own: what others were taught may be meant, too."""
    with serving() as found:
        yield found


@pytest.mark.parametrize(
    ("text", "environment", "choices"),
    [
        ("put the towel in the", "house", {"put_in(towel, basket)", "bring(towel, kitchen)", "bring(towel, bathroom)"}),
        ("Please bring me the red cup", "house", {"bring(red cup, kitchen)", "bring(red cup, bedroom)"}),
        ("switch on", "house", {"switch_on(oven)", "switch_on(washing_machine)"}),
        ("Pick up the", "toys", {"pickup(sphere)", "pickup(bag)"}),
        ("go to the", "house", {"navigate_one(kitchen)", "navigate_one(bathroom)"}),
    ],
)
def test_a_missing_argument_is_asked_for(client: httpx.Client, text: str, environment: str, choices: set[str]) -> None:
    answer = ask(client, text, environment)
    question = answer["question"]
    assert (answer["outcome"], answer["contextual_query"], answer["candidates"]) == ("ambiguous", None, [])
    assert question["about"] == "reading"
    assert set(question["choices"]) >= choices
    assert len(set(question["says"])) == len(question["choices"]) <= 20
    for choice in choices:
        settled = ask(client, text, environment, {"choice": choice})
        assert (settled["outcome"], settled["contextual_query"]["text"]) == ("translated", choice)
        grounded = client.post("/ground", json={"contextual_query": choice, "environment": environment}).json()
        assert settled["ltl"] == grounded["ltl"]


def test_what_may_be_too_many_things_is_not_asked_for(client: httpx.Client) -> None:
    answer = ask(client, "go to", "navigation")
    assert (answer["outcome"], answer["question"]) == ("unknown", None)
    assert "navigate_one" in answer["nearest"]


@pytest.mark.parametrize(
    ("text", "environment"), [("stop", "warehouse"), ("Pick up a letter at the post office", "city")]
)
def test_nothing_is_asked_for_where_nothing_makes_sense(client: httpx.Client, text: str, environment: str) -> None:
    """What the task is about is not there at all."""
    answer = ask(client, text, environment)
    assert (answer["outcome"], answer["question"]) == ("unknown", None)


def test_a_plan_is_not_made_for_a_command_that_leaves_something_out(client: httpx.Client) -> None:
    body = {"text": "bring the towel", "environment": "house"}
    problem = check_problem(client.post("/plan", json=body), "ambiguous-command", 422, ["/text"])
    assert "bring(towel, bathroom)" in problem["choices"]
    planned = client.post("/plan", json=body | {"answers": [{"choice": "bring(towel, bathroom)"}]}).json()
    assert (planned["outcome"], planned["ltl"]) == ("solved", "F at(towel, bathroom)")
    wrong = client.post("/plan", json=body | {"answers": [{"choice": "bring(towel, moon)"}]})
    check_problem(wrong, "wrong-answer", 422, ["/answers/0/choice"])


@pytest.mark.parametrize(
    "text", ["hello", "bring the unicorn", "wash the towel", "towel", "take a nap", "what is in the", "me"]
)
def test_nothing_is_asked_where_no_task_is_begun(client: httpx.Client, text: str) -> None:
    assert ask(client, text, "house")["outcome"] == "unknown"
