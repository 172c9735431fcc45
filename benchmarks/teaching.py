"""How well tasks are understood that were taught with one example, or with five, or with one among better known tasks.

    python -m benchmarks.teaching [--part development|held-out|both] [--draws 3] [--failures] [--untaught]

The tasks of four worlds in `models/language/dataset/teaching`, which no network was trained on, are all taught at once,
each with its name, one contextual query with its formula, and the given number of wordings, drawn at random. Then every
wording is asked about other things in its world. What is understood is right when its formula is the one that the task
means with these things. Those who work on the translator read the development half of the tasks only.

`--untaught` tells from which confidence on what is understood can be believed: how many of the other wordings are
understood with so much, rightly, wrongly, and when all tasks were taught but the one that they say.
"""

from __future__ import annotations

import argparse
import random
import re
import statistics
import time
from collections import Counter
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace
from importlib.resources import files
from typing import Any, Literal

import yaml
from tqdm import tqdm

from models.language import ComposedTranslator, SpanTranslator, TaughtTranslator, Utterance
from models.language.hearing import Hearing, Lessons
from models.language.matching import Matcher, Shelf, TaughtTask
from models.language.matching.cards import cards_of
from models.logic import Formula, atoms, parse
from models.queries import ContextualQuery, Example, Template, evaluate, learn
from models.world import Environment, explain, ground, load_environment

Part = Literal["development", "held-out"]
PARTS: tuple[Part, ...] = ("development", "held-out")
WORLDS = ("household", "warehouse", "laboratory", "garden")
SHOTS = {"1": (1,), "5": (5,), "1, where others have 2, 4 or 8": (1, 2, 4, 8)}
"""Numbers of examples that a task is taught with, one of which is drawn for each task. Measured are those that got the
first.
"""
BELIEVED = (0.25, 0.5, 0.75)
"""Confidences."""


@dataclass(frozen=True, slots=True, eq=False)
class Task:
    """A task of a world, with its template there, and queries of things that it can be said of."""

    name: str
    world: str
    template: Template
    queries: tuple[ContextualQuery, ...]
    wordings: tuple[str, ...]


@dataclass(slots=True)
class Score:
    """How many texts were understood rightly."""

    right: int = 0
    asked: int = 0
    failures: list[str] = field(default_factory=list)


class Bench:
    """The worlds, the tasks, and the networks."""

    def __init__(self, parts: Sequence[Part]) -> None:
        self.worlds = {name: load_environment(_load(name)) for name in WORLDS}
        self.tasks = [task for part in parts for world in WORLDS for task in self._tasks(world, part)]
        self.translator = ComposedTranslator.load(SpanTranslator.load())
        self.matcher = Matcher.load()
        self.templates = {task.name: task.template for task in self.tasks}

    def _tasks(self, world: str, part: Part) -> list[Task]:
        environment = self.worlds[world]
        return [_task(entry, world, environment) for entry in _load(f"{world}-{part}")["tasks"]]

    def taught(self, shots: Sequence[int], generator: random.Random) -> tuple[Hearing, dict[str, list[int]]]:
        """All tasks taught with one of these numbers of wordings each; and which."""
        counts = generator.choices(shots, k=len(self.tasks)) if len(shots) > 1 else [*shots] * len(self.tasks)
        drawn = zip(self.tasks, counts, strict=True)
        chosen = {task.name: generator.sample(range(len(task.wordings)), count) for task, count in drawn}
        shelf, wordings = [], []
        for task in self.tasks:
            said = [Utterance.of(task.wordings[number], generator.choice(task.queries)) for number in chosen[task.name]]
            cards = cards_of(task.queries[0], explain(task.template.formula, self.worlds[task.world]))
            known = (tuple(self.matcher.known(said)), tuple(self.matcher.known(cards)))
            shelf.append(TaughtTask(task.name, task.template.arity, *known))
            wordings += said
        functions = {name: frozenset(a.function for a in atoms(t.formula)) for name, t in self.templates.items()}
        lessons = Lessons(TaughtTranslator.of(wordings), Shelf.of(shelf), self.matcher, functions)
        return Hearing(self.translator, lessons, self.templates.get), chosen

    def measure(self, label: str, draws: int) -> tuple[Score, Score, Counter[str], list[float]]:
        """Scores of the wordings that were taught, of other ones, failures by task, and the seconds of each text."""
        shots = SHOTS[label]
        same, other, wrong, seconds = Score(), Score(), Counter[str](), list[float]()
        for draw in range(draws):
            generator = random.Random(f"{label}/{draw}")
            hearing, chosen = self.taught(shots, generator)
            measured = [task for task in self.tasks if len(chosen[task.name]) == shots[0]]
            for task in tqdm(measured, desc=f"{label} examples, draw {draw + 1}", leave=False):
                environment = self.worlds[task.world]
                for number, wording in enumerate(task.wordings):
                    query = generator.choice(task.queries)
                    text = filled(wording, query)
                    started = time.perf_counter()
                    found = hearing.readings(text, environment, candidates=1)
                    seconds.append(time.perf_counter() - started)
                    formula = found[0].grounded.formula if found and found[0].grounded else None
                    score = same if number in chosen[task.name] else other
                    score.asked += 1
                    if formula == _meaning(task, query, environment):
                        score.right += 1
                    else:
                        wrong[task.name] += 1
                        heard = str(found[0].query) if found else "nothing"
                        score.failures.append(f"{task.name}: {text} -> {heard}")
        return same, other, wrong, seconds

    def doubts(self, label: str) -> dict[str, list[float]]:
        """The confidences of what other wordings are taken for; 0 where for nothing that makes sense."""
        generator = random.Random(f"{label}/0")
        hearing, chosen = self.taught(SHOTS[label], generator)
        assert hearing.lessons is not None
        found: dict[str, list[float]] = {"right": [], "wrong": [], "not taught": []}
        for task in tqdm(self.tasks, desc=f"{label} examples", leave=False):
            environment = self.worlds[task.world]
            rest = Shelf.of(known for known in hearing.lessons.shelf.tasks if known.task != task.name)
            without = replace(hearing, lessons=replace(hearing.lessons, shelf=rest, wordings=TaughtTranslator.of([])))
            for wording in (w for number, w in enumerate(task.wordings) if number not in chosen[task.name]):
                query = generator.choice(task.queries)
                for heard in (hearing, without):
                    said = heard.readings(filled(wording, query), environment, candidates=1)
                    formula = said[0].grounded.formula if said and said[0].grounded else None
                    right = "right" if formula == _meaning(task, query, environment) else "wrong"
                    kind = right if heard is hearing else "not taught"
                    found[kind].append(0.0 if formula is None else said[0].confidence)
        return found


