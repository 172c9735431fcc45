"""How long a server takes to listen, and its first requests to be answered.

    python -m benchmarks.startup [--repeats 5] [--json FILE]

A row each for a new store, which is given the built-in environments and templates first, and for a store that was used
before. Medians and worst of `--repeats` servers, one at a time. The first requests are sent at once when the server
listens, and the same again.
"""

from __future__ import annotations

import argparse
import json
import platform
import statistics
import tempfile
import time
from collections.abc import Sequence
from pathlib import Path

import httpx

from benchmarks.server import address, started

MEASURED = ("start", "first translate", "second translate", "first plan", "second plan")
BODY = {"text": "Pickup the sphere", "environment": "toys"}


def run(folder: Path) -> list[float]:
    """Start a server with its store in a folder; seconds of each of `MEASURED`."""
    began = time.perf_counter()
    with started(folder) as process, httpx.Client(base_url=address(process), timeout=300) as client:
        seconds = [time.perf_counter() - began]
        for path in ("/translate", "/translate", "/plan", "/plan"):
            began = time.perf_counter()
            client.post(path, json=BODY).raise_for_status()
            seconds.append(time.perf_counter() - began)
    return seconds


def main(arguments: Sequence[str] | None = None) -> None:
    """Measure and print the table."""
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0] if __doc__ else None)
    parser.add_argument("--repeats", type=int, default=5)
    parser.add_argument("--json", type=Path)
    options = parser.parse_args(arguments)
    runs: dict[str, list[list[float]]] = {"new": [], "used": []}
    for _ in range(options.repeats):
        with tempfile.TemporaryDirectory() as folder:
            for found in runs.values():  # the second finds what the first left
                found.append(run(Path(folder)))
    print(f"median (worst) of {options.repeats} servers; Python {platform.python_version()}, {platform.machine()}\n")
    print(f"| store | {' | '.join(MEASURED)} |")
    print("|---" * (len(MEASURED) + 1) + "|")
    for store, found in runs.items():
        columns = (f"{statistics.median(column):.3f} s ({max(column):.3f})" for column in zip(*found, strict=True))
        print(f"| {store} | {' | '.join(columns)} |")
    if options.json:
        rows = {store: [dict(zip(MEASURED, each, strict=True)) for each in found] for store, found in runs.items()}
        options.json.write_text(json.dumps(rows, indent=1) + "\n", encoding="utf-8")


if __name__ == "__main__":
    main()
