"""Every built-in world has commands to try and a task to teach, and they work as they stand."""

from __future__ import annotations

from collections.abc import Iterator

import httpx
import pytest

from benchmarks.server import serving
from models.world import builtin_environments
from tests.service.conftest import plan

WORLDS = dict(builtin_environments())
SAMPLES = [(name, text) for name, data in WORLDS.items() for text in data["samples"]]
LESSONS = [(name, lesson) for name, data in WORLDS.items() for lesson in data["lessons"]]


@pytest.fixture(scope="module")
def client() -> Iterator[httpx.Client]:
    """A server of its own, which knows nothing but what comes with it."""
    with serving() as found:
        yield found


def test_every_world_has_five_samples_and_a_lesson_which_are_listed(client: httpx.Client) -> None:
    listed = {
        item["name"]: item["samples"] for item in client.get("/environments", params={"limit": 200}).json()["items"]
    }
    for name, data in WORLDS.items():
        assert len(set(data["samples"])) == 5
        assert listed[name] == data["samples"] == client.get(f"/environments/{name}").json()["spec"]["samples"]
    assert {name for name, _ in LESSONS} == set(WORLDS)


@pytest.mark.parametrize(("name", "text"), SAMPLES)
def test_a_sample_is_understood_without_a_question_and_can_be_done(client: httpx.Client, name: str, text: str) -> None:
    said = client.post("/translate", json={"text": text, "environment": name}).json()
    assert (said["outcome"], said["question"], said["issues"]) == ("translated", None, [])
    answer = plan(client, text=text, environment=name)
    assert answer["ltl"] == said["ltl"]
    assert answer["outcome"] == "solved"
    assert answer["probability"]["lower"] > 0
    assert len(answer["trajectory"]) > 1, "something is to be seen"


@pytest.mark.parametrize(("name", "lesson"), LESSONS)
def test_a_sample_lesson_teaches_its_utterance(client: httpx.Client, name: str, lesson: dict[str, str]) -> None:
    body = {"contextual_query": lesson["contextual_query"], "ltl": lesson["ltl"], "environment": name}
    learned = client.post("/learn", json={**body, "examples": [lesson["text"]]})
    assert learned.status_code in (200, 201), learned.text
    said = client.post("/translate", json={"text": lesson["text"], "environment": name}).json()
    assert (said["outcome"], said["ltl"], said["confidence"]) == ("translated", lesson["ltl"], 1.0)
    assert plan(client, text=lesson["text"], environment=name)["outcome"] == "solved"
