"""The default translator: accuracy, robustness, refusals and calibration; over seeds."""

from __future__ import annotations

import random
from collections.abc import Callable, Iterator, Sequence
from dataclasses import asdict, dataclass, field
from typing import Any

from models.language.dataset import Domain, Part, no_task, open_world
from models.language.experiments.answer import Answer
from models.language.experiments.calibration import calibration_error, reliability
from models.language.experiments.commands import AS_IS, CommandSet
from models.language.experiments.comparison import says
from models.language.experiments.default_system import DefaultSystem
from models.language.experiments.measurement import Measurement, judge
from models.language.experiments.paper_runs import thinned_sets
from models.language.experiments.settings import Done, Settings
from models.language.experiments.summary import failures, scores, spread
from models.language.experiments.variants import CASE, WAYS, paraphrased, variants
from models.world import load_environment

WITH, WITHOUT = "with environment", "without environment"
OPEN_WORLD = "W"
FRESH = 1000
"""W of a seed is drawn with this added to the seed, so that it is no set that anything was tried on."""
SHOWN = 5
"""Texts without a task that are kept as examples of those that were not refused."""

Factory = Callable[[int], DefaultSystem]
"""Gives the system of a seed, trained or read."""
Key = tuple[str, str, str, str]
"""How commands were said, the set, the domain, and whether the environment chose between readings."""


@dataclass(slots=True)
class Outcome:
    """What the system of one seed did.

    Attributes:
        measured: what was asked, and how that went.
        sure: by set and whether the environment chose, the confidence of every answer, and whether it was right.
        changed: by set, commands whose answer or its confidence is another when their case and punctuation are.
        refused: texts that no task fits and that were refused.
        accepted: those that were not, with what was read in them.
    """

    measured: dict[Key, Measurement] = field(default_factory=dict)
    sure: dict[tuple[str, str], list[tuple[float, bool]]] = field(default_factory=dict)
    changed: dict[str, int] = field(default_factory=dict)
    refused: int = 0
    accepted: list[tuple[str, str]] = field(default_factory=list)


def default_part(settings: Settings, factory: Factory, done: Done) -> dict[str, Any]:
    """Measure the default translator of every seed; plain data for `results.json`."""
    return _summary([_outcome(seed, factory(seed), settings, done) for seed in settings.seeds], settings)


def default_steps(settings: Settings) -> int:
    """How often `default_part` calls `done`: epochs; in each domain S, U and W, and S and U said again; refusals."""
    return len(settings.seeds) * (settings.spans.epochs + len(Domain) * (3 + 2 * len(WAYS)) + 1)


def _outcome(seed: int, system: DefaultSystem, settings: Settings, done: Done) -> Outcome:
    outcome = Outcome()
    for domain in Domain:
        plain: list[Answer] = []
        for commands in _sets(domain, seed, settings):
            answers = _ask(system, commands, outcome)
            if commands.said == AS_IS:
                plain = answers
            if commands.said == CASE:
                changed = sum(one != other for one, other in zip(plain, answers, strict=True))
                outcome.changed[commands.name] = outcome.changed.get(commands.name, 0) + changed
            done(f"ask default-{seed} {commands.name} of {domain}, {commands.said}")
    for text in _texts_without_a_task(seed, settings):
        readings = system.readings(text)
        outcome.refused += not readings
        outcome.accepted += [(text, str(reading.query)) for reading in readings[:1]]
    done(f"ask default-{seed} texts without a task")
    return outcome


def _sets(domain: Domain, seed: int, settings: Settings) -> Iterator[CommandSet]:
    """S, U and W of a domain, and S and U said in other ways, each after the set that it is made of."""
    for commands, part in zip(thinned_sets(domain, settings), Part, strict=True):
        yield commands
        yield from variants(commands, seed=seed)
        yield paraphrased(commands, part, seed=seed, most=settings.paraphrases)
    world = open_world(domain, seed=FRESH + seed, size=settings.open_world)
    yield CommandSet.of(OPEN_WORLD, world.examples, load_environment(world.environment))


def _texts_without_a_task(seed: int, settings: Settings) -> Sequence[str]:
    texts = no_task(seed=seed, joined=False).held_out
    return texts if settings.refusals is None else random.Random(seed).sample(texts, settings.refusals)


def _ask(system: DefaultSystem, commands: CommandSet, outcome: Outcome) -> list[Answer]:
    """Measure without and with the environment, and note how sure the answers to unchanged commands were.

    Returns the answers with the environment.
    """
    answers: list[Answer] = []
    for asked, choice in ((system.unranked(), WITHOUT), (system, WITH)):
        answers = asked.answer(commands.texts, commands.environment)
        measured = judge(answers, commands, queries=True)
        outcome.measured[commands.said, commands.name, commands.domain, choice] = measured
        if commands.said == AS_IS:
            exact = [says(answer.query, example) for answer, example in zip(answers, commands.examples, strict=True)]
            right = measured.right if choice == WITH else exact
            sure = [(a.confidence, good) for a, good in zip(answers, right, strict=True) if a.query is not None]
            outcome.sure.setdefault((commands.name, choice), []).extend(sure)
    return answers


def _summary(outcomes: Sequence[Outcome], settings: Settings) -> dict[str, Any]:
    first = outcomes[0]
    accuracy: dict[str, Any] = {}
    for key in first.measured:
        said, name, domain, choice = key
        group = accuracy.setdefault(said, {}).setdefault(name, {}).setdefault(domain, {})
        group[choice] = scores([outcome.measured[key] for outcome in outcomes])
    return {
        "seeds": list(settings.seeds),
        "accuracy": accuracy,
        "failures": {
            said: {
                name: {
                    domain: failures([outcome.measured[said, name, domain, WITH] for outcome in outcomes])
                    for domain in domains
                }
                for name, domains in names.items()
            }
            for said, names in accuracy.items()
        },
        "changed": {name: [outcome.changed[name] for outcome in outcomes] for name in first.changed},
        "refusals": {
            "texts": [outcome.refused + len(outcome.accepted) for outcome in outcomes],
            "refused": [outcome.refused for outcome in outcomes],
            "accepted": [{"text": text, "answer": answer} for text, answer in first.accepted[:SHOWN]],
        },
        "calibration": {
            choice: {
                name: _calibration([outcome.sure[name, choice] for outcome in outcomes])
                for name, other in first.sure
                if other == choice
            }
            for choice in (WITH, WITHOUT)
        },
    }


def _calibration(seeds: Sequence[Sequence[tuple[float, bool]]]) -> dict[str, Any]:
    """The spread of the error over seeds, and the reliability of all of them together."""
    tables = [reliability(*_columns(pairs)) for pairs in seeds]
    pooled = reliability(*_columns([pair for pairs in seeds for pair in pairs]))
    return {
        "answers": [len(pairs) for pairs in seeds],
        "error": spread([calibration_error(table) for table in tables]),
        "reliability": [asdict(entry) for entry in pooled if entry.count],
    }


def _columns(pairs: Sequence[tuple[float, bool]]) -> tuple[list[float], list[bool]]:
    return [confidence for confidence, _ in pairs], [right for _, right in pairs]
