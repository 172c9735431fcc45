"""An accepted job is never lost, and every job ends, whatever is killed: on every executor.

`make promises` runs all of it; where every change is tested, there are those that need few processes, on SQLite.
"""

from __future__ import annotations

import signal
import statistics
import time
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import httpx
import pytest

from benchmarks.processes import children, computing, gone_within
from tests.service.conftest import check_problem, learn
from tests.service.jobs.conftest import Deploy
from tests.service.jobs.deployments import (
    ENDLESS,
    LEASE_S,
    SLOW,
    Deployment,
    Embedded,
    Queued,
    await_requests,
    kill,
    order,
    task,
    wait_for,
)
from tests.service.postgres import Postgres

ENDS = ("succeeded", "failed", "cancelled")


@pytest.fixture(scope="module")
def undisturbed(tmp_path_factory: pytest.TempPathFactory) -> str:
    """The policy of SLOW, planned while nothing happens; its id is a digest of its bytes."""
    deployment = Embedded(tmp_path_factory.mktemp("undisturbed"))
    response = deployment.client.post("/plan", json=SLOW, headers={"Prefer": "wait=60"})
    deployment.close()
    return str(response.json()["policy"]["id"])


def test_a_job_whose_process_is_killed_is_planned_all_the_same(sturdy: Deployment, undisturbed: str) -> None:
    url = order(sturdy.client, SLOW)
    wait_for(sturdy.client, url, "running")
    time.sleep(0.3)
    kill(sturdy.busy_child())
    job = wait_for(sturdy.client, url, *ENDS)
    assert job["state"] == "succeeded"
    assert job["plan"]["policy"]["id"] == undisturbed


def test_a_job_whose_process_is_killed_again_and_again_ends(sturdy: Deployment) -> None:
    url = order(sturdy.client, ENDLESS)
    wait_for(sturdy.client, url, "running")
    killed: set[int] = set()
    while sturdy.client.get(url).json()["state"] == "running" and len(killed) < 10:
        if sturdy.children - killed:
            child = sturdy.busy_child()
            killed.add(child)
            kill(child)
    job = wait_for(sturdy.client, url, *ENDS)
    assert job["state"] == "failed"
    assert job["error"]["type"].endswith("worker-died")
    assert 3 <= len(killed) < 10  # an idle one may have been busy with its start


def test_killing_all_that_a_service_started_costs_no_job(sturdy: Deployment, undisturbed: str) -> None:
    """The fork server too, from which its worker processes come."""
    url = order(sturdy.client, SLOW)
    wait_for(sturdy.client, url, "running")
    for process in sturdy.planners:
        for pid in children(process.pid):
            kill(pid)
    job = wait_for(sturdy.client, url, *ENDS)
    assert job["state"] == "succeeded"
    assert job["plan"]["policy"]["id"] == undisturbed


def test_a_job_that_another_service_cancels_is_killed_within_a_second(sturdy: Deployment) -> None:
    other = sturdy.connect(sturdy.serve())
    url = order(sturdy.client, ENDLESS)
    wait_for(sturdy.client, url, "running")
    time.sleep(0.5)
    child = sturdy.busy_child()
    assert other.post(f"{url}/cancel").json()["state"] == "cancelled"
    assert gone_within(child, 2.0)  # a second, on a machine that does not run all these tests
    assert sturdy.client.get(url).json()["state"] == "cancelled"


def test_a_job_survives_the_death_of_whoever_runs_it(deploy: Deploy, undisturbed: str) -> None:
    deployment = deploy()
    url = order(deployment.client, SLOW)
    wait_for(deployment.client, url, "running")
    time.sleep(0.5)
    deployment.kill_planners()
    deployment.recover()
    job = wait_for(deployment.client, url, *ENDS)
    assert job["state"] == "succeeded"
    assert job["plan"]["policy"]["id"] == undisturbed


def test_nothing_plans_on_for_a_service_that_was_killed(deploy: Deploy) -> None:
    deployment = deploy()
    wait_for(deployment.client, order(deployment.client, ENDLESS), "running")
    time.sleep(0.5)
    child = deployment.busy_child()
    deployment.kill_planners()
    assert gone_within(child, 5.0)


def test_a_restart_loses_no_job_and_takes_them_up_at_once(deploy: Deploy) -> None:
    deployment = deploy(CQLTL_JOB_LEASE_S="600", CQLTL_WORKERS="1")
    urls = [order(deployment.client, SLOW), *(order(deployment.client, task(2, 1)) for _ in range(3))]
    wait_for(deployment.client, urls[0], "running")
    deployment.kill_planners(signal.SIGTERM)
    deployment.recover()
    for url in urls:
        assert wait_for(deployment.client, url, *ENDS, within_s=30)["state"] == "succeeded"


@pytest.mark.long
def test_a_job_runs_in_one_place_only(deploy: Deploy) -> None:
    deployment = deploy()
    deployment.add_planner()
    while computing(deployment.children):
        pass  # they load
    url = order(deployment.client, ENDLESS)
    wait_for(deployment.client, url, "running")
    until, counts = time.monotonic() + 3 * LEASE_S, list[int]()
    while time.monotonic() < until:
        counts.append(computing(deployment.children))
    assert statistics.median(counts) == 1  # others may load something for a moment
    deployment.client.post(f"{url}/cancel")


