"""The log: each line is one, and says what it is about."""

from __future__ import annotations

import json
import logging
import os
import subprocess
import sys
from pathlib import Path

import httpx
import pytest

from benchmarks.server import address
from service.logs import JOB_ID, REQUEST_ID, JsonFormatter, LogFormat, TextFormatter, configure


def record(message: str, *arguments: object, failed: bool = False) -> logging.LogRecord:
    try:
        raise RuntimeError("why")
    except RuntimeError:
        return logging.LogRecord(
            "cqltl", logging.WARNING, "", 1, message, arguments, sys.exc_info() if failed else None
        )


def test_json_lines() -> None:
    REQUEST_ID.set("r1")
    found = record("%s\nsaid", "é")
    found.fields = {"status": 200}
    line = JsonFormatter().format(found)
    assert "\n" not in line
    values = json.loads(line)
    assert values.pop("time").endswith("+00:00")
    assert values == {"level": "warning", "logger": "cqltl", "message": "é\nsaid", "request_id": "r1", "status": 200}
    JOB_ID.set("j1")
    assert json.loads(JsonFormatter().format(record("")))["job_id"] == "j1"
    REQUEST_ID.set(None)
    JOB_ID.set(None)
    assert "RuntimeError: why" in json.loads(JsonFormatter().format(record("", failed=True)))["exception"]


def test_text_lines() -> None:
    REQUEST_ID.set("r1")
    line = TextFormatter().format(record("one\ntwo"))
    assert line.endswith("warning cqltl: one\\ntwo request_id=r1")
    assert "\n" not in line
    JOB_ID.set("j1")
    assert TextFormatter().format(record("one")).endswith("warning cqltl: one request_id=r1 job_id=j1")
    JOB_ID.set(None)
    REQUEST_ID.set(None)
    assert TextFormatter().format(record("x", failed=True)).endswith("RuntimeError: why")


@pytest.mark.parametrize(("form", "kind"), [("json", JsonFormatter), ("text", TextFormatter)])
def test_the_form_of_the_log_is_chosen(
    form: LogFormat, kind: type[logging.Formatter], monkeypatch: pytest.MonkeyPatch
) -> None:
    root = logging.getLogger()
    monkeypatch.setattr(root, "handlers", list(root.handlers))
    monkeypatch.setattr(root, "level", root.level)
    configure(form, "info")
    (handler,) = root.handlers
    assert type(handler.formatter) is kind


def test_a_server_logs_requests_with_their_ids(tmp_path: Path) -> None:
    with subprocess.Popen(
        [sys.executable, "-m", "service", "serve", "--port", "0"],
        env={**os.environ, "CQLTL_DATA_DIR": str(tmp_path), "CQLTL_LOG_FORMAT": "json", "CQLTL_LOG_LEVEL": "info"},
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
    ) as process:
        url = address(process)
        httpx.get(f"{url}/livez", headers={"X-Request-Id": "one"})
        asked = {"ltl": "F holding(sphere)", "environment": "toys-4x1-sphere"}
        headers = {"Prefer": "respond-async", "X-Request-Id": "two"}
        job = httpx.post(f"{url}/plan", json=asked, headers=headers, timeout=60).json()
        process.terminate()
        _, said = process.communicate(timeout=30)
    lines = [line for line in said.splitlines() if "/livez" in line or "/plan" in line]
    first, second = map(json.loads, lines)
    assert (first["request_id"], first["method"], first["path"], first["status"]) == ("one", "GET", "/livez", 200)
    assert "job_id" not in first
    assert (second["request_id"], second["job_id"], second["status"]) == ("two", job["id"], 202)
