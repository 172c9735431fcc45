"""What every executor promises, over HTTP: jobs, cancelling, keys, events."""

from __future__ import annotations

import json
import threading
import time
from collections.abc import Iterator
from typing import Any

import httpx
import pytest

from benchmarks.processes import gone_within
from tests.service.conftest import check_problem
from tests.service.jobs.deployments import ENDLESS, QUICK, SLOW, Deployment, order, task, wait_for

ENDS = ("succeeded", "failed", "cancelled")


def untimed(plan: dict[str, Any]) -> dict[str, Any]:
    return {name: value for name, value in plan.items() if name != "timing"}


def events(response: httpx.Response) -> Iterator[tuple[str, dict[str, Any]]]:
    """The events of a stream, with their data."""
    name = ""
    for line in response.iter_lines():
        field, _, value = line.partition(": ")
        if field == "event":
            name = value
        elif field == "data":
            yield name, json.loads(value)


def test_a_plan_within_the_wait_is_no_job(shared: Deployment) -> None:
    before = shared.client.get("/jobs").json()
    response = shared.client.post("/plan", json=QUICK, headers={"Prefer": "wait=30"})
    assert response.status_code == 200
    assert response.headers["preference-applied"] == "wait=30"
    assert response.json()["outcome"] == "solved"
    assert shared.client.get("/jobs").json() == before


def test_a_plan_beyond_the_wait_becomes_a_job_with_the_same_plan(shared: Deployment) -> None:
    began = time.monotonic()
    response = shared.client.post("/plan", json=SLOW, headers={"Prefer": "wait=1"})
    assert 1 <= time.monotonic() - began < 3
    assert response.status_code == 202
    assert response.headers["preference-applied"] == "wait=1"
    assert int(response.headers["retry-after"]) >= 1
    job, url = response.json(), response.headers["location"]
    assert job["url"] == url == f"/jobs/{job['id']}"
    assert job["state"] in ("queued", "running")
    assert (job["plan"], job["error"]) == (None, None)
    ended = wait_for(shared.client, url, *ENDS)
    assert (ended["state"], ended["error"]) == ("succeeded", None)
    assert ended["timing"]["ended_at"] > ended["timing"]["created_at"]
    again = shared.client.post("/plan", json=SLOW, headers={"Prefer": "wait=60"})
    assert again.status_code == 200
    assert untimed(again.json()) == untimed(ended["plan"])  # the id of the policy is a digest of its bytes
    assert shared.client.get(ended["plan"]["policy"]["url"]).status_code == 200


def test_jobs_are_listed_in_pages_in_the_order_of_their_acceptance(shared: Deployment) -> None:
    accepted = [order(shared.client, QUICK).rpartition("/")[2] for _ in range(3)]
    listed: list[dict[str, Any]] = []
    page = {"next": ""}
    while page["next"] is not None:
        page = shared.client.get("/jobs", params={"cursor": page["next"], "limit": 2}).json()
        assert len(page["items"]) <= 2
        listed += page["items"]
    ids = [job["id"] for job in listed]
    assert ids == sorted(ids)
    assert [found for found in ids if found in accepted] == accepted
    for found in accepted:
        job = wait_for(shared.client, f"/jobs/{found}", "succeeded")
        row = next(row for row in listed if row["id"] == found)
        assert {name: job[name] for name in row if name != "state"} == {n: v for n, v in row.items() if n != "state"}


def test_a_refusal_is_the_same_with_and_without_a_job(shared: Deployment) -> None:
    body = task(2, 1, max_states=10)
    refused = check_problem(shared.client.post("/plan", json=body), "model-too-large", 422, ["/options/max_states"])
    job = wait_for(shared.client, order(shared.client, body), *ENDS)
    assert job["state"] == "failed"
    assert job["plan"] is None
    assert {name: value for name, value in job["error"].items() if value is not None} == refused


def test_what_is_refused_before_planning_makes_no_job(shared: Deployment) -> None:
    before = shared.client.get("/jobs", params={"limit": 200}).json()
    body = {"ltl": "F nothing(here)", "environment": "toys"}
    response = shared.client.post("/plan", json=body, headers={"Prefer": "respond-async", "Idempotency-Key": "refused"})
    check_problem(response, "unknown-proposition", 422, ["/ltl"])
    assert shared.client.get("/jobs", params={"limit": 200}).json() == before


