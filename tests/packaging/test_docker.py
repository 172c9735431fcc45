"""What docker/ says of the code is true. The images are not built here, which needs Docker: `make docker-check`."""

from __future__ import annotations

import os
import re
import shutil
import subprocess
from pathlib import Path
from typing import Any

import pytest
import yaml

from service.settings import Settings

ROOT = Path(__file__).parents[2]
DOCKER = ROOT / "docker"
COMPOSE = ("compose.yaml", "compose.scale.yaml")
OURS = ("cqltl", "api", "worker")
FOR_COMPOSE = {"CQLTL_PUBLISHED_PORT", "CQLTL_DB_PASSWORD"}
"""Variables that Compose reads, and the service does not."""


def composed(name: str) -> dict[str, Any]:
    found: dict[str, Any] = yaml.safe_load((DOCKER / name).read_text(encoding="utf-8"))
    return found


@pytest.mark.parametrize("name", ["Dockerfile", *COMPOSE])
def test_every_variable_is_a_setting(name: str) -> None:
    settings = {f"CQLTL_{field.upper()}" for field in Settings.model_fields}
    named = set(re.findall(r"\bCQLTL_[A-Z_]+\b", (DOCKER / name).read_text(encoding="utf-8")))
    assert named
    assert named <= settings | FOR_COMPOSE


@pytest.mark.parametrize("name", COMPOSE)
def test_our_containers_have_nothing_to_write_to_but_tmp_and_data(name: str) -> None:
    for service, said in composed(name)["services"].items():
        if service in OURS:
            assert said["read_only"] is True
            assert said["cap_drop"] == ["ALL"]
            assert [mount.split(":")[0] for mount in said["tmpfs"]] == ["/tmp"]
            assert [volume.split(":")[1] for volume in said.get("volumes", [])] in ([], ["/data"])
            build = said["build"]
            assert (DOCKER / build["context"] / build["dockerfile"]).is_file()


def test_the_services_share_a_database_and_the_proxy_asks_whether_they_are_ready() -> None:
    services = composed("compose.scale.yaml")["services"]
    address = services["api"]["environment"]["CQLTL_DATABASE_URL"]
    assert services["worker"]["environment"]["CQLTL_DATABASE_URL"] == address
    assert address.startswith("postgresql+psycopg://")
    assert address.endswith("@database/cqltl")
    assert "GET /readyz" in (DOCKER / "haproxy.cfg").read_text(encoding="utf-8")


def test_the_image_is_built_from_what_is_there_and_runs_as_nobody() -> None:
    lines = (DOCKER / "Dockerfile").read_text(encoding="utf-8").replace("\\\n", " ").splitlines()
    stages = [line.split()[1] for line in lines if line.startswith("FROM ")]
    assert stages == ["python:3.11-slim-bookworm"] * 2
    for line in lines:
        if line.startswith("COPY ") and "--from" not in line:
            *sources, _ = [word for word in line.split()[1:] if not word.startswith("--")]
            assert all((ROOT / source).exists() for source in sources), line
    assert [line for line in lines if line.startswith("USER ")] == ["USER cqltl"]
    allowed = {line[1:] for line in (ROOT / ".dockerignore").read_text().splitlines() if line.startswith("!")}
    assert {"pyproject.toml", "models", "service", "migrations", "docker/entrypoint.sh"} <= allowed
    assert all((ROOT / name).exists() for name in allowed)


def test_the_entry_point_copies_what_was_compiled_and_becomes_cqltl(tmp_path: Path) -> None:
    fake = tmp_path / "bin" / "cqltl"
    fake.parent.mkdir()
    fake.write_text('#!/bin/sh\necho "$@" in $$\n')
    fake.chmod(0o755)
    environment = {**os.environ, "PATH": f"{fake.parent}:{os.environ['PATH']}", "NUMBA_CACHE_DIR": str(tmp_path / "c")}
    process = subprocess.Popen(
        [DOCKER / "entrypoint.sh", "worker", "--queues", "plan"], env=environment, stdout=subprocess.PIPE, text=True
    )
    said, _ = process.communicate(timeout=30)
    assert (process.returncode, said) == (0, f"worker --queues plan in {process.pid}\n")


def haproxy() -> str:
    found = shutil.which("haproxy")
    if found is None:
        pytest.skip("no haproxy to read docker/haproxy.cfg (Debian and Ubuntu: apt install haproxy)")
    return found


def test_the_proxy_reads_its_configuration() -> None:
    result = subprocess.run(
        [haproxy(), "-c", "-f", DOCKER / "haproxy.cfg"], capture_output=True, text=True, check=False
    )
    assert result.returncode == 0, result.stderr


def test_the_proxy_starts_where_few_files_may_be_open(tmp_path: Path) -> None:
    """It takes as many connections as it can then."""
    file = tmp_path / "haproxy.cfg"
    text = (DOCKER / "haproxy.cfg").read_text(encoding="utf-8")
    file.write_text(text.replace("bind :8000", f"bind {tmp_path}/socket"))  # no port of this machine
    command = f"ulimit -n 1000 && exec timeout 2 {haproxy()} -d -f {file}"
    result = subprocess.run(["bash", "-c", command], capture_output=True, text=True, check=False)
    assert result.returncode == 124, result.stderr  # it ran until it was stopped
    assert "ALERT" not in result.stderr
