"""Requests that Schemathesis makes up from openapi.yaml: no answer is 5xx, and each is as it is documented.

A few, the same in every run; `make schemathesis` does it for ten minutes, or CQLTL_SCHEMATHESIS_S seconds, with
requests never seen before.
"""

from __future__ import annotations

import os
import random
import subprocess
import sys
from pathlib import Path

import pytest

from benchmarks.server import serving

DOCUMENT = Path(__file__).parents[3] / "openapi.yaml"
PROGRAM = Path(sys.executable).with_name("schemathesis")
LEFT_OUT = (
    "positive_data_acceptance",  # what fits the schema may yet mean nothing: a formula, a name, a world
    "ignored_auth",
    "ensure_resource_availability",  # an Idempotency-Key that comes again is answered 201, also after a DELETE
)
CONFIG = """
[checks]
negative_data_rejection.expected-statuses = [400, 401, 403, 404, 405, 406, 409, 413, 415, 422, 428, 429, 431, "5xx"]
"""
"""Its own list, and 413 and 431: what is too long by the schema may be too long for a body or a head, and is refused as
that first.
"""


def run(folder: Path, *options: str) -> None:
    """Run it against a server of its own; a failure says which requests it was."""
    (folder / "schemathesis.toml").write_text(CONFIG)
    with serving(folder / "store") as client:
        command = [PROGRAM, "run", DOCUMENT, "--url", str(client.base_url).rstrip("/"), "--no-color"]
        further = ["--exclude-checks", ",".join(LEFT_OUT), "--suppress-health-check", "all", "--warnings", "off"]
        said = ["--continue-on-failure", *further, *options]
        result = subprocess.run([*command, *said], cwd=folder, capture_output=True, text=True, check=False)
    lines = [line[:500] for line in result.stdout.splitlines()]  # a failure may be a body of a megabyte
    assert result.returncode == 0, "\n".join(lines)[-20_000:] + result.stderr
    assert "Tested: 0" not in result.stdout


def test_a_short_run(tmp_path: Path) -> None:
    run(tmp_path, "--generation-deterministic", "--max-examples", "5", "--phases", "examples,fuzzing")


@pytest.mark.long
def test_a_long_run(tmp_path: Path) -> None:
    seconds = os.environ.get("CQLTL_SCHEMATHESIS_S", "600")
    seed = str(random.SystemRandom().randrange(1_000_000))
    run(tmp_path, "--seed", seed, "--max-examples", "200", "--max-time", seconds)
