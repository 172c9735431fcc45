"""How well commands in people's own words are understood: composed ones, plain ones, and texts that ask for nothing.

    python -m benchmarks.language [--part development|held-out|both] [--failures]

The sets are in `models/language/dataset/composed`, written apart from the training data; those who work on the
translator read the development half only. The varied ones were written later, as many different people talk: with
reasons, asides, typing mistakes, numbered steps, in the passive. Commands are grounded in the built-in environments
`toys` and `navigation`, with what a new service was taught. A formula is right when Spot says that it is equivalent to
the expected one, with atoms that hold in equal states of the environment taken for one (`at(robot, kitchen)` and
`near(robot, kitchen)`). Times are those of translating and grounding, on one thread.
"""

from __future__ import annotations

import argparse
import statistics
import time
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from functools import cache
from importlib.resources import files
from typing import Any, Literal

import yaml

from models.language import ComposedTranslator, SpanTranslator, TaughtTranslator, Utterance
from models.language.hearing import Hearing, Lessons
from models.language.matching import Matcher, Shelf, TaughtTask
from models.language.matching.cards import cards_of
from models.logic import Atom, Formula, atoms, equivalent, map_atoms, parse
from models.queries import Example, Template, learn, parse_task, resolve_grounded
from models.world import Environment, builtin_environments, explain, load_environment
from service.seeds import seeds

Part = Literal["development", "held-out"]
PARTS: tuple[Part, ...] = ("development", "held-out")


@dataclass(slots=True)
class Count:
    """How many commands were understood rightly, not at all, or otherwise."""

    right: int = 0
    unknown: int = 0
    wrong: int = 0
    failures: list[str] = field(default_factory=list)

    @property
    def total(self) -> int:
        """All of them."""
        return self.right + self.unknown + self.wrong


@dataclass(frozen=True, slots=True)
class Bench:
    """What the service hears with, with templates and environments."""

    hearing: Hearing
    templates: Mapping[str, Template]
    environments: Mapping[str, Environment]

    @classmethod
    def load(cls) -> Bench:
        """What a new service has."""
        environments = {name: load_environment(data) for name, data in builtin_environments()}
        translator, matcher = ComposedTranslator.load(SpanTranslator.load()), Matcher.load()
        templates, shelf, taught = {}, [], []
        for lesson in (*seeds("paper"), *seeds("common")):
            query, world = parse_task(lesson.query), environments[lesson.environment]
            template = templates[query.task] = learn([Example(query, parse(lesson.ltl))], world)
            examples = [Utterance.of(wording, query) for wording in lesson.examples]
            cards = matcher.known(cards_of(query, lesson.explanation or explain(template.formula, world)))
            shelf.append(TaughtTask(query.task, template.arity, tuple(matcher.known(examples)), tuple(cards)))
            taught += examples
        functions = {task: frozenset(a.function for a in atoms(t.formula)) for task, t in templates.items()}
        wordings = TaughtTranslator.of(taught)
        lessons = Lessons(wordings, Shelf.of(shelf), matcher, functions, translator.tasks)
        return cls(Hearing(translator, lessons, templates.get), templates, environments)

    def formula(self, text: str, environment: Environment) -> Formula | Literal["unknown"] | None:
        """What the best reading of a text means; None where that means nothing in the environment."""
        readings = self.hearing.readings(text, environment, candidates=1)
        if not readings:
            return "unknown"
        return None if readings[0].grounded is None else readings[0].grounded.formula

    def commands(self, items: Sequence[Mapping[str, Any]], seconds: list[float]) -> dict[str, Count]:
        """Counts by kind of command, and the time that each took."""
        counts: dict[str, Count] = {}
        for item in items:
            environment = self.environments[item["environment"]]
            started = time.perf_counter()
            found = self.formula(item["text"], environment)
            seconds.append(time.perf_counter() - started)
            count = counts.setdefault(" + ".join(item.get("kind", ["plain"])), Count())
            if found == "unknown":
                count.unknown += 1
            elif found is not None and same(found, resolve_grounded(parse(item["ltl"]), environment), environment):
                count.right += 1
                continue
            else:
                count.wrong += 1
            count.failures.append(item["text"])
        return counts

    def refusals(self, texts: Sequence[str]) -> Count:
        """Texts that ask for nothing; right is to understand nothing."""
        heard = [text for text in texts if self.hearing.readings(text, None, candidates=1)]
        return Count(right=len(texts) - len(heard), wrong=len(heard), failures=heard)


def same(one: Formula, other: Formula, environment: Environment) -> bool:
    """Whether two formulas mean the same in an environment: equivalent, up to atoms that it cannot tell apart."""
    names = {*atoms(one), *atoms(other)}
    truth = {atom: truth_of(environment, atom) for atom in sorted(names, key=str)}
    first: dict[bytes, Atom] = {}
    merged = {atom: first.setdefault(holds, atom) for atom, holds in truth.items()}
    return equivalent(map_atoms(one, merged.__getitem__), map_atoms(other, merged.__getitem__))


@cache
def truth_of(environment: Environment, atom: Atom) -> bytes:
    """In which states an atom holds."""
    return bytes(environment.world.labels([atom])[0].tobytes())


def read(name: str, part: Part) -> list[Any]:
    """The items of a set."""
    place = files("models.language.dataset") / "composed" / f"{name}-{part}.yaml"
    items: list[Any] = yaml.safe_load(place.read_text(encoding="utf-8"))["items"]
    return items


def report(bench: Bench, part: Part, *, failures: bool) -> None:
    """Measure one half and print its table."""
    seconds: list[float] = []
    composed = bench.commands(read("compositions", part), seconds)
    plain = bench.commands(read("valid", part), seconds)
    refused = bench.refusals(read("refusals", part))
    varied = bench.commands(read("varied", part), seconds)
    unasked = bench.refusals(read("varied-refusals", part))
    print(f"\n{part}\n\n| commands | number | right | not understood | wrong |\n|---|---|---|---|---|")
    rows = {
        **composed,
        "all composed": total(composed.values()),
        **plain,
        "nothing asked for": refused,
        "composed, varied speakers": total(varied.values()),
        "nothing asked for, varied speakers": unasked,
    }
    for kind, count in rows.items():
        share = count.right / count.total
        print(f"| {kind} | {count.total} | {count.right} ({share:.1%}) | {count.unknown} | {count.wrong} |")
    ordered = sorted(seconds)
    high = ordered[int(0.95 * len(ordered))]
    print(f"\nmedian {statistics.median(seconds) * 1e3:.1f} ms, 95th percentile {high * 1e3:.1f} ms")
    if failures:
        counts = (*composed.values(), *plain.values(), refused, *varied.values(), unasked)
        print(*(text for count in counts for text in count.failures), sep="\n")


def total(counts: Any) -> Count:
    """The sum of counts."""
    found = list(counts)
    return Count(*(sum(getattr(count, name) for count in found) for name in ("right", "unknown", "wrong")))


def main(arguments: Sequence[str] | None = None) -> None:
    """Read the command line, measure and print."""
    parser = argparse.ArgumentParser(description="How well commands in people's own words are understood.")
    parser.add_argument("--part", choices=[*PARTS, "both"], default="both")
    parser.add_argument("--failures", action="store_true", help="print what went wrong, of the development half only")
    options = parser.parse_args(arguments)
    bench = Bench.load()
    for part in PARTS if options.part == "both" else (options.part,):
        report(bench, part, failures=options.failures and part == "development")


if __name__ == "__main__":
    main()
