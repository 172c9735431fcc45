"""The paper's experiments: accuracy over epochs and at the end, and why answers are wrong; over seeds."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from typing import Any

from models.language.dataset import Domain
from models.language.experiments.commands import CommandSet
from models.language.experiments.measurement import Measurement, measure
from models.language.experiments.paper_runs import paper_run, thinned_sets
from models.language.experiments.paper_systems import NAMES, PaperSystems
from models.language.experiments.runs import Runs
from models.language.experiments.settings import Done, Settings
from models.language.experiments.spread import DIGITS
from models.language.experiments.summary import curves, failures, scores
from models.logic import to_text

Key = tuple[str, str]
"""A system and a set of commands, by name."""
Point = Mapping[Key, Measurement]
"""Every system on every set at one point of a training."""


def paper_part(settings: Settings, runs: Runs, done: Done) -> dict[str, Any]:
    """Train, or read, and measure the paper's systems in both domains; plain data for `results.json`."""
    return {str(domain): _domain(domain, settings, runs, done) for domain in Domain}


def paper_steps(settings: Settings) -> int:
    """How often `paper_part` calls `done`."""
    return len(Domain) * len(settings.seeds) * (settings.copynet.epochs + len(settings.epochs) + 1)


def _domain(domain: Domain, settings: Settings, runs: Runs, done: Done) -> dict[str, Any]:
    sets = thinned_sets(domain, settings)
    points: list[list[Point]] = []  # by seed and epoch
    finals: list[Point] = []  # by seed
    ended: list[PaperSystems] = []  # by seed
    records: list[Any] = []  # by seed
    for seed in settings.seeds:
        run = paper_run(domain, seed, settings, runs, done)
        measured = []
        for transcript in (*run.points.values(), run.final):
            systems = PaperSystems.of(transcript, *sets)
            measured.append(_point(systems, sets))
            done(f"measure paper-{domain}-{seed}")
        points.append(measured[:-1])
        finals.append(measured[-1])
        ended.append(systems)
        records.append(_rounded(run.record))
    return {
        "epochs": list(settings.epochs),
        "seeds": list(settings.seeds),
        "curves": _by_key(sets, lambda key: curves([[point[key] for point in run] for run in points])),
        "final": _by_key(sets, lambda key: scores([final[key] for final in finals])),
        "failures": _by_key(sets, lambda key: failures([final[key] for final in finals])),
        "lessons": _lessons(ended),
        "training": records,
    }


def _point(systems: PaperSystems, sets: Sequence[CommandSet]) -> Point:
    return {(system.name, commands.name): measure(system, commands) for system in systems.systems for commands in sets}


def _by_key(sets: Sequence[CommandSet], value: Callable[[Key], Any]) -> dict[str, Any]:
    return {name: {commands.name: value((name, commands.name)) for commands in sets} for name in NAMES}


def _lessons(ended: Sequence[PaperSystems]) -> dict[str, Any]:
    """By system and task class: the templates of all seeds, each once, and how many right translations there were."""
    found: dict[str, Any] = {}
    for name in ended[0].lessons:
        lessons = [systems.lessons[name] for systems in ended]
        for task in dict.fromkeys(task for lesson in lessons for task in lesson.accurate):
            formulas = {to_text(lesson.templates[task].formula) for lesson in lessons if task in lesson.templates}
            accurate = [lesson.accurate.get(task, 0) for lesson in lessons]
            found.setdefault(name, {})[task] = {"templates": sorted(formulas), "accurate": accurate}
    return found


def _rounded(data: Any) -> Any:
    """Plain data with its numbers rounded, so that the last bits of a loss change no file."""
    if isinstance(data, Mapping):
        return {key: _rounded(value) for key, value in data.items()}
    if isinstance(data, list | tuple):
        return [_rounded(value) for value in data]
    return round(data, DIGITS) if isinstance(data, float) else data
