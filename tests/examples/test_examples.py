"""Every example does what it says against a live server."""

from __future__ import annotations

import importlib.util
import shutil
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path
from types import ModuleType
from typing import Any

import httpx
import pytest

from benchmarks.server import serving
from tests.programs import run, typescript

EXAMPLES = Path(__file__).parents[2] / "examples"
LAST = "put(cylinder, box)"  # not the last action, but one that every run of the sentence has


@pytest.fixture(scope="module")
def server() -> Iterator[str]:
    with serving(CQLTL_WAIT_S="60") as client:
        yield str(client.base_url).rstrip("/")


@pytest.fixture(scope="module")
def robot() -> ModuleType:
    return load(EXAMPLES / "python" / "robot.py")


@pytest.fixture(scope="module")
def following() -> ModuleType:
    return load(EXAMPLES / "ros2" / "cqltl_robot" / "cqltl_robot" / "following.py")


def load(path: Path) -> ModuleType:
    spec = importlib.util.spec_from_file_location(path.stem, path)
    assert spec is not None
    assert spec.loader is not None
    module = sys.modules[path.stem] = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


def test_curl(server: str) -> None:
    version = run("curl", "--version").split()[1] if shutil.which("curl") else "0.0"
    if tuple(map(int, version.split(".")[:2])) < (7, 82):
        pytest.skip("no curl of version 7.82 or newer")
    said = run(EXAMPLES / "drive.sh", server)
    assert LAST in said
    assert said.endswith("done\n")


def test_python(server: str) -> None:
    said = run(sys.executable, EXAMPLES / "python" / "robot.py", "--server", server).splitlines()
    assert any(line.endswith(LAST) for line in said)
    assert said[-1] == "satisfied"


def test_python_goes_on_when_the_robot_is_moved(server: str, robot: ModuleType) -> None:
    class Clumsy(robot.Simulated):  # type: ignore[name-defined,misc]
        """Loses what it carries after its fifth action, and finds itself elsewhere."""

        done = 0

        def act(self, action: str | None) -> None:
            super().act(action)
            self.done += 1
            if self.done == 5:
                self._robot, self._things = "bedroom", {"box": "kitchen", "cylinder": "living_room"}

    found = Clumsy()
    command = "Put the cylinder in the box, then put the box in the bedroom"
    with robot.Service(server) as service:
        assert robot.carry_out(service, found, command, "toys-4x1-cylinder") == "satisfied"
    assert found.done > 5
    assert found.observe() == {"robot": {"at": "bedroom"}, "box": {"in": "bedroom"}, "cylinder": {"in": "box"}}


def test_python_plans_anew_where_the_plan_does_not_reach(server: str, robot: ModuleType) -> None:
    """The task needs no box, so the plan is for robots that hold none: this one was given it."""

    class Burdened(robot.Simulated):  # type: ignore[name-defined,misc]
        done = 0

        def act(self, action: str | None) -> None:
            super().act(action)
            self.done += 1
            if self.done == 1:
                self._things["box"] = "robot"

    found = Burdened()
    with robot.Service(server) as service:
        assert robot.carry_out(service, found, "Pick up the cylinder", "toys-4x1-cylinder") == "satisfied"
    assert found.observe()["cylinder"] == {"in": "robot"}
    assert found.observe()["box"] != {"in": "robot"}


