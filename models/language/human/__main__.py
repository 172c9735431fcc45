"""Train and test the default translator's networks on commands that people wrote.

    python -m models.language.human --data FOLDER               everything
    python -m models.language.human --data FOLDER --only pick   one set of commands; the results of the others stay
    python -m models.language.human --data FOLDER --quick       a few commands and epochs, to see that it works
    python -m models.language.human --report                    the table again, from the results that are there

The folder holds the published files, which are not part of this repository; where to get them is said when one is
missing. Writes the results into `--output`, the table into `--page`, and prints it. One thread.
"""

from __future__ import annotations

import argparse
import json
import sys
import time
from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path
from typing import Any

import torch

from models.language.human.data import HumanDataError
from models.language.human.evaluation import PARTS, Extent, commands_part, record, utterances_part
from models.language.human.system import Plan
from models.language.human.tables import human_table, write_table


def main(arguments: Sequence[str] | None = None) -> None:
    """Read the command line, train and measure, write and print."""
    options = _read_options(arguments)
    torch.set_num_threads(1)
    results = json.loads(options.output.read_text(encoding="utf-8")) if options.output.exists() else {}
    if not options.report:
        _measure(results, options)
    if options.page:
        write_table(results, options.page)
    print(human_table(results))


def _measure(results: dict[str, Any], options: argparse.Namespace) -> None:
    """Measure some parts, and write the results after each, of Lang2LTL after each seed."""
    extent = Extent(seeds=tuple(options.seeds))
    if options.quick:
        plan = Plan(settings=replace(extent.plan.settings, epochs=1), drawn=200)
        extent = Extent(seeds=(0,), plan=plan, splits=1, tested=50)
    began = time.monotonic()

    def log(message: str) -> None:
        print(f"{time.monotonic() - began:6.0f} s  {message}", file=sys.stderr, flush=True)

    def keep(part: str, found: dict[str, Any]) -> None:
        results[part], results["record"] = found, record(extent)
        options.output.parent.mkdir(parents=True, exist_ok=True)
        options.output.write_text(json.dumps(results, indent=1, sort_keys=True) + "\n", encoding="utf-8")

    for part in [options.only] if options.only else PARTS:
        try:
            if part == "lang2ltl":
                utterances_part(options.data, extent, log, lambda found: keep("lang2ltl", found))
            else:
                keep(part, commands_part(options.data, part, extent, log))
        except HumanDataError as error:
            sys.exit(str(error))


def _read_options(arguments: Sequence[str] | None) -> argparse.Namespace:
    parser = argparse.ArgumentParser(description="The default translator's networks on commands that people wrote.")
    parser.add_argument("--data", type=Path, help="folder with the published files")
    parser.add_argument("--only", choices=PARTS, help="measure one part; what there is of the others stays")
    parser.add_argument("--seeds", type=int, nargs="+", default=list(Extent().seeds), help="seeds of random splits")
    parser.add_argument("--quick", action="store_true", help="a tiny run to see that everything works")
    parser.add_argument("--report", action="store_true", help="measure nothing: the table of the results")
    parser.add_argument("--output", type=Path, help="file of results; docs/experiments/human.json if not given")
    parser.add_argument("--page", type=Path, help="page with the table; docs/experiments.md if not given")
    options = parser.parse_args(arguments)
    if options.data is None and not options.report:
        parser.error("--data is needed: the folder with the published files")
    if not options.quick:
        options.page = options.page or Path("docs/experiments.md")
    options.output = options.output or Path(
        "build/human-quick.json" if options.quick else "docs/experiments/human.json"
    )
    return options


if __name__ == "__main__":
    main()
