"""Routes measured in processes of their own, which may crash or take too long."""

from __future__ import annotations

import json
import signal
import statistics
import subprocess
import sys
import tempfile
from collections.abc import Sequence
from typing import Any

from benchmarks.planning.cases import Case

Result = dict[str, Any]
"""case, route, status; where a run was done also seconds, parts, bytes, values, notes and runs."""
DONE = "done"


def measure(route: str, case: Case, *, repeats: int, limit_s: float, most_bytes: int) -> Result:
    """The medians of one route on one case, or why there are none."""
    command = [sys.executable, "-m", "benchmarks.planning.child", route, str(case)]
    command += ["--repeats", str(repeats), "--bytes", str(most_bytes)]
    with tempfile.TemporaryFile("w+") as out, tempfile.TemporaryFile("w+") as errors:
        with subprocess.Popen(command, stdout=out, stderr=errors) as process:
            try:
                process.wait(limit_s)
            except subprocess.TimeoutExpired:
                process.kill()
                ended = f"over {limit_s:g} s"
            else:
                ended = DONE
        out.seek(0)
        errors.seek(0)
        runs = [json.loads(line) for line in out if line.startswith("{")]
        if ended == DONE and process.returncode:
            ended = failure(process.returncode, errors.read())
    return summary(str(case), route, runs, ended)


def failure(status: int, errors: str) -> str:
    """Why a process ended, in a few words."""
    if any(sign in errors for sign in ("MemoryError", "bad_alloc", "Cannot allocate memory")):
        return "out of memory"
    if "ModelTooLargeError" in errors:
        return "refused"
    if status < 0:
        return f"killed by {signal.Signals(-status).name}"
    last = errors.strip().splitlines()[-1:] or [f"status {status}"]
    return f"failed: {last[0][:200]}"


def summary(case: str, route: str, runs: Sequence[Result], ended: str) -> Result:
    """What is kept of some runs; those that were done count, however the process ended."""
    result: Result = {"case": case, "route": route, "status": DONE if runs else ended}
    if not runs:
        return result
    parts = {part: statistics.median(run["seconds"][part] for run in runs) for part in runs[0]["seconds"]}
    totals = [sum(run["seconds"].values()) for run in runs]
    return {
        **result,
        "seconds": statistics.median(totals),
        "parts": parts,
        "bytes": max(run["bytes"] for run in runs),
        "values": runs[-1]["values"],
        "notes": runs[-1]["notes"],
        "runs": totals,
    }
