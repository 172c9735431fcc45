"""`cqltl plan` for people."""

from __future__ import annotations

import json
from pathlib import Path

import httpx
import pytest

from tests.service.conftest import run_here


def test_the_run_is_drawn_as_text(client: httpx.Client, tmp_path: Path) -> None:
    server = ["--server", str(client.base_url)]
    arguments = ["plan", "Pickup the sphere", "--environment", "toys-4x1-sphere", *server]
    shown = run_here(*arguments, "--format", "text", data=tmp_path)
    assert shown.returncode == 0, shown.stderr
    assert "probability 1, expected steps 4" in shown.stdout
    assert "  1. east: robot at living room" in shown.stdout
    assert "  4. pick(sphere): sphere in robot" in shown.stdout
    assert "@ (sphere)" in shown.stdout
    assert json.loads(run_here(*arguments, data=tmp_path).stdout)["outcome"] == "solved", "no terminal: JSON"


def test_what_cannot_be_done_is_said(client: httpx.Client, tmp_path: Path) -> None:
    server = ["--server", str(client.base_url)]
    arguments = ["plan", "--ltl", "F holding(box) & G !holding(box)", "--environment", "toys", *server]
    shown = run_here(*arguments, "--format", "text", "--gif", str(tmp_path / "run.gif"), data=tmp_path)
    assert shown.returncode == 1
    assert "unsatisfiable: probability 0" in shown.stdout
    assert "no run to animate" in shown.stderr
    assert not (tmp_path / "run.gif").exists()


def test_why_it_cannot_be_done_is_said(client: httpx.Client, tmp_path: Path) -> None:
    server = ["--server", str(client.base_url)]
    arguments = ["plan", "--ltl", "F (holding(box) & holding(bag))", "--environment", "toys", *server]
    shown = run_here(*arguments, "--format", "text", data=tmp_path)
    assert shown.returncode == 0
    assert "unreachable: probability 0\nfrom here: never both the robot is holding the box and" in shown.stdout


def test_a_run_for_ever_says_where_it_goes_round(client: httpx.Client, tmp_path: Path) -> None:
    server = ["--server", str(client.base_url)]
    formula = "G F at(robot, kitchen) & G F at(robot, bathroom)"
    shown = run_here(
        "plan", "--ltl", formula, "--environment", "toys-4x1-sphere", "--format", "text", *server, data=tmp_path
    )
    assert "and so on, from step" in shown.stdout


def test_an_animation_is_written(client: httpx.Client, tmp_path: Path) -> None:
    image = pytest.importorskip("PIL.Image", reason="animations need Pillow")
    path = tmp_path / "run.gif"
    server = ["--server", str(client.base_url)]
    arguments = ["plan", "Pickup the sphere", "--environment", "toys-4x1-sphere", "--gif", str(path), *server]
    answer = run_here(*arguments, data=tmp_path)
    assert answer.returncode == 0, answer.stderr
    with image.open(path) as gif:
        assert gif.n_frames == len(json.loads(answer.stdout)["trajectory"]) == 5


def test_a_file_that_cannot_be_written_is_named(client: httpx.Client, tmp_path: Path) -> None:
    path = tmp_path / "none" / "run.gif"
    server = ["--server", str(client.base_url)]
    arguments = ["plan", "Pickup the sphere", "--environment", "toys-4x1-sphere", "--gif", str(path), *server]
    answer = run_here(*arguments, data=tmp_path)
    assert answer.returncode == 1
    assert str(path) in answer.stderr
    assert "Traceback" not in answer.stderr