def test_cancelling_kills_what_runs_within_a_second(shared: Deployment) -> None:
    url = order(shared.client, ENDLESS)
    wait_for(shared.client, url, "running")
    time.sleep(0.5)
    child = shared.busy_child()
    cancelled = shared.client.post(f"{url}/cancel")
    assert gone_within(child, 1.0)
    assert (cancelled.status_code, cancelled.json()["state"]) == (200, "cancelled")
    assert shared.client.post("/plan", json=QUICK, headers={"Prefer": "wait=30"}).status_code == 200
    job = shared.client.get(url).json()
    assert (job["state"], job["plan"], job["error"]) == ("cancelled", None, None)


def test_ends_never_change(shared: Deployment) -> None:
    url = order(shared.client, QUICK)
    ended = wait_for(shared.client, url, "succeeded")
    assert shared.client.post(f"{url}/cancel").json() == ended
    assert shared.client.get(url).json() == ended


def test_a_job_that_waits_can_be_cancelled(shared: Deployment) -> None:
    urls = [order(shared.client, ENDLESS) for _ in range(4)]  # two processes
    assert shared.client.get(urls[-1]).json()["state"] == "queued"
    for url in reversed(urls):
        assert shared.client.post(f"{url}/cancel").json()["state"] == "cancelled"
    assert shared.client.post("/plan", json=QUICK, headers={"Prefer": "wait=30"}).status_code == 200


def test_an_unknown_job_is_a_problem_everywhere(shared: Deployment) -> None:
    client = shared.client
    for response in (client.get("/jobs/nobody"), client.post("/jobs/nobody/cancel"), client.get("/jobs/nobody/events")):
        check_problem(response, "unknown-job", 404)


@pytest.mark.parametrize("path", ["jobs", "environments", "policies", "templates"])
def test_a_name_that_no_database_holds_is_a_problem(shared: Deployment, path: str) -> None:
    response = shared.client.get(f"/{path}/a%00b")
    assert response.status_code in (404, 422)
    assert response.headers["content-type"] == "application/problem+json"


def test_events_tell_how_far_a_job_is_and_how_it_ends(shared: Deployment) -> None:
    url = order(shared.client, SLOW)
    with shared.client.stream("GET", f"{url}/events") as response:
        assert response.headers["content-type"].startswith("text/event-stream")
        found = list(events(response))
    assert [name for name, _ in found] == ["progress"] * (len(found) - 1) + ["end"]
    *told, (_, end) = found
    assert end == shared.client.get(url).json()
    assert end["state"] == "succeeded"
    states = [data["state"] for _, data in told]
    assert states == sorted(states)  # queued, running
    stages = [data["progress"]["stage"] for _, data in told if data["progress"]["stage"]]
    assert stages
    elapsed = [data["progress"]["elapsed_s"] for _, data in told if data["progress"]["elapsed_s"] is not None]
    assert elapsed == sorted(elapsed)
    compiled = [data["progress"]["states"] for _, data in told if data["progress"]["stage"] == "compile"]
    assert all(states > 0 for states in compiled)
    assert all(data["progress"]["states"] >= 0 for _, data in told)  # 0: a search that had nothing to look at


def test_events_tell_sweeps_bounds_and_what_is_left(shared: Deployment) -> None:
    """Of the rounds that the plan makes for ever, whose length takes the longest to find."""
    with shared.client.stream("GET", f"{order(shared.client, SLOW)}/events") as response:
        told = [data["progress"] for _, data in events(response)]
    rounds = [progress for progress in told if progress["stage"] == "rounds"]
    sweeps = [progress["sweep"] for progress in rounds]
    assert sweeps == sorted(sweeps)
    assert sweeps[-1] > 0
    bounds = [(found["lower"], found["upper"]) for found in rounds if found["upper"] is not None]
    widths = [upper - lower for lower, upper in bounds]
    assert widths == sorted(widths, reverse=True)
    assert widths[-1] >= 0
    left = [progress["remaining_s"] for progress in rounds if progress["remaining_s"] is not None]
    assert left
    assert all(seconds >= 0 for seconds in left)


