"""The paper's Table II: both sentences planned on a 4x1 grid, as whole HTTP requests.

    python -m benchmarks.table2 [--repeats 20] [--json FILE]

The paper gives 6 min 3.7 s for the ship sentence and 1 min 41 s for the pickup sentence at "4x1", without saying how
many toys there were, so 1 to 4 are measured. Each row is the median over `--repeats` requests, after one that is not
counted. "New world" sends the environment within the request, under a name that was never sent before, so nothing of it
is cached: translate, ground, compile, plan, store the policy, answer. "Stored world" names a stored environment.
"""

from __future__ import annotations

import argparse
import json
import platform
import statistics
import time
from pathlib import Path
from typing import Any

import httpx

from benchmarks.server import serving
from models.world import toys_spec

SHAPES = ("cylinder", "sphere", "cube", "cone")
SENTENCES = {
    "ship": (
        "Put the cylinder in the box, then put the box in the bedroom",
        ("cylinder", "sphere", "cube", "cone"),
    ),
    "pickup": ("Pickup the sphere", ("sphere", "cylinder", "cube", "cone")),
}
PAPER_S = {"ship": 363.72, "pickup": 101.185}


def world(name: str, shapes: tuple[str, ...]) -> dict[str, Any]:
    """A 4x1 grid with one toy of each shape, one of them the toy of the sentence, and no slip."""
    spec = toys_spec(columns=4, rows=1, toys=[(shape, "red") for shape in shapes], slip=0.0)
    return {**spec, "name": name}


def measure(client: httpx.Client, body: dict[str, Any]) -> tuple[float, dict[str, Any]]:
    """Seconds of one request, and its answer, which must be a plan."""
    started = time.perf_counter()
    response = client.post("/plan", json=body)
    seconds = time.perf_counter() - started
    response.raise_for_status()
    answer: dict[str, Any] = response.json()
    if answer["outcome"] != "solved":
        raise RuntimeError(f"{body} is {answer['outcome']}")
    return seconds, answer


def row(client: httpx.Client, task: str, toys: int, repeats: int) -> dict[str, Any]:
    """Both medians of one sentence with one number of toys."""
    text, shapes = SENTENCES[task]
    fresh, stored = [], []
    name = f"{task}-{toys}"
    client.post("/environments", json=world(name, shapes[:toys])).raise_for_status()
    for number in range(repeats + 1):
        spec = world(f"{name}-{number}", shapes[:toys])
        fresh.append(measure(client, {"text": text, "environment_spec": spec})[0])
        seconds, answer = measure(client, {"text": text, "environment": name})
        stored.append(seconds)
    return {
        "task": task,
        "toys": toys,
        "states": answer["model"]["states"],
        "expected_steps": answer["expected_steps"],
        "new_world_s": statistics.median(fresh[1:]),
        "stored_world_s": statistics.median(stored[1:]),
        "paper_s": PAPER_S[task],
    }


def main() -> None:
    """Measure and print the table."""
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0] if __doc__ else None)
    parser.add_argument("--repeats", type=int, default=20)
    parser.add_argument("--json", type=Path)
    options = parser.parse_args()
    with serving() as client:
        rows = [row(client, task, toys, options.repeats) for task in SENTENCES for toys in (1, 2, 3, 4)]
    print(f"median of {options.repeats} requests; Python {platform.python_version()}, {platform.machine()}\n")
    print("| task | toys | states | steps | new world | stored world | paper |")
    print("|---|---|---|---|---|---|---|")
    for r in rows:
        new, stored = (f"{r[name] * 1000:.1f} ms" for name in ("new_world_s", "stored_world_s"))
        size = f"{r['toys']} | {r['states']:,} | {r['expected_steps']:g}"
        print(f"| {r['task']} | {size} | {new} | {stored} | {r['paper_s']:.1f} s |")
    if options.json:
        options.json.write_text(json.dumps(rows, indent=2) + "\n", encoding="utf-8")


if __name__ == "__main__":
    main()