def _task(entry: Mapping[str, Any], world: str, environment: Environment) -> Task:
    """Learned from the first query whose arguments are distinct things."""
    queries = _queries(entry, environment)
    formula = entry["ltl"]
    for position, phrase in enumerate(queries[0].arguments, start=1):
        formula = formula.replace(f"${position}", _named(phrase, environment))
    template = learn([Example(queries[0], parse(formula))], environment)
    return Task(entry["task"], world, template, tuple(queries), tuple(entry["wordings"]))


def _queries(entry: Mapping[str, Any], environment: Environment) -> list[ContextualQuery]:
    """Queries of the task whose arguments name one thing each, and different ones."""
    generator = random.Random(entry["task"])
    found: dict[ContextualQuery, None] = {}
    for _ in range(40):
        phrases = tuple(generator.choice(names) for names in entry["names"])
        named = [_named(phrase, environment) for phrase in phrases]
        if "" not in named and len(set(named)) == len(named):
            found[ContextualQuery(entry["task"], phrases)] = None
    return list(found)


def _named(phrase: str, environment: Environment) -> str:
    candidates = ground(phrase, environment).candidates
    return candidates[0].symbol.name if len(candidates) == 1 else ""


def _meaning(task: Task, query: ContextualQuery, environment: Environment) -> Formula:
    return evaluate(task.template, query, environment).formula


def filled(wording: str, query: ContextualQuery) -> str:
    """A wording of the things of a query."""
    return re.sub(r"\{(\d)\}", lambda slot: query.arguments[int(slot[1]) - 1], wording)


def _load(name: str) -> Any:
    text = (files("models.language.dataset") / "teaching" / f"{name}.yaml").read_text(encoding="utf-8")
    return yaml.safe_load(text)


def print_doubts(bench: Bench) -> None:
    """The table of `--untaught`."""
    columns = "".join(f" at least {least:.0%} sure |" for least in BELIEVED)
    print(f"| examples of each | other wordings |{columns}\n|---|---|{'---|' * len(BELIEVED)}")
    for label, shots in SHOTS.items():
        for kind, sure in bench.doubts(label).items() if len(shots) == 1 else ():
            cells = "".join(f" {sum(confidence >= least for confidence in sure)} |" for least in BELIEVED)
            print(f"| {label} | {kind}: {len(sure)} |{cells}", flush=True)


def main() -> None:
    """Print the tables."""
    parser = argparse.ArgumentParser(description="How well taught tasks are understood.")
    parser.add_argument("--part", choices=[*PARTS, "both"], default="both")
    parser.add_argument("--draws", type=int, default=3, help="of the wordings that are taught")
    parser.add_argument("--failures", action="store_true", help="list them; for the development half only")
    parser.add_argument("--untaught", action="store_true", help="how sure it is of what was not taught, instead")
    options = parser.parse_args()
    bench = Bench(PARTS if options.part == "both" else (options.part,))
    if options.untaught:
        print_doubts(bench)
        return
    print(f"{len(bench.tasks)} tasks taught at once, {options.draws} draws\n")
    print("| examples of each | same wording, other things | other wordings | median | 95th percentile |")
    print("|---|---|---|---|---|")
    for label in SHOTS:
        same, other, wrong, seconds = bench.measure(label, options.draws)
        ordered = sorted(seconds)
        times = f"{statistics.median(ordered) * 1e3:.1f} ms | {ordered[int(0.95 * len(ordered))] * 1e3:.1f} ms"
        print(f"| {label} | {same.right / same.asked:.1%} | {other.right / other.asked:.1%} | {times} |", flush=True)
        if options.failures and options.part == "development":
            print(wrong.most_common(12))
            print("\n".join([*same.failures[:20], "", *other.failures[:80]]))


if __name__ == "__main__":
    main()