def test_python_waits_for_jobs_and_repeats_what_found_the_service_busy(robot: ModuleType) -> None:
    answers = iter(
        [
            httpx.Response(503, headers={"Retry-After": "0"}, json={}),
            httpx.Response(202, headers={"Retry-After": "0"}, json={"state": "queued", "url": "/jobs/1", "plan": None}),
            httpx.Response(
                200, json={"state": "running", "url": "/jobs/1", "plan": None}, headers={"Retry-After": "0"}
            ),
            httpx.Response(200, json={"state": "succeeded", "url": "/jobs/1", "error": None, "plan": {"id": "p"}}),
        ]
    )
    asked: list[tuple[str, str | None]] = []

    def answer(request: httpx.Request) -> httpx.Response:
        asked.append((request.url.path, request.headers.get("idempotency-key")))
        return next(answers)

    with robot.Service("http://robot") as service:
        service._http.close()
        service._http = httpx.Client(base_url="http://robot", transport=httpx.MockTransport(answer))
        assert service.plan("go", "here") == {"id": "p"}
    assert [path for path, _ in asked] == ["/plan", "/plan", "/jobs/1", "/jobs/1"]
    assert asked[0][1] == asked[1][1] is not None


def test_typescript(server: str, tmp_path: Path) -> None:
    compiler = typescript(tmp_path)
    options = ("--strict", "--target", "es2022", "--module", "nodenext", "--outDir", tmp_path / "build")
    run(compiler, *options, EXAMPLES / "typescript" / "robot.ts")
    said = run("node", tmp_path / "build" / "robot.js", server)
    assert LAST in said
    assert "satisfied" in said


def test_cpp(server: str, tmp_path: Path) -> None:
    needed = "(Debian and Ubuntu: apt install g++ libcurl4-openssl-dev nlohmann-json3-dev)"
    compiler = shutil.which("g++")
    if compiler is None:
        pytest.skip(f"no g++ {needed}")
    probe = "#include <curl/curl.h>\n#include <nlohmann/json.hpp>\n"
    there = subprocess.run([compiler, "-E", "-x", "c++", "-"], input=probe, capture_output=True, text=True, check=False)
    if there.returncode != 0:
        pytest.skip(f"no headers of libcurl and nlohmann/json {needed}")
    program = tmp_path / "robot"
    flags = ("-std=c++17", "-Wall", "-Wextra", "-Werror")
    run(compiler, *flags, EXAMPLES / "cpp" / "robot.cpp", "-lcurl", "-o", program)
    said = run(program, server)
    assert LAST in said
    assert "satisfied" in said


def test_ros2_follows_a_command_and_plans_anew(server: str, robot: ModuleType, following: ModuleType) -> None:
    simulated = robot.Simulated()
    follower = following.Follower(server, "toys-4x1-cylinder")
    assert not follower.busy
    assert "cylinder" in follower.take("Pick up the cylinder", simulated.observe())
    simulated._things["box"] = "robot"  # where the plan does not reach
    statuses = []
    while follower.busy:
        step = follower.step(simulated.observe())
        statuses.append(step.status)
        if follower.busy:
            simulated.act(step.action)
    assert statuses[-1] == "satisfied"
    assert set(statuses[:-1]) == {"running"}
    assert simulated.observe()["cylinder"] == {"in": "robot"}


def test_ros2_says_why_it_does_nothing(server: str, following: ModuleType) -> None:
    follower = following.Follower(server, "toys-4x1-cylinder")
    for command, kind in (("Sing a song about the weather", "not-understood"), ("Pick up the unicorn", None)):
        with pytest.raises(following.ServiceError) as refused:
            follower.take(command)
        assert kind is None or refused.value.kind == kind
        assert not follower.busy
    with pytest.raises(following.ServiceError) as idle:
        follower.step({})
    assert idle.value.kind == "idle"
    nobody: Any = following.Follower("http://127.0.0.1:9", "toys")
    with pytest.raises(following.ServiceError) as unreachable:
        nobody.take("Pick up the cylinder")
    assert unreachable.value.kind == "unreachable"


def test_the_ros2_node_is_importable_where_ros_is() -> None:
    pytest.importorskip("rclpy", reason="no ROS 2 here (rclpy)")
    folder = str(EXAMPLES / "ros2" / "cqltl_robot")
    sys.path.insert(0, folder)
    try:
        from cqltl_robot.node import FollowingNode

        assert FollowingNode is not None
    finally:
        sys.path.remove(folder)
