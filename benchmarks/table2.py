"""The paper's Table II: both sentences planned on a 4x1 grid, as whole HTTP requests; and a sweep of larger worlds.

    python -m benchmarks.table2 [--sweep] [--limit 60] [--repeats 20] [--json FILE]

The paper gives 6 min 3.7 s for the ship sentence and 1 min 41 s for the pickup sentence at "4x1", without saying how
many toys there were, so 1 to 4 are measured. `--sweep` measures grids from 4x1 to 6x6 with 1 to 3 toys instead, and
leaves out the larger worlds of a sentence once a plan takes longer than `--limit` seconds or needs more states than the
service allows by default.

Each row is the median over `--repeats` requests, after one that is not counted; fewer when they are slow: none is begun
after 20 s. "New world" sends the environment within the request, under a name that was never sent before, so nothing of
it is cached: translate, ground, compile, plan, store the policy, answer. "Stored world" names a stored environment.
"""

from __future__ import annotations

import argparse
import json
import platform
import statistics
import time
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import httpx

from benchmarks.server import serving
from models.world import toys_spec

SHAPES = {"ship": ("cylinder", "sphere", "cube", "cone"), "pickup": ("sphere", "cylinder", "cube", "cone")}
"""The toys of a world, in order of number; the first is the one of the sentence."""
SENTENCES = {"ship": "Put the cylinder in the box, then put the box in the bedroom", "pickup": "Pickup the sphere"}
PAPER_S = {"ship": 363.72, "pickup": 101.185}
PAPER_GRID = (4, 1)
SWEEP = ((4, 1), (2, 2), (3, 3), (4, 4), (5, 5), (6, 6))
ENOUGH_S = 20.0
REFUSALS = ("out-of-time", "model-too-large", "overloaded")


class BeyondError(Exception):
    """A plan took too long or too much room; the text is the slug of the refusal."""


@dataclass(frozen=True, slots=True)
class Size:
    """A world: a grid with one toy of each of so many shapes, a box, and no slip."""

    grid: tuple[int, int]
    toys: int

    def spec(self, task: str, name: str) -> dict[str, Any]:
        """The data of the environment, with the toy of the task's sentence."""
        columns, rows = self.grid
        toys = [(shape, "red") for shape in SHAPES[task][: self.toys]]
        return {**toys_spec(columns=columns, rows=rows, toys=toys, slip=0.0), "name": name}


def sizes(*, sweep: bool) -> list[Size]:
    """The worlds of the table, or of the sweep, the smaller before the larger of the same number of toys."""
    if not sweep:
        return [Size(PAPER_GRID, toys) for toys in (1, 2, 3, 4)]
    return [Size(grid, toys) for toys in (1, 2, 3) for grid in SWEEP]


def measure(client: httpx.Client, body: dict[str, Any]) -> tuple[float, dict[str, Any]]:
    """Seconds of one request, and its answer, which must be a plan; raises `BeyondError`."""
    started = time.perf_counter()
    response = client.post("/plan", json=body)
    seconds = time.perf_counter() - started
    answer: dict[str, Any] = response.json()
    slug = answer.get("type", "").rpartition(":")[2]
    if slug in REFUSALS:
        raise BeyondError(slug)
    response.raise_for_status()
    if answer["outcome"] != "solved":
        raise RuntimeError(f"{body} is {answer['outcome']}")
    return seconds, answer


def median(ask: Callable[[int], tuple[float, dict[str, Any]]], repeats: int) -> tuple[float, dict[str, Any]]:
    """The median seconds of up to `repeats` requests after the first, and the last answer.

    A request that is slow by itself is counted at once: what is done only once is a small part of it.
    """
    first, answer = ask(0)
    taken = [first] if first > ENOUGH_S else []
    spent = 0.0
    while len(taken) < repeats and spent < ENOUGH_S and first <= ENOUGH_S:
        seconds, answer = ask(len(taken) + 1)
        taken.append(seconds)
        spent += seconds
    return statistics.median(taken), answer


def row(client: httpx.Client, task: str, size: Size, options: argparse.Namespace) -> dict[str, Any]:
    """Both medians of one sentence in one world; raises `BeyondError`."""
    name = f"{task}-{'x'.join(map(str, size.grid))}-{size.toys}"
    limit = {"options": {"timeout_s": options.limit}}
    text = SENTENCES[task]

    def ask_new(number: int) -> tuple[float, dict[str, Any]]:
        return measure(client, {"text": text, "environment_spec": size.spec(task, f"{name}-{number}"), **limit})

    def ask_stored(_number: int) -> tuple[float, dict[str, Any]]:
        return measure(client, {"text": text, "environment": name, **limit})

    client.post("/environments", json=size.spec(task, name)).raise_for_status()
    new_s, _ = median(ask_new, options.repeats)
    stored_s, answer = median(ask_stored, options.repeats)
    return {
        "task": task,
        "grid": "x".join(map(str, size.grid)),
        "toys": size.toys,
        "states": answer["model"]["states"],
        "expected_steps": answer["expected_steps"],
        "new_world_s": new_s,
        "stored_world_s": stored_s,
        "paper_s": PAPER_S[task] if size.grid == PAPER_GRID else None,
    }


def rows(client: httpx.Client, options: argparse.Namespace) -> Iterator[dict[str, Any]]:
    """The rows of both sentences, as they are measured."""
    for task in SENTENCES:
        beyond: set[int] = set()  # numbers of toys for which no larger grid is tried
        for size in sizes(sweep=options.sweep):
            if size.toys in beyond:
                continue
            try:
                yield row(client, task, size, options)
            except BeyondError as error:
                beyond.add(size.toys)
                yield {"task": task, "grid": "x".join(map(str, size.grid)), "toys": size.toys, "beyond": str(error)}


def line(found: dict[str, Any]) -> str:
    """A row as markdown."""
    start = f"| {found['task']} | {found['grid']} | {found['toys']} "
    if "beyond" in found:
        return f"{start}| | | {found['beyond']} | | |"
    new, stored = (f"{found[name] * 1000:,.1f} ms" for name in ("new_world_s", "stored_world_s"))
    paper = "" if found["paper_s"] is None else f"{found['paper_s']:.1f} s"
    return f"{start}| {found['states']:,} | {found['expected_steps']:g} | {new} | {stored} | {paper} |"


def main(arguments: Sequence[str] | None = None) -> None:
    """Measure and print the table."""
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0] if __doc__ else None)
    parser.add_argument("--sweep", action="store_true", help="worlds of many sizes instead of the paper's")
    parser.add_argument("--limit", type=float, default=60.0, help="longest plan, in seconds")
    parser.add_argument("--repeats", type=int, default=20)
    parser.add_argument("--json", type=Path)
    options = parser.parse_args(arguments)
    print(f"median of {options.repeats} requests; Python {platform.python_version()}, {platform.machine()}\n")
    print("| task | grid | toys | states | steps | new world | stored world | paper |")
    print("|---|---|---|---|---|---|---|---|")
    found = []
    wait = str(2 * options.limit)
    with serving(CQLTL_PLAN_TIMEOUT_S=str(options.limit), CQLTL_WAIT_S=wait, CQLTL_MAX_WAIT_S=wait) as client:
        for each in rows(client, options):
            found.append(each)
            print(line(each), flush=True)
    if options.json:
        options.json.write_text(json.dumps(found, indent=2) + "\n", encoding="utf-8")


if __name__ == "__main__":
    main()
