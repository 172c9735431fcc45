"""Phrases that say where things are, compare them, or speak of several, over HTTP."""

from __future__ import annotations

import httpx

from tests.service.conftest import check_problem, learn, plan
from tests.world.worlds import NURSERY


def post_ground(client: httpx.Client, query: str, **more: object) -> httpx.Response:
    return client.post("/ground", json={"contextual_query": query, "environment": "toys", **more})


def test_ground_shows_the_quantifier_and_all_things(client: httpx.Client) -> None:
    answer = post_ground(client, "pickup(any toy in the bedroom)").json()
    assert answer["ltl"] == "F holding(sphere) | F holding(bag)"
    assert answer["explanation"] == (
        "eventually the robot is holding the sphere, or eventually the robot is holding the bag"
    )
    first, second = ({"name": name, "kind": "toy", "reason": "a toy, in bedroom"} for name in ("sphere", "bag"))
    assert answer["bindings"] == [
        {
            "part": "",
            "argument": 1,
            "phrase": "any toy in the bedroom",
            "quantifier": "any",
            **first,
            "things": [first, second],
        }
    ]
    single = post_ground(client, "pickup(the smallest toy in the bedroom)").json()["bindings"][0]
    assert (single["quantifier"], single["name"]) == ("one", "sphere")
    assert single["things"] == [{key: single[key] for key in ("name", "kind", "reason")}]


def test_ground_goes_by_the_state_sent(client: httpx.Client) -> None:
    query = "pickup(the toy in the kitchen)"
    assert post_ground(client, query).json()["ltl"] == "F holding(orange)"
    moved = {"orange": {"in": "bedroom"}, "bag": {"in": "kitchen"}}
    assert post_ground(client, query, state=moved).json()["ltl"] == "F holding(bag)"
    assert post_ground(client, query).json()["ltl"] == "F holding(orange)", "a state is for one request"


def test_a_state_that_is_none_is_refused(client: httpx.Client) -> None:
    wrong = {"orange": {"in": "nowhere"}}
    check_problem(post_ground(client, "pickup(any toy)", state=wrong), "invalid-state", 422, ["/state/orange/in"])
    body = {"text": "Pickup the sphere", "environment": "toys", "state": wrong}
    check_problem(client.post("/translate", json=body), "invalid-state", 422, ["/state/orange/in"])
    check_problem(client.post("/plan", json=body), "invalid-state", 422, ["/state/orange/in"])
    body = {"texts": ["Pickup the sphere"], "environment": "toys", "state": wrong}
    check_problem(client.post("/translate/batch", json=body), "invalid-state", 422, ["/state/orange/in"])
    check_problem(client.post("/translate", json={"text": "Pickup the sphere", "state": {}}), "validation", 422, [""])


def test_two_of_three_are_asked_for(client: httpx.Client) -> None:
    problem = check_problem(
        post_ground(client, "pickup(both toys in the bedroom)", state={"orange": {"in": "bedroom"}}),
        "ambiguous-grounding",
        422,
        ["/contextual_query/arguments/0"],
    )
    assert problem["choices"] == ["sphere", "orange", "bag"]


def test_too_many_combinations(client: httpx.Client) -> None:
    body = {"contextual_query": "navigate_two(any place, any place)", "environment": "navigation"}
    check_problem(client.post("/ground", json=body), "formula-too-large", 422, ["/contextual_query"])


def test_a_taught_utterance_takes_such_phrases(client: httpx.Client) -> None:
    assert learn(client, "hoist(sphere)", "F holding(sphere)", "hoist the sphere up").is_success

    def translated(text: str, **more: object) -> dict[str, object]:
        answer = client.post("/translate", json={"text": text, "environment": "toys", **more}).json()
        return {key: answer[key] for key in ("outcome", "ltl")}

    assert translated("hoist anything in the bedroom up") == {
        "outcome": "translated",
        "ltl": "F holding(sphere) | F holding(bag)",
    }
    assert translated("hoist all the toys in the bedroom up")["ltl"] == "F holding(sphere) & F holding(bag)"
    assert translated("hoist the smaller toy in the bedroom up")["ltl"] == "F holding(sphere)"
    gone = {"text": "hoist the toy in the kitchen up", "environment": "toys", "state": {"orange": {"in": "box"}}}
    answer = client.post("/translate", json=gone).json()
    assert (answer["ltl"], answer["question"]) == (None, None), "all words are known: there is no use in asking for one"
    assert 'fits "toy in the kitchen"' in answer["issues"][0]["detail"]
    assert translated("hoist a toy up")["outcome"] == "ambiguous"


def test_any_is_planned_as_a_choice_and_every_as_all(client: httpx.Client) -> None:
    """From the kitchen of a row of rooms with one thing to the east, and one further on."""
    world = {**NURSERY, "state": {**NURSERY["state"], "duck": {"in": "bathroom"}}}
    either = plan(client, contextual_query="move_to(any of the boxes)", environment_spec=world)
    both = plan(client, contextual_query="move_to(both boxes)", environment_spec=world)
    assert either["ltl"] == "F near(robot, box) | F near(robot, crate)"
    assert (either["expected_steps"], both["expected_steps"]) == (0, 1)
    assert [thing["name"] for thing in both["bindings"][0]["things"]] == ["box", "crate"]


def test_a_plan_from_another_state_means_the_things_of_that_state(client: httpx.Client) -> None:
    query = "pickup(the toy in the kitchen)"
    here = plan(client, contextual_query=query, environment="toys")
    there = plan(
        client, contextual_query=query, environment="toys", state={"orange": {"in": "box"}, "bag": {"in": "kitchen"}}
    )
    assert (here["ltl"], there["ltl"]) == ("F holding(orange)", "F holding(bag)")
    assert there["initial"]["state"]["bag"] == {"in": "kitchen"}
