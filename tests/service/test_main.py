"""The command line, on a store of its own and against a running server."""

from __future__ import annotations

import json
import os
import signal
import subprocess
import sys
import time
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import httpx
import pytest
import yaml

from benchmarks.server import serving
from models.world import toys_spec
from service.__main__ import main
from tests.service.conftest import run_cli, run_here

SHIP = "Put the cylinder in the box, then put the box in the bedroom"


def test_the_whole_path_without_a_server(tmp_path: Path) -> None:
    """`translate` is in the next test. However short the wait, no plan becomes a job."""
    lesson = ["stash(sphere)", "F in(sphere, box)", "--environment", "toys", "--explanation", "the {1} is stashed"]
    learned = run_here("learn", *lesson, data=tmp_path)
    assert learned.returncode == 0, learned.stderr
    assert json.loads(learned.stdout)["template"] == "F in($1, box)"
    query = ["--contextual-query", "stash(cylinder)", "--environment", "toys"]
    said = json.loads(run_here("explain", *query, data=tmp_path).stdout)
    assert (said["explanation"], said["reading"]) == (
        "the cylinder is stashed",
        "eventually the cylinder is in the box",
    )
    planned = run_here("plan", *query, data=tmp_path, CQLTL_WAIT_S="0")
    assert json.loads(planned.stdout)["outcome"] == "solved", planned.stderr


@pytest.fixture(scope="module")
def hurried(tmp_path_factory: pytest.TempPathFactory) -> Iterator[httpx.Client]:
    """A client of a server that waits for no plan, and that nothing was taught."""
    with serving(tmp_path_factory.mktemp("hurried"), CQLTL_WAIT_S="0") as found:
        yield found


def test_the_same_against_a_server(client: httpx.Client, hurried: httpx.Client, tmp_path: Path) -> None:
    server = ["--server", str(client.base_url)]
    question = ("translate", SHIP, "--environment", "toys")
    here = run_cli(*question, data=tmp_path / "local")
    there = run_here(*question, "--server", str(hurried.base_url), data=tmp_path / "unused")
    assert json.loads(here.stdout)["contextual_query"]["text"] == "ship(cylinder, box, bedroom)"
    assert here.stdout == there.stdout
    learned = run_here(
        "learn",
        "cli(sphere)",
        "F holding(sphere)",
        "--environment",
        "toys",
        "--example",
        "cli sphere",
        *server,
        data=tmp_path,
    )
    assert json.loads(learned.stdout)["examples"] == ["cli sphere"]
    assert not (tmp_path / "unused").exists()


def test_questions_are_answered_one_after_the_other(client: httpx.Client, tmp_path: Path) -> None:
    asked = ("plan", "Pick up a toy", "--environment", "toys", "--server", str(client.base_url), "--format", "json")
    refused = run_here(*asked, data=tmp_path)
    assert refused.returncode == 1
    assert json.loads(refused.stderr)["question"]["about"] in ("thing", "reading")
    picked = ("translate", "Pick up a toy", "--environment", "toys", "--server", str(client.base_url))
    assert json.loads(run_here(*picked, "--answer", "bag", data=tmp_path).stdout)["ltl"] == "F holding(bag)"
    wrong = run_here(*picked, "--answer", "moon", data=tmp_path)
    assert (wrong.returncode, "wrong-answer" in wrong.stderr) == (1, True)
    neither = run_here(*picked, "--answer", "none", data=tmp_path)
    assert (neither.returncode, json.loads(neither.stdout)["outcome"]) == (0, "unknown")


def test_explaining_with_a_server(client: httpx.Client, tmp_path: Path) -> None:
    arguments = ["explain", "G F a", "--server", str(client.base_url)]
    there = run_here(*arguments, data=tmp_path / "unused")
    assert json.loads(there.stdout)["explanation"] == "again and again a holds"
    assert not (tmp_path / "unused").exists()


def test_an_environment_from_a_file(client: httpx.Client, tmp_path: Path) -> None:
    file = tmp_path / "world.yaml"
    file.write_text(yaml.safe_dump({**toys_spec(columns=2, rows=1, toys=[("cube", "red")]), "name": "filed"}))
    planned = run_here(
        "plan",
        "--ltl",
        "F holding(cube)",
        "--environment-file",
        str(file),
        "--server",
        str(client.base_url),
        data=tmp_path,
    )
    assert json.loads(planned.stdout)["environment"] == "filed"


