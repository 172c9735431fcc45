"""What hundreds of taught tasks cost: the time of a translation, and what was understood without them.

    python -m benchmarks.crowd [--tasks 0 100 500] [--most 30]

The tasks are those of `models/language/dataset/tasks`, as often as it takes, each with one example and its card; those
of one argument get a template that makes sense wherever the paper's commands are asked, so that they do compete. Asked
are commands of the paper's sets S and U in their environments, so many of each task class; right is the exact formula.
Times are those of translating and grounding, on one thread.
"""

from __future__ import annotations

import argparse
import random
import statistics
import time
from itertools import cycle, islice

from tqdm import tqdm

from models.language import ComposedTranslator, SpanTranslator, TaughtTranslator, Utterance
from models.language.dataset import Domain
from models.language.dataset.tasks import TaskClass, task_classes
from models.language.experiments.commands import CommandSet, paper_sets
from models.language.experiments.templates import given
from models.language.hearing import Hearing, Lessons
from models.language.matching import Matcher, Shelf, TaughtTask
from models.language.matching.cards import cards_of
from models.logic import parse
from models.queries import ContextualQuery, Template

FORMULAS = {Domain.MANIPULATION: "F holding($1)", Domain.NAVIGATION: "F at(robot, $1)"}


def crowd(
    count: int, domain: Domain, matcher: Matcher
) -> tuple[list[TaughtTask], list[Utterance], dict[str, Template]]:
    """So many taught tasks, their examples, and their templates."""
    tasks, utterances, templates = [], [], {}
    for number, entry in enumerate(islice(cycle(task_classes()), count)):
        query = _query(entry, number)
        example = Utterance.of(random.Random(number).choice(entry.wordings), query)
        known = matcher.known([example, *cards_of(query, entry.means)])
        tasks.append(TaughtTask(query.task, len(query.arguments), tuple(known[:1]), tuple(known[1:])))
        utterances.append(example)
        if len(query.arguments) == 1:
            formula = parse(FORMULAS[domain])
            templates[query.task] = Template(query.task, formula, formula, (frozenset(),), ())
    return tasks, utterances, templates


def _query(entry: TaskClass, number: int) -> ContextualQuery:
    generator = random.Random(number)
    phrases = [generator.choice(names) for names in entry.names]
    return ContextualQuery(f"{entry.task}_{number}", tuple(phrases))


def measure(commands: CommandSet, hearing: Hearing) -> tuple[int, list[float]]:
    """How many commands are understood rightly, and the seconds that each took."""
    right, seconds = 0, []
    for text, expected in zip(commands.texts, commands.expected, strict=True):
        started = time.perf_counter()
        found = hearing.readings(text, commands.environment, candidates=1)
        seconds.append(time.perf_counter() - started)
        right += bool(found) and found[0].grounded is not None and found[0].grounded.formula == expected
    return right, seconds


def main() -> None:
    """Print the table."""
    parser = argparse.ArgumentParser(description="What hundreds of taught tasks cost.")
    parser.add_argument("--tasks", type=int, nargs="+", default=[0, 100, 500])
    parser.add_argument("--most", type=int, default=30, help="commands of each task class")
    options = parser.parse_args()
    translator, matcher = ComposedTranslator.load(SpanTranslator.load()), Matcher.load()
    print("| tasks taught | S and U, exact formula | median | 95th percentile |\n|---|---|---|---|")
    for count in options.tasks:
        right, seconds = 0, list[float]()
        for domain in tqdm(Domain, leave=False):
            tasks, utterances, templates = crowd(count, domain, matcher)
            functions = {task.task: frozenset[str]() for task in tasks}
            lessons = Lessons(TaughtTranslator.of(utterances), Shelf.of(tasks), matcher, functions)
            for commands in paper_sets(domain):
                hearing = Hearing(translator, lessons, {**given(commands), **templates}.get)
                found, took = measure(commands.thinned(options.most), hearing)
                right, seconds = right + found, seconds + took
        ordered = sorted(seconds)
        times = f"{statistics.median(ordered) * 1e3:.1f} ms | {ordered[int(0.95 * len(ordered))] * 1e3:.1f} ms"
        print(f"| {count} | {right / len(seconds):.2%} | {times} |", flush=True)


if __name__ == "__main__":
    main()
