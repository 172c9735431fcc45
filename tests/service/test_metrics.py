"""What /metrics says after requests whose numbers are known."""

from __future__ import annotations

import re
import time
from pathlib import Path

import httpx
from prometheus_client.parser import text_string_to_metric_families

from service.metrics import Metrics
from tests.service.jobs.deployments import ENDLESS

DOCS = Path(__file__).parents[2] / "docs"


def samples(text: str) -> dict[tuple[str, tuple[str, ...]], float]:
    """Values by name and values of labels, in the order of their names."""
    return {
        (sample.name, tuple(sample.labels.values())): sample.value
        for family in text_string_to_metric_families(text)
        for sample in family.samples
    }


def test_what_was_done_is_counted(server: httpx.Client) -> None:
    for text in ("Pickup the sphere", "Put the cylinder in the box, then put the box in the bedroom", "qwx zzy"):
        assert server.post("/translate", json={"text": text, "environment": "toys"}).status_code == 200
    server.post("/translate/batch", json={"texts": ["Pickup the sphere"] * 4})
    for ltl in ("F holding(sphere)", "F holding(sphere) & G !holding(sphere)"):
        assert server.post("/plan", json={"ltl": ltl, "environment": "toys-4x1-sphere"}).status_code == 200
    server.get("/nowhere")
    response = server.get("/metrics")
    assert response.headers["content-type"].startswith("text/plain; version=0.0.4")
    found = samples(response.text)
    assert found["cqltl_request_seconds_count", ("POST", "/translate", "200")] == 3
    assert found["cqltl_request_seconds_count", ("GET", "none", "404")] == 1
    assert found["cqltl_translations_total", ("translated", "default")] == 6
    assert found["cqltl_translations_total", ("unknown", "default")] == 1
    assert found["cqltl_translation_confidence_count", ("default",)] == 6
    assert found["cqltl_plans_total", ("solved",)] == 1
    assert found["cqltl_plans_total", ("unsatisfiable",)] == 1
    assert found["cqltl_plan_product_states_count", ()] == found["cqltl_plan_sweeps_count", ()] == 2
    assert found["cqltl_plan_seconds_sum", ()] > 0
    assert found["cqltl_plans_running", ()] == found["cqltl_plans_waiting", ()] == 0
    assert found["cqltl_requests_in_flight", ()] == 0
    assert found["process_open_fds", ()] > 0


def test_the_queue_is_seen(server: httpx.Client) -> None:
    headers = {"Prefer": "respond-async"}
    jobs = [server.post("/plan", json=ENDLESS, headers=headers).json()["url"] for _ in range(9)]
    depths = []
    until = time.monotonic() + 60
    while time.monotonic() < until and not any(running and waiting for running, waiting in depths):
        found = samples(server.get("/metrics").text)
        depths.append((found["cqltl_plans_running", ()], found["cqltl_plans_waiting", ()]))
    assert max(running for running, _ in depths) == 2
    assert max(waiting for _, waiting in depths) > 0
    for job in jobs:
        server.post(f"{job}/cancel")


def test_a_value_that_cannot_be_had_hides_no_other() -> None:
    metrics = Metrics()
    metrics.watch("broken", "", lambda: 1 / 0)
    metrics.answered("GET", "/livez", 200, 0.1)
    text = metrics.text().decode()
    assert "broken NaN" in text
    assert samples(text)["cqltl_request_seconds_count", ("GET", "/livez", "200")] == 1


def test_every_metric_is_documented(server: httpx.Client) -> None:
    rows = (DOCS / "settings.md").read_text().partition("## Metrics")[2]
    documented = {name.removesuffix("_total") for name in re.findall(r"`(cqltl_\w+)`", rows)}
    families = {family.name for family in text_string_to_metric_families(server.get("/metrics").text)}
    assert {name for name in families if name.startswith("cqltl_")} == documented
