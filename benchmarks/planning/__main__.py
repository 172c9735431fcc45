"""Our planner against Storm, mdpsolver and pymdptoolbox, on the same worlds in the same run.

    python -m benchmarks.planning [--cases CASE ...] [--routes ROUTE ...] [--large] [--repeats 3] [--limit 900]
                                  [--memory GIB] [--json FILE] [--plot FOLDER] [--read FILE]

Needs the extra "bench". Toys worlds with slip 0.1 and the ship task, `F (a & F (a & b))` on the propositions
in(cylinder, box) and at(box, bedroom); and random MDPs with a goal. The routes, each with a policy for every state:

- ours: from the formula to the policy and its likeliest run, on the whole world; "relevant part" with the planner's
  default, which leaves out what the formula cannot depend on; and on the GPU where there is one;
- Storm, LTL: the sparse model of the PRISM program, then the formula's probability;
- Storm, least steps: the sparse model with the automaton in it, then the least expected number of steps;
- Storm, reachability, of random MDPs: the goal's probability in the model that is there already;
- mdpsolver and pymdptoolbox: the least expected number of steps on matrices that are there already.

Compiled world, parsed program, matrices and explicit models are made beforehand, not timed. Storm runs its sound
methods with the default precision, 1e-6 relative.

Every case and route has a process of its own, warmed up on a small world. Time is the median of `--repeats` runs; one
over 30 s is not repeated. Memory is the peak in a run, beyond imports and warm-up. A process is stopped after `--limit`
seconds, or when it asks for more than `--memory`; a route is then not tried on larger worlds of the kind. Where values
differ by more than 1e-5 the status is 1. `--read` shows a file of `--json` again and measures nothing.
"""

from __future__ import annotations

import argparse
import json
import sys
from collections.abc import Iterator, Sequence
from pathlib import Path

from benchmarks.planning.cases import CASES, LARGE, TITLES, Random, case_of, routes
from benchmarks.planning.machine import described, gpu, machine, memory
from benchmarks.planning.measuring import DONE, Result, measure
from benchmarks.planning.plots import draw, sweep_points
from benchmarks.planning.report import mismatches, seconds, tables


def results(options: argparse.Namespace) -> Iterator[Result]:
    """As they are measured, the smaller case before the larger."""
    cases = options.cases or [*CASES, *([LARGE] if options.large else [])]
    beyond: set[tuple[str, bool]] = set()  # routes that are not tried any more, on random MDPs or not
    for case in cases:
        for route in routes(case, gpu=gpu() is not None):
            if (options.routes and route not in options.routes) or (route, isinstance(case, Random)) in beyond:
                continue
            found = measure(
                route,
                case,
                repeats=options.repeats,
                limit_s=options.limit,
                most_bytes=int(options.memory * 2**30),
            )
            said = seconds(found["seconds"]) if found["status"] == DONE else found["status"]
            print(f"{case} {route}: {said}", file=sys.stderr, flush=True)
            if found["status"] != DONE:
                beyond.add((route, isinstance(case, Random)))
            yield found


def show(found: dict[str, object], measured: Sequence[Result]) -> None:
    """Print the machine, the tables and the time of a sweep."""
    print(found["machine"])
    print("\n".join(tables(measured)))
    for toys, points in sweep_points(measured).items():
        said = ", ".join(f"{states:,}: {ns:.2f}" for states, ns in points)
        print(f"\nours, ns a product state and sweep, {toys} toys: {said}")


def main(arguments: Sequence[str] | None = None) -> int:
    """Measure and print the tables; 1 if values differ."""
    options = _options(arguments)
    if options.read:
        found = json.loads(options.read.read_text(encoding="utf-8"))
    else:
        found = {"machine": described(machine()), "repeats": options.repeats, "results": list(results(options))}
    measured: list[Result] = found["results"]
    show(found, measured)
    if options.json:
        options.json.write_text(json.dumps(found, indent=1) + "\n", encoding="utf-8")
    if options.plot:
        draw(measured, options.plot)
    wrong = mismatches(measured)
    for line in wrong:
        print(f"values differ: {line}", file=sys.stderr)
    return 1 if wrong else 0


def _options(arguments: Sequence[str] | None) -> argparse.Namespace:
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0] if __doc__ else None)
    parser.add_argument("--cases", nargs="+", type=case_of, help="such as ship-4x4-3 or random-100000")
    parser.add_argument("--routes", nargs="+", choices=TITLES)
    parser.add_argument("--large", action="store_true", help=f"with {LARGE}, which is for ours only")
    parser.add_argument("--repeats", type=int, default=3)
    parser.add_argument("--limit", type=float, default=900.0, help="seconds of a process")
    parser.add_argument("--memory", type=float, default=0.8 * memory() / 2**30, help="GiB of a process")
    parser.add_argument("--json", type=Path)
    parser.add_argument("--plot", type=Path, help="folder for the figures")
    parser.add_argument("--read", type=Path)
    return parser.parse_args(arguments)


if __name__ == "__main__":
    sys.exit(main())
