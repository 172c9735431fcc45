"""One route on one case, in a process of its own.

    python -m benchmarks.planning.child ROUTE CASE [--repeats 3] [--bytes N]

Prints a line of JSON for each run, as it is done. Memory is the most that was resident in a run, less what was after
the imports and the warm-up: what there is beforehand counts, what was needed to make it does not.
"""

from __future__ import annotations

import argparse
import json
import resource
from collections.abc import Callable, Sequence
from dataclasses import asdict
from pathlib import Path

from benchmarks.planning.cases import case_of
from benchmarks.planning.run import Limits, Run, prepares

SLOW_S = 30.0
"""A run that takes longer is not repeated."""


def resident(*, peak: bool = False) -> int:
    """Bytes of this process that are in memory, or the most that were since `forget_peak`.

    Linux only. `ru_maxrss` would not do: it cannot be reset, and begins with what the parent process had.
    """
    name = "VmHWM:" if peak else "VmRSS:"
    lines = Path("/proc/self/status").read_text(encoding="utf-8").splitlines()
    return next(int(line.split()[1]) for line in lines if line.startswith(name)) * 1024


def forget_peak() -> None:
    """Begin to look for the peak anew."""
    Path("/proc/self/clear_refs").write_text("5", encoding="ascii")


def measure(run: Callable[[], Run], repeats: int, base: int) -> None:
    """Run and print, once if it is slow."""
    for _ in range(repeats):
        forget_peak()
        found = run()
        print(json.dumps({**asdict(found), "bytes": max(0, resident(peak=True) - base)}), flush=True)
        if sum(found.seconds.values()) > SLOW_S:
            return


def main(arguments: Sequence[str] | None = None) -> None:
    """Warm up and measure."""
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0] if __doc__ else None)
    parser.add_argument("route", choices=prepares())
    parser.add_argument("case", type=case_of)
    parser.add_argument("--repeats", type=int, default=3)
    parser.add_argument("--bytes", type=int, default=2**33, help="most memory")
    options = parser.parse_args(arguments)
    limits = Limits(options.bytes)
    prepare = prepares()[options.route]()
    if not options.route.startswith("ours"):  # ours refuses beforehand, and a GPU's driver maps more than there is
        resource.setrlimit(resource.RLIMIT_DATA, (options.bytes, options.bytes))
    prepare(options.case.small, limits)()
    base = resident()
    measure(prepare(options.case, limits), options.repeats, base)


if __name__ == "__main__":
    main()