def test_options_of_a_plan_are_those_of_the_request(client: httpx.Client, tmp_path: Path) -> None:
    def planned(*options: str) -> dict[str, Any]:
        what = ["plan", "--ltl", "F at(robot, bathroom)", "--environment", "toys-4x1-sphere"]
        found = run_here(*what, "--server", str(client.base_url), *options, data=tmp_path)
        answer: dict[str, Any] = json.loads(found.stdout)
        return answer

    plain, least = planned(), planned("--objective", "min", "--verify")
    whole = planned("--no-relevance", "--objective", "max")
    assert (plain["objective"], plain["probability"], plain["verified"]) == ("max", {"lower": 1.0, "upper": 1.0}, None)
    assert (least["objective"], least["probability"]) == ("min", {"lower": 0.0, "upper": 0.0})  # it stays away
    assert least["verified"]["probability"] == 0.0
    assert least["verified"]["sound"]
    assert plain["model"]["states"] == 4  # where the robot is
    assert whole["model"]["states"] == 4 * 5 * 6
    assert whole["expected_steps"] == plain["expected_steps"]


@pytest.mark.parametrize(
    ("arguments", "status", "said"),
    [
        (["plan", "--ltl", "F (", "--environment", "toys"], 1, "formula-syntax"),
        (["plan", "--ltl", "F a", "--environment", "atlantis"], 1, "unknown-environment"),
        (["plan", "--ltl", "F a", "--environment-file", "/no/such/file"], 1, "/no/such/file"),
        (["plan", "--ltl", "F a"], 2, "--environment"),
        (["plan", "--ltl", "F a", "--environment", "toys", "--objective", "most"], 2, "'max', 'min'"),
        (["explain", "F ("], 1, "formula-syntax"),
        (["explain"], 2, "required"),
        (["fly"], 2, "invalid choice"),
    ],
)
def test_refusals_go_to_standard_error(
    client: httpx.Client, tmp_path: Path, arguments: list[str], status: int, said: str
) -> None:
    server = ["--server", str(client.base_url)] if status == 1 else []
    result = run_here(*arguments, *server, data=tmp_path)
    assert result.returncode == status
    assert said in result.stderr
    assert result.stdout == ""
    assert "Traceback" not in result.stderr


def test_the_document_is_the_servers(client: httpx.Client, tmp_path: Path) -> None:
    there = run_here("openapi", "--server", str(client.base_url), data=tmp_path)
    here = run_here("openapi", data=tmp_path)
    assert yaml.safe_load(there.stdout) == yaml.safe_load(here.stdout) == client.get("/openapi.json").json()
    stale = tmp_path / "stale.yaml"
    stale.write_text("openapi: 3.1.0\n")
    assert main(["openapi", "--check", str(stale)]) == 1
    assert main(["openapi", "--output", str(stale)]) == 0
    assert main(["openapi", "--check", str(stale)]) == 0


def test_a_server_that_is_not_there(tmp_path: Path) -> None:
    result = run_here("translate", "go", "--server", "http://127.0.0.1:9", data=tmp_path)
    assert result.returncode == 1
    assert "http://127.0.0.1:9/translate" in result.stderr


def test_a_port_that_is_taken(client: httpx.Client, tmp_path: Path) -> None:
    result = run_cli("serve", "--port", str(client.base_url.port), data=tmp_path / "unused")
    assert result.returncode == 1
    assert "--port" in result.stderr
    assert not (tmp_path / "unused").exists()


def test_an_interruption_while_it_loads_needs_no_words(tmp_path: Path) -> None:
    command = [sys.executable, "-m", "service", "serve", "--port", "0"]
    environment = {**os.environ, "CQLTL_DATA_DIR": str(tmp_path), "CQLTL_DATABASE_URL": ""}
    with subprocess.Popen(command, env=environment, stdout=subprocess.PIPE, stderr=subprocess.PIPE) as process:
        while not (tmp_path / "cqltl.sqlite3").exists():
            time.sleep(0.001)  # amid the migrations, which say what they were at
        process.send_signal(signal.SIGINT)
        out, error = process.communicate(timeout=60)
    assert (process.returncode, out, error) == (130, b"", b"")


def test_a_worker_needs_postgresql(tmp_path: Path) -> None:
    result = run_here("worker", data=tmp_path)
    assert result.returncode == 2
    assert "CQLTL_DATABASE_URL" in result.stderr
    assert not list(tmp_path.iterdir())


def test_a_worker_takes_only_queues_that_there_are(tmp_path: Path) -> None:
    result = run_here("worker", "--queues", "plan,cpu", data=tmp_path)
    assert result.returncode == 2
    assert "plan and gpu" in result.stderr


def test_a_plan_that_becomes_a_job_is_waited_for(hurried: httpx.Client, tmp_path: Path) -> None:
    server = ["--server", str(hurried.base_url)]
    planned = run_here("plan", "Pickup the sphere", "--environment", "toys-4x1-sphere", *server, data=tmp_path)
    assert json.loads(planned.stdout)["outcome"] == "solved", planned.stderr
    (job,) = hurried.get("/jobs").json()["items"]
    assert job["state"] == "succeeded"
