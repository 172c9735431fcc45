"""What a worker of PostgreSQL counts, on a port of its own."""

from __future__ import annotations

import socket
from pathlib import Path

import httpx
import pytest
from prometheus_client.parser import text_string_to_metric_families

from tests.service.jobs.deployments import Queued
from tests.service.postgres import Postgres


@pytest.mark.long
def test_plans_are_counted_where_they_are_made(tmp_path: Path, postgres: Postgres) -> None:
    with socket.create_server(("127.0.0.1", 0)) as free:
        port = free.getsockname()[1]
    deployment = Queued(tmp_path, CQLTL_DATABASE_URL=postgres.database(), CQLTL_WORKER_METRICS_PORT=str(port))
    try:
        asked = {"ltl": "F holding(sphere)", "environment": "toys-4x1-sphere"}
        answer = deployment.client.post("/plan", json=asked, headers={"Prefer": "wait=60"})
        assert answer.json()["outcome"] == "solved"
        families = text_string_to_metric_families(httpx.get(f"http://127.0.0.1:{port}/metrics").text)
        found = {sample.name: sample.value for family in families for sample in family.samples}
        assert found["cqltl_plans_total"] == 1
        assert found["cqltl_plan_sweeps_count"] == 1
        assert found["cqltl_plans_running"] == 0
        asked_here = deployment.client.get("/metrics").text
        assert "\ncqltl_plans_waiting 0.0\n" in asked_here
    finally:
        deployment.close()
