"""How much a hostile formula slows the requests of others.

    python -m benchmarks.hostile [--requests 100]

Times POST /translate on a server of its own, alone and while plans of formulas made to be hard run one after the other:
the median and the 95th percentile, and the ratio of the medians. Prints how each formula ended.
"""

from __future__ import annotations

import argparse
import statistics
import threading
import time
from collections.abc import Sequence

import httpx

from benchmarks.server import serving

TEXT = {"text": "Put the cylinder in the box, then put the box in the bedroom", "environment": "toys"}
CELLS = ("kitchen", "bedroom", "bathroom", "living_room")
HOSTILE = (
    " & ".join(f"F (at(robot, kitchen) & {'X ' * i}at(robot, bedroom))" for i in range(10)),
    f"G (at(robot, kitchen) -> {'X ' * 20}at(robot, bedroom))",
    f"F G (at(robot, kitchen) | {'X ' * 12}at(robot, bedroom))",
    "X " * 190 + "at(robot, kitchen)",
    " <-> ".join(f"G F at(robot, {cell})" for cell in CELLS),
    "!" * 60_000 + "at(robot, kitchen)",
)
TIMEOUT_S = 5.0


def timed(client: httpx.Client, requests: int) -> list[float]:
    """Milliseconds of each request."""
    taken = []
    for _ in range(requests):
        began = time.perf_counter()
        client.post("/translate", json=TEXT).raise_for_status()
        taken.append((time.perf_counter() - began) * 1000)
    return taken


def attack(address: str, formulas: Sequence[str], ends: list[str], over: threading.Event) -> None:
    """Plan the formulas one after the other, again and again until it is over."""
    with httpx.Client(base_url=address, timeout=120) as client:
        while not over.is_set():
            for number, formula in enumerate(formulas):
                began = time.perf_counter()
                body = {"ltl": formula, "environment": "toys", "options": {"timeout_s": TIMEOUT_S}}
                answer = client.post("/plan", json=body).json()
                end = answer.get("outcome") or answer["type"].rsplit(":", 1)[-1]
                ends.append(f"{number}: {formula[:50]}... {end} after {time.perf_counter() - began:.1f} s")
                if over.is_set():
                    return


def main(arguments: Sequence[str] | None = None) -> None:
    """Measure and print."""
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0] if __doc__ else None)
    parser.add_argument("--requests", type=int, default=100)
    options = parser.parse_args(arguments)
    ends: list[str] = []
    with serving(CQLTL_WAIT_S=str(4 * TIMEOUT_S)) as client:
        timed(client, 20)
        alone = timed(client, options.requests)
        over = threading.Event()
        attacker = threading.Thread(target=attack, args=(str(client.base_url), HOSTILE, ends, over))
        attacker.start()
        meanwhile: list[float] = []
        while len(ends) < len(HOSTILE):  # at least one of each
            meanwhile += timed(client, options.requests)
        over.set()
        attacker.join()
    for line in ends[: len(HOSTILE)]:
        print(line)
    for name, taken in (("alone", alone), ("meanwhile", meanwhile)):
        print(f"{name}: median {statistics.median(taken):.1f} ms, p95 {statistics.quantiles(taken, n=20)[-1]:.1f} ms")
    print(f"ratio of the medians: {statistics.median(meanwhile) / statistics.median(alone):.2f}")


if __name__ == "__main__":
    main()
