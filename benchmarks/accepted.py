"""Whether every command that is understood can be planned for: its formula is read back, and planned in its world.

    python -m benchmarks.accepted [--part development|held-out|both] [--limit 2] [--most N]

All commands of the sets of `benchmarks.language` and `benchmarks.teaching` are translated. Of each that means something
in its world the formula is printed, parsed, resolved, and planned for, with so many seconds for the sweeps; a plan
short of time has the bounds that were reached. What is refused is listed with the reason.
"""

from __future__ import annotations

import argparse
import random
import time
from collections import Counter
from collections.abc import Iterator

from tqdm import tqdm

from benchmarks import language, teaching
from models.errors import CqltlError
from models.logic import Formula, parse, to_text
from models.planning import Options, plan
from models.queries import resolve_grounded
from models.world import Environment


def understood(parts: tuple[language.Part, ...]) -> Iterator[tuple[str, Formula, Environment]]:
    """Every command of the sets that means something, with its formula and its world."""
    bench = language.Bench.load()
    for part in parts:
        for name in ("compositions", "valid"):
            for item in language.read(name, part):
                environment = bench.environments[item["environment"]]
                found = bench.formula(item["text"], environment)
                if found is not None and found != "unknown":
                    yield item["text"], found, environment
    taught = teaching.Bench(parts)
    generator = random.Random(0)
    hearing, _ = taught.taught((1,), generator)
    for task in taught.tasks:
        environment = taught.worlds[task.world]
        for wording in task.wordings:
            text = teaching.filled(wording, generator.choice(task.queries))
            found_readings = hearing.readings(text, environment, candidates=1)
            if found_readings and found_readings[0].grounded is not None:
                yield text, found_readings[0].grounded.formula, environment


def outcome(formula: Formula, environment: Environment, limit: float) -> str:
    """How planning for a formula ended: the plan's outcome, or the slug and the sentence of a refusal."""
    started = time.monotonic()
    options = Options(hurry=lambda _stage: time.monotonic() - started > limit)
    try:
        read = resolve_grounded(parse(to_text(formula)), environment)
        return str(plan(environment.world, read, options=options).outcome)
    except CqltlError as error:
        return f"{error.slug}: {error.detail}"


def main() -> None:
    """Print how many are accepted."""
    parser = argparse.ArgumentParser(description="Whether every command that is understood can be planned for.")
    parser.add_argument("--part", choices=[*language.PARTS, "both"], default="both")
    parser.add_argument("--limit", type=float, default=2.0, help="seconds for the sweeps of a plan")
    parser.add_argument("--most", type=int, help="commands; all if not given")
    options = parser.parse_args()
    commands = list(understood(language.PARTS if options.part == "both" else (options.part,)))[: options.most]
    ends: Counter[str] = Counter()
    for text, formula, environment in tqdm(commands):
        found = outcome(formula, environment, options.limit)
        ends[found.partition(":")[0]] += 1
        if ":" in found:
            print(f"{text}: {to_text(formula)}: {found}", flush=True)
    print(f"{len(commands)} commands understood: {dict(ends)}")


if __name__ == "__main__":
    main()
