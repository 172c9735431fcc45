"""Answers that are given the short way: the bytes of the long one, and never old ones."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import httpx
import pytest

from benchmarks.server import serving
from models.world import toys_spec
from tests.service.conftest import learn, plan
from tests.service.postgres import Postgres

LONG = "application/x+json"
"""As good as JSON, and not what the short way is for."""
TEXTS = [
    {"text": "Put the cylinder in the box, then put the box in the bedroom", "environment": "toys"},
    {"text": "Pickup the sphere"},
    {"text": "pick up the gizmo", "environment": "toys"},
    {"text": "qwx zzy", "environment": "toys", "candidates": 3},
    {"text": "go to the kitchen", "translator": "ltl-copynet"},
]


def post(client: httpx.Client, path: str, body: Any, kind: str = "application/json") -> httpx.Response:
    return client.post(path, content=json.dumps(body), headers={"Content-Type": kind})


def same(found: httpx.Response, expected: httpx.Response) -> bool:
    """All but the request's id."""
    headers = [{k: v for k, v in response.headers.items() if k != "x-request-id"} for response in (found, expected)]
    for each in headers:
        each.pop("date")
    return (found.status_code, found.content, headers[0]) == (expected.status_code, expected.content, headers[1])


@pytest.mark.parametrize("body", TEXTS, ids=lambda body: body["text"])
def test_a_translation_given_again(server: httpx.Client, body: dict[str, Any]) -> None:
    first, again = post(server, "/translate", body), post(server, "/translate", body)
    assert same(again, first)
    assert same(again, post(server, "/translate", body, LONG))
    assert post(server, "/translate", body, "application/json; charset=utf-8").content == first.content


@pytest.mark.parametrize("wrong", [{"text": "x", "environment": "nowhere"}, {"text": 3}, [], {"text": "go " * 700}])
def test_refusals_are_those_of_the_route(server: httpx.Client, wrong: Any) -> None:
    expected = post(server, "/translate", wrong, LONG)
    assert expected.status_code in (404, 422)
    assert all(same(post(server, "/translate", wrong), expected) for _ in range(2))


def test_steps(server: httpx.Client) -> None:
    found = plan(server, text="Pickup the sphere", environment="toys-4x1-sphere")
    path = found["policy"]["url"] + "/step"
    good = [{"state": place["state"], "memory": place["memory"]} for place in found["trajectory"]]
    lost = {"state": {"robot": {"at": "kitchen"}}, "memory": 0}
    bodies = [*good, {**good[0], "memory": 99}, {**good[0], "memory": True}, lost, {"state": 1}, {**good[0], "x": 1}]
    for body in bodies:
        expected = post(server, path, body, LONG)
        assert same(post(server, path, body), expected)
        assert expected.status_code == (200 if body in good else 422)
    unknown = post(server, "/policies/none/step", good[0])
    assert (unknown.status_code, unknown.json()["type"]) == (404, "urn:cqltl:problem:unknown-policy")
    assert server.delete(found["policy"]["url"]).status_code == 204
    assert post(server, path, good[0]).status_code == 404


def test_metrics_count_what_is_given_again(server: httpx.Client) -> None:
    counted = (
        'cqltl_translations_total{outcome="translated",translator="default"}',
        'cqltl_request_seconds_count{method="POST",route="/translate",status="200"}',
        'cqltl_translation_confidence_count{translator="default"}',
    )

    def counts() -> list[float]:
        lines = dict(line.rsplit(" ", 1) for line in server.get("/metrics").text.splitlines() if line[0] != "#")
        return [float(lines.get(name, 0)) for name in counted]

    before = counts()
    for _ in range(3):
        post(server, "/translate", TEXTS[0])
    assert counts() == [count + 3 for count in before]


@pytest.mark.parametrize("kind", ["sqlite", "postgresql"])
def test_a_change_is_seen_at_once_by_every_process(kind: str, tmp_path: Path, request: pytest.FixtureRequest) -> None:
    url = ""
    if kind == "postgresql":
        postgres: Postgres = request.getfixturevalue("postgres")
        url = str(postgres.database())
    with serving(tmp_path, CQLTL_DATABASE_URL=url) as one, serving(tmp_path, CQLTL_DATABASE_URL=url) as other:
        taught = {"text": "frobnicate the sphere", "environment": "toys"}

        def said(body: dict[str, Any]) -> list[str | None]:
            return [post(client, "/translate", body).json()["ltl"] for client in (one, other, one, other)]

        assert said(taught) == [None] * 4
        assert learn(one, "frobnicate(cylinder)", "F holding(cylinder)", "frobnicate the cylinder").status_code == 201
        assert said(taught) == ["F holding(sphere)"] * 4
        assert other.delete("/templates/frobnicate").status_code == 204
        assert said(taught) == [None] * 4

        here = {"text": "pick up the thingummy", "environment": "small"}
        for _ in range(2):  # a world that comes again is another one
            for client, things, ltl in ((one, [("cube", "red")], "cube"), (other, [("sphere", "red")], "sphere")):
                spec = toys_spec(columns=2, rows=1, toys=things)
                named = spec["objects"][ltl]
                spec["objects"][ltl] = {**named, "synonyms": [*named.get("synonyms", []), "thingummy"]}
                put = client.put("/environments/small", json={**spec, "name": "small"})
                assert put.status_code in (200, 201), put.text
                assert said(here) == [f"F holding({ltl})"] * 4
            assert one.delete("/environments/small").status_code == 204
            assert [post(client, "/translate", here).status_code for client in (one, other)] == [404, 404]


def test_no_more_than_may_be_kept_is(server: httpx.Client, folder: Path) -> None:
    """With room for a few answers the answers are the same; for none, see tests/service/test_same_bytes.py."""
    with serving(folder, CQLTL_TRANSLATION_CACHE_BYTES="3000", CQLTL_POLICY_CACHE_BYTES="1") as small:
        for _ in range(2):
            for body in TEXTS:
                assert same(post(small, "/translate", body), post(server, "/translate", body))
        found = plan(server, text="Pickup the sphere", environment="toys-4x1-sphere")
        url = found["policy"]["url"]
        assert same(post(small, f"{url}/step", found["initial"]), post(server, f"{url}/step", found["initial"]))
