"""The paper's three systems behind `/translate` and `/plan`."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import httpx
import pytest

from tests.service.conftest import check_problem, learn, run_here

SHIP = "Put the cylinder in the box, then put the box in the bedroom"
SHIP_LTL = "F (in(cylinder, box) & F (in(cylinder, box) & at(box, bedroom)))"


def translate(client: httpx.Client, translator: str, text: str, **members: Any) -> Any:
    response = client.post("/translate", json={"text": text, "translator": translator, **members})
    assert response.status_code == 200, response.text
    return response.json()


@pytest.mark.parametrize("translator", ["cq-copynet", "cq-copynet-pos"])
def test_systems_of_contextual_queries(client: httpx.Client, translator: str) -> None:
    answer = translate(client, translator, SHIP, environment="toys")
    assert answer["outcome"] == "translated"
    assert answer["contextual_query"]["text"] == "ship(cylinder, box, bedroom)"
    assert answer["ltl"] == SHIP_LTL
    assert 0.5 < answer["confidence"] <= 1
    assert translate(client, translator, SHIP)["ltl"] is None


def test_the_system_of_formulas_has_no_contextual_query(client: httpx.Client) -> None:
    answer = translate(client, "ltl-copynet", SHIP, environment="toys", candidates=2)
    assert (answer["outcome"], answer["contextual_query"], answer["ltl"]) == ("translated", None, SHIP_LTL)
    assert answer["explanation"] == (
        "eventually the cylinder is in the box, and then the box is in the bedroom while the cylinder is in the box"
    )
    assert 0.5 < answer["confidence"] <= 1
    assert (answer["bindings"], answer["warnings"], answer["issues"], answer["question"]) == ([], [], [], None)
    assert answer["candidates"][0]["ltl"] == SHIP_LTL
    assert len(answer["candidates"]) == 2


def test_without_an_environment_a_formula_is_as_the_network_wrote_it(client: httpx.Client) -> None:
    answer = translate(client, "ltl-copynet", SHIP)
    assert (answer["contextual_query"], answer["ltl"]) == (None, SHIP_LTL)
    assert answer["explanation"] is None


def test_a_formula_that_the_environment_cannot_resolve_is_an_issue(client: httpx.Client) -> None:
    answer = translate(client, "ltl-copynet", SHIP, environment="navigation")
    assert (answer["outcome"], answer["ltl"]) == ("translated", None)
    (issue,) = answer["issues"]
    assert issue["pointer"] == "/ltl"
    assert "propositional function" in issue["detail"]
    problem = check_problem(
        client.post("/plan", json={"text": SHIP, "translator": "ltl-copynet", "environment": "navigation"}),
        "unknown-proposition",
        422,
        ["/text"],
    )
    assert problem["detail"]


@pytest.mark.parametrize("translator", ["cq-copynet", "cq-copynet-pos", "ltl-copynet"])
def test_each_can_be_planned_with(client: httpx.Client, translator: str) -> None:
    body = {"text": SHIP, "translator": translator, "environment": "toys"}
    answer = client.post("/plan", json=body).json()
    assert (answer["outcome"], answer["ltl"]) == ("solved", SHIP_LTL)
    query = None if answer["contextual_query"] is None else answer["contextual_query"]["text"]
    assert query == (None if translator == "ltl-copynet" else "ship(cylinder, box, bedroom)")
    assert len(answer["bindings"]) == (0 if translator == "ltl-copynet" else 3)


def test_taught_wordings_are_the_defaults_alone(client: httpx.Client) -> None:
    learn(client, "wave(sphere)", "F near(robot, sphere)", "wave at the sphere")
    assert translate(client, "default", "wave at the cylinder")["contextual_query"]["text"] == "wave(cylinder)"
    for translator in ("cq-copynet", "cq-copynet-pos"):
        found = translate(client, translator, "wave at the cylinder", candidates=5)["candidates"]
        assert all(candidate["contextual_query"]["task"] != "wave" for candidate in found)


def test_a_wrong_number_of_arguments_is_an_issue(client: httpx.Client) -> None:
    """Parts of speech find what is named, not what the task takes: here one noun too many."""
    answer = translate(client, "cq-copynet-pos", "pick up the sphere near the box", environment="toys")
    assert answer["ltl"] is None
    (issue,) = answer["issues"]
    assert issue["pointer"] == "/contextual_query"
    assert "arguments, not" in issue["detail"]


@pytest.mark.parametrize("translator", ["best", "", "CQ-CopyNet"])
def test_no_other_translator_is_known(client: httpx.Client, translator: str) -> None:
    for path in ("/translate", "/plan"):
        body = {"text": SHIP, "translator": translator, "environment": "toys"}
        check_problem(client.post(path, json=body), "validation", 422, ["/translator"])


def test_the_command_line_chooses_too(client: httpx.Client, tmp_path: Path) -> None:
    options = ["--environment", "toys", "--translator", "ltl-copynet", "--server", str(client.base_url)]
    translated = run_here("translate", SHIP, *options, data=tmp_path)
    assert json.loads(translated.stdout) == translate(client, "ltl-copynet", SHIP, environment="toys", candidates=1)
    planned = run_here("plan", SHIP, *options, data=tmp_path)
    assert json.loads(planned.stdout)["ltl"] == SHIP_LTL
    wrong = run_here("translate", SHIP, "--translator", "best", "--server", str(client.base_url), data=tmp_path)
    assert (wrong.returncode, "validation" in wrong.stderr) == (1, True)
