"""What docs/running.md says of Docker is run, word for word, and the containers do the main job (`make docker-check`).

The image `cqltl` is made from the checkout; containers and volumes are of projects of their own, and go afterwards.
"""

from __future__ import annotations

import subprocess
import time
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

import httpx
import pytest

from tests.documents.apart import DOCKER, lines
from tests.documents.blocks import ROOT
from tests.documents.machine import environment, free_port, plans, run

pytestmark = pytest.mark.long

ONE, COPY, MANY = lines(DOCKER, "docs/running.md")
READY_S = 180
"""Thirteen containers that start at once on two cores take their time."""


@pytest.fixture(scope="module", autouse=True)
def _docker() -> None:
    if subprocess.run(["docker", "compose", "ls"], capture_output=True, check=False).returncode:
        pytest.skip("no Docker with Compose")


@contextmanager
def deployed(file: str, *commands: str) -> Iterator[tuple[str, dict[str, str]]]:
    """What commands with a compose file start: its address, and the variables for further ones."""
    port = free_port()
    name = f"cqltl-test-{port}"
    variables = environment(CQLTL_PUBLISHED_PORT=port, COMPOSE_PROJECT_NAME=name)
    down = f"CQLTL_DB_PASSWORD=x docker compose --file {file} down --volumes --timeout 20"
    try:
        run("\n".join(commands), ROOT, variables, most_s=1800)
        yield f"http://127.0.0.1:{port}", variables
    finally:
        run(down, ROOT, variables)


def wait_until_ready(address: str) -> None:
    until = time.monotonic() + READY_S
    while time.monotonic() < until:
        try:
            if httpx.get(f"{address}/readyz", timeout=5).status_code == 200:
                return
        except httpx.TransportError:
            pass
        time.sleep(1)
    raise AssertionError(f"{address} is not ready after {READY_S} s")


def containers(project: str, service: str) -> list[str]:
    """Those of a service that run."""
    labels = (f"com.docker.compose.project={project}", f"com.docker.compose.service={service}")
    command = ["docker", "ps", "--quiet", *(f"--filter=label={label}" for label in labels)]
    return subprocess.run(command, capture_output=True, text=True, check=True).stdout.split()


def test_one_machine(tmp_path: Path) -> None:
    """It plans, a copy of its store is made, and what was taught is there after it was made anew."""
    file = "docker/compose.yaml"
    taught = {"contextual_query": "stow(cylinder, box)", "ltl": "F in(cylinder, box)", "environment": "toys"}
    with deployed(file, *ONE) as (address, variables):
        wait_until_ready(address)
        assert plans(address)
        learned = httpx.post(f"{address}/learn", json=taught, timeout=60)
        assert learned.is_success, learned.text
        run("\n".join(COPY), ROOT, variables)
        command = f"docker compose --file {file} cp cqltl:/data/copy.sqlite3 {tmp_path}"
        run(command, ROOT, variables)
        assert b"stow" in (tmp_path / "copy.sqlite3").read_bytes()
        run(f"docker compose --file {file} up --detach --force-recreate", ROOT, variables)
        wait_until_ready(address)
        assert httpx.get(f"{address}/templates/stow", timeout=60).status_code == 200


def test_many_machines() -> None:
    """As many as were asked for answer and work; a plan goes on where a service or a worker is killed."""
    with deployed("docker/compose.scale.yaml", *MANY) as (address, variables):
        wait_until_ready(address)
        assert plans(address)
        project = variables["COMPOSE_PROJECT_NAME"]
        running = {service: containers(project, service) for service in ("api", "worker", "proxy", "database")}
        assert {service: len(found) for service, found in running.items()} == {
            "api": 5,
            "worker": 8,
            "proxy": 1,
            "database": 1,
        }
        subprocess.run(["docker", "kill", running["api"][0], running["worker"][0]], capture_output=True, check=True)
        time.sleep(3)  # the proxy asks every 2 s who answers
        assert plans(address)