def test_the_events_of_a_job_that_has_ended_are_its_end(shared: Deployment) -> None:
    url = order(shared.client, QUICK)
    ended = wait_for(shared.client, url, "succeeded")
    with shared.client.stream("GET", f"{url}/events") as response:
        assert list(events(response)) == [("end", ended)]


def test_the_same_key_at_the_same_time_is_one_job(shared: Deployment) -> None:
    found: list[httpx.Response] = []
    headers = {"Prefer": "respond-async", "Idempotency-Key": "all at once"}

    def ask() -> None:
        found.append(httpx.post(f"{shared.client.base_url}/plan", json=SLOW, headers=headers, timeout=60))

    threads = [threading.Thread(target=ask) for _ in range(8)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert {response.status_code for response in found} == {202}
    assert len({response.headers["location"] for response in found}) == 1
    assert wait_for(shared.client, found[0].headers["location"], *ENDS)["state"] == "succeeded"


@pytest.mark.parametrize("body", [QUICK, task(2, 1, max_states=10)], ids=["plan", "refusal"])
def test_the_same_key_and_request_get_the_same_bytes(shared: Deployment, body: dict[str, Any]) -> None:
    headers = {"Prefer": "wait=30", "Idempotency-Key": f"twice {body['options']}"}
    before = shared.client.get("/jobs").json()
    one, two = (shared.client.post("/plan", json=body, headers=headers) for _ in range(2))
    assert one.status_code == (422 if "max_states" in body["options"] else 200)
    assert (one.status_code, one.content) == (two.status_code, two.content)
    assert shared.client.get("/jobs").json() == before


@pytest.mark.parametrize("body", [QUICK, task(2, 1, max_states=10)], ids=["plan", "refusal"])
def test_who_does_not_wait_gets_the_job_even_if_it_has_ended(shared: Deployment, body: dict[str, Any]) -> None:
    headers = {"Prefer": "respond-async", "Idempotency-Key": f"asynchronous {body['options']}"}
    url = order(shared.client, body, **headers)
    ended = wait_for(shared.client, url, *ENDS)
    again = shared.client.post("/plan", json=body, headers=headers)
    assert (again.status_code, again.headers["location"]) == (202, url)
    assert again.headers["preference-applied"] == "respond-async"
    assert again.json() == ended


def test_the_same_key_with_another_request_is_refused(shared: Deployment) -> None:
    headers = {"Prefer": "wait=30", "Idempotency-Key": "mine"}
    assert shared.client.post("/plan", json=QUICK, headers=headers).status_code == 200
    check_problem(shared.client.post("/plan", json=SLOW, headers=headers), "idempotency-key-reused", 422)


def test_learning_and_environments_are_answered_alike_under_one_key(shared: Deployment) -> None:
    lesson = {"contextual_query": "clutch(sphere)", "ltl": "F holding(sphere)", "environment": "toys"}
    world = {**QUICK["environment_spec"], "name": "keyed"}
    for path, body, other in (
        ("/learn", lesson, {**lesson, "ltl": "F !holding(sphere)"}),
        ("/environments", world, {**world, "name": "another"}),
    ):
        headers = {"Idempotency-Key": "once"}
        one, two = (shared.client.post(path, json=body, headers=headers) for _ in range(2))
        assert one.status_code == 201, one.text
        assert (two.status_code, two.content, two.headers["location"]) == (201, one.content, one.headers["location"])
        check_problem(shared.client.post(path, json=other, headers=headers), "idempotency-key-reused", 422)


def test_eight_equal_environments_under_one_key_are_one(shared: Deployment) -> None:
    world = {**QUICK["environment_spec"], "name": "crowded"}
    found: list[httpx.Response] = []

    def ask() -> None:
        headers = {"Idempotency-Key": "crowd"}
        found.append(httpx.post(f"{shared.client.base_url}/environments", json=world, headers=headers, timeout=60))

    threads = [threading.Thread(target=ask) for _ in range(8)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert {(response.status_code, response.content) for response in found} == {(201, found[0].content)}
    assert shared.client.get("/environments/crowded").json()["revision"] == 1
