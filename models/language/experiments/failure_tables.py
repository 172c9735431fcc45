"""Tables of failures by cause, from `results.json`; the same for every system."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from statistics import fmean
from typing import Any

from models.language.experiments.causes import Cause
from models.language.experiments.markdown import Row, number, table
from models.language.experiments.measurement import OVERALL


@dataclass(frozen=True, slots=True)
class Failed:
    """One measurement: what it is called, how many commands it had, and its failures as results have them.

    Attributes:
        label: the first cells of its rows.
        commands: by task class.
        failures: by task class and cause, `{"count": one per seed, "examples": [...]}`.
    """

    label: tuple[str, ...]
    commands: Mapping[str, int]
    failures: Mapping[str, Mapping[str, Any]]


def sizes(groups: Mapping[str, Any]) -> dict[str, int]:
    """The commands of every task class, of scores by group."""
    return {task: group["commands"] for task, group in groups.items() if task != OVERALL}


def by_cause(head: Sequence[str], measured: Sequence[Failed]) -> str:
    """Failures of all task classes together by cause, the mean over seeds; only causes that occur have a column."""
    occur = {cause for entry in measured for causes in entry.failures.values() for cause in causes}
    columns = [cause for cause in Cause if cause in occur]
    rows = [
        [*entry.label, str(sum(entry.commands.values())), *(_total(entry, cause) for cause in columns)]
        for entry in measured
    ]
    return table([*head, "commands", *columns], rows)


def by_task(head: Sequence[str], measured: Sequence[Failed]) -> str:
    """Failures by task class and cause, the mean over seeds, each with examples."""
    return table([*head, "class ", "cause ", "failures", "of", "for example "], _rows(measured))


def _rows(measured: Sequence[Failed]) -> Iterator[Row]:
    for entry in measured:
        for task, causes in entry.failures.items():
            for cause, found in causes.items():
                shown = "; ".join(f'"{e["text"]}": {e["answer"]}' for e in found["examples"])
                yield [*entry.label, task, cause, number(fmean(found["count"])), str(entry.commands[task]), shown]


def _total(entry: Failed, cause: str) -> str:
    counts = [causes[cause]["count"] for causes in entry.failures.values() if cause in causes]
    return number(sum(map(fmean, counts)))
