"""The paper's experiments, and those of the default translator.

    python -m models.language.evaluate                   everything: trains what is not in the folder of runs
    python -m models.language.evaluate --only default    the default translator only; the rest of the results stays
    python -m models.language.evaluate --quick           a few commands and epochs, to see that it works; a minute
    python -m models.language.evaluate --report          the figures and tables again, from the results that are there

Writes `results.json` and the figures into the folder `--output`, the tables into the page `--page`, and prints them.
Trained runs are kept in the folder `--runs` and not trained again. One thread.
"""

from __future__ import annotations

import argparse
from collections.abc import Sequence
from pathlib import Path

import torch
from tqdm import tqdm

from models.language.experiments import (
    DefaultSystem,
    Runs,
    Settings,
    default_part,
    default_steps,
    paper_part,
    paper_steps,
    read_results,
    tables,
    trained_system,
    write_page,
    write_results,
)

PARTS = ("paper", "default")


def main(arguments: Sequence[str] | None = None) -> None:
    """Read the command line, train and measure, write and print."""
    options = _read_options(arguments)
    torch.set_num_threads(1)
    settings = Settings(seeds=tuple(options.seeds), most=options.most)
    if options.quick:
        settings = settings.quick()
    results = read_results(options.output)
    if not options.report:
        _measure(results, [options.only] if options.only else PARTS, settings, options.runs)
    results = {part: results[part] for part in PARTS if part in results}
    written = write_results(results, options.output)
    if options.page and all(part in results for part in PARTS):
        write_page(results, options.page)
        written.append(options.page)
    for name, table in tables(results).items():
        print(f"\n{name}\n\n{table}")
    print("\nwritten:", *written, sep="\n  ")


def _measure(results: dict[str, object], parts: Sequence[str], settings: Settings, runs: Path) -> None:
    """Measure some parts and put them into the results, in place of what they had."""
    steps = {"paper": paper_steps(settings), "default": default_steps(settings)}
    with tqdm(total=sum(steps[part] for part in parts), unit="step", dynamic_ncols=True) as bar:

        def done(what: str) -> None:
            bar.set_postfix_str(what, refresh=False)
            bar.update()

        def system(seed: int) -> DefaultSystem:
            return trained_system(seed, settings.spans, runs, done)

        if "paper" in parts:
            results["paper"] = paper_part(settings, Runs(runs), done)
        if "default" in parts:
            results["default"] = default_part(settings, system, done)


def _read_options(arguments: Sequence[str] | None) -> argparse.Namespace:
    parser = argparse.ArgumentParser(description="The paper's experiments, and those of the default translator.")
    parser.add_argument("--only", choices=PARTS, help="measure one part; what there is of the other stays")
    parser.add_argument("--seeds", type=int, nargs="+", default=list(Settings().seeds), help="seeds of training")
    parser.add_argument("--most", type=int, help="commands of each task class of S and U; all if not given")
    parser.add_argument("--quick", action="store_true", help="a tiny run to see that everything works")
    parser.add_argument("--report", action="store_true", help="measure nothing: figures and tables of the results")
    parser.add_argument("--runs", type=Path, help="folder of trained runs; build/experiments if not given")
    parser.add_argument("--output", type=Path, help="folder of results and figures; docs/experiments if not given")
    parser.add_argument("--page", type=Path, help="page with the tables; docs/experiments.md if not given")
    options = parser.parse_args(arguments)
    if options.quick:
        options.runs = options.runs or Path("build/experiments-quick")
        options.output = options.output or options.runs / "results"
    else:
        options.page = options.page or Path("docs/experiments.md")
    options.runs = options.runs or Path("build/experiments")
    options.output = options.output or Path("docs/experiments")
    return options


if __name__ == "__main__":
    main()