def test_a_job_beyond_its_deadline_fails(deploy: Deploy) -> None:
    deployment = deploy(CQLTL_JOB_DEADLINE_S="2", CQLTL_WORKERS="1")
    urls = [order(deployment.client, ENDLESS) for _ in range(2)]  # one runs, one waits
    began = time.monotonic()
    for url in urls:
        job = wait_for(deployment.client, url, *ENDS, within_s=10)
        assert job["state"] == "failed"
        assert job["error"]["type"].endswith("out-of-time")
    assert time.monotonic() - began < 6


@pytest.mark.long
def test_a_plan_that_needs_too_much_memory_is_refused_and_the_next_one_is_planned(deploy: Deploy) -> None:
    limit = 1_500_000_000
    deployment = deploy(CQLTL_WORKER_MEMORY_BYTES=str(limit), CQLTL_WORKERS="1")
    job = wait_for(deployment.client, order(deployment.client, ENDLESS), *ENDS)
    assert job["state"] == "failed"
    assert job["error"]["type"].rpartition(":")[2] in ("out-of-memory", "model-too-large")
    quick = deployment.client.post("/plan", json=task(2, 1), headers={"Prefer": "wait=30"})
    assert quick.status_code == 200


def test_what_is_open_does_not_keep_a_service_from_stopping(deploy: Deploy) -> None:
    deployment = deploy()
    url = order(deployment.client, ENDLESS)
    time.sleep(2)  # it loads for a while after it has begun to listen

    def wait_for_a_plan() -> httpx.Response:
        return deployment.client.post("/plan", json=ENDLESS, headers={"Prefer": "wait=60"})

    with ThreadPoolExecutor(1) as others, deployment.client.stream("GET", f"{url}/events") as response:
        waiting = others.submit(wait_for_a_plan)
        lines = response.iter_lines()
        assert "retry: 1000" in [next(lines) for _ in range(3)]
        await_requests(deployment.client, 2)  # a request that no one has read yet is lost with its connection
        began = time.monotonic()
        deployment.server.send_signal(signal.SIGTERM)
        for _ in lines:
            pass  # it ends; the client would come back after a second
        deployment.server.wait(10)
        told = waiting.result()
    assert time.monotonic() - began < 5
    assert told.status_code == 202, "the plan has become a job, which another service or worker takes up"
    again = deployment.connect(deployment.serve())
    assert again.get(told.headers["location"]).json()["state"] in ("queued", "running")


@pytest.mark.long
def test_a_database_server_that_is_killed_costs_no_job(tmp_path: Path, postgres: Postgres, undisturbed: str) -> None:
    deployment = Queued(tmp_path, CQLTL_DATABASE_URL=postgres.database())
    try:
        urls = [order(deployment.client, SLOW), *(order(deployment.client, task(2, 1)) for _ in range(3))]
        wait_for(deployment.client, urls[0], "running")
        postgres.kill()
        check_problem(deployment.client.get(urls[0]), "not-ready", 503)
        assert deployment.client.get("/livez").status_code == 200
        check_problem(deployment.client.get("/readyz"), "not-ready", 503)
        time.sleep(LEASE_S)
        postgres.start()
        for url in urls:
            assert wait_for(deployment.client, url, *ENDS)["state"] == "succeeded"
        assert deployment.client.get(urls[0]).json()["plan"]["policy"]["id"] == undisturbed
        again = deployment.client.post("/plan", json=task(2, 1), headers={"Prefer": "wait=30"})
        assert again.status_code == 200
    finally:
        deployment.close()


@pytest.mark.long
def test_replicas_know_at_once_what_one_of_them_was_taught(tmp_path: Path, postgres: Postgres) -> None:
    deployment = Queued(tmp_path, CQLTL_DATABASE_URL=postgres.database())
    try:
        other = deployment.connect(deployment.serve())
        for number, (one, two) in enumerate([(deployment.client, other), (other, deployment.client)]):
            answer = learn(one, f"fetch{number}(sphere)", "F holding(sphere)", f"fetch number {number} the sphere")
            assert answer.status_code == 201
            body = {"text": f"fetch number {number} the cylinder", "environment": "toys"}
            assert two.post("/translate", json=body).json()["contextual_query"]["text"] == f"fetch{number}(cylinder)"
            planned = two.post("/plan", json=body, headers={"Prefer": "wait=30"}).json()
            assert planned["outcome"] == "solved"
            assert one.get(planned["policy"]["url"]).status_code == 200
    finally:
        deployment.close()


@pytest.mark.long
def test_a_plan_for_a_gpu_waits_for_a_worker_of_that_queue(tmp_path: Path, postgres: Postgres) -> None:
    deployment = Queued(tmp_path, queues="plan", CQLTL_DATABASE_URL=postgres.database())
    try:
        url = order(deployment.client, task(2, 1, device="cuda"))
        assert wait_for(deployment.client, order(deployment.client, task(2, 1)), *ENDS)["state"] == "succeeded"
        assert deployment.client.get(url).json()["state"] == "queued"
        deployment.queues = "gpu"
        deployment.add_planner()
        job = wait_for(deployment.client, url, *ENDS)
        assert job["state"] == "succeeded" or job["error"]["type"].endswith("device-unavailable")
    finally:
        deployment.close()
