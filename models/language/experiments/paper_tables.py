"""The tables of the paper's experiments, from `results.json`."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import Any

from models.language.dataset import Domain
from models.language.experiments.commands import AS_IS
from models.language.experiments.default import WITH
from models.language.experiments.failure_tables import Failed, by_cause, by_task, sizes
from models.language.experiments.markdown import Row, count, percent, spread, table
from models.language.experiments.measurement import OVERALL
from models.language.experiments.paper_systems import LTL, LTL_NAMES, QUERY_NAMES

SETS = ("S", "U")
_FAILED = ("system ", "domain ", "set ")
_CORNERS = tuple((domain, name) for domain in Domain for name in SETS)


def paper_tables(results: Mapping[str, Any]) -> dict[str, str]:
    """Every table by the name of its place; the default translator has a row or column where it was measured."""
    return {
        "queries": _overall(results, "query", QUERY_NAMES),
        "ltl": _overall(results, "ltl", LTL_NAMES),
        "text": _overall(results, "text", LTL_NAMES),
        "structure": _overall(results, "structure", LTL_NAMES),
        "by-task": _by_task(results),
        "causes": by_cause(_FAILED, _failed(results["paper"])),
        "failures": by_task(_FAILED, _failed(results["paper"])),
        "lessons": _lessons(results["paper"]),
    }


def _overall(results: Mapping[str, Any], measure: str, names: Mapping[str, str]) -> str:
    head = ["", *(f"{domain} {name}" for domain, name in _CORNERS)]
    rows = [
        [label, *(spread(results["paper"][d]["final"][system][s][OVERALL][measure]) for d, s in _CORNERS)]
        for system, label in names.items()
    ]
    if "default" in results:
        accuracy = results["default"]["accuracy"][AS_IS]
        rows.append(["default", *(spread(accuracy[s][d][WITH][OVERALL][measure]) for d, s in _CORNERS)])
    return table(head, rows)


def _by_task(results: Mapping[str, Any]) -> str:
    head = ["", *(f"{label} {name}" for label in (*LTL_NAMES.values(), "default") for name in SETS)]
    return table(head, _by_task_rows(results))


def _by_task_rows(results: Mapping[str, Any]) -> Iterator[Row]:
    for domain in Domain:
        final = results["paper"][domain]["final"]
        for task in final[LTL]["S"]:
            if task == OVERALL:
                continue
            cells = [percent(final[system][name][task]["ltl"]["mean"]) for system in LTL_NAMES for name in SETS]
            for name in SETS:
                default = results.get("default")
                group = default and default["accuracy"][AS_IS][name][domain][WITH][task]
                cells.append(percent(group["ltl"]["mean"]) if group else "")
            yield [task, *cells]


def _failed(paper: Mapping[str, Any]) -> list[Failed]:
    return [
        Failed((label, str(domain), name), sizes(part["final"][system][name]), part["failures"][system][name])
        for system, label in LTL_NAMES.items()
        for domain, part in paper.items()
        for name in SETS
    ]


def _lessons(paper: Mapping[str, Any]) -> str:
    head = ["with ", "class ", "right on S in both, by seed ", "template "]
    rows = [
        [name, task, count(lesson["accurate"]), ", ".join(f"`{text}`" for text in lesson["templates"])]
        for part in paper.values()
        for name, lessons in part["lessons"].items()
        for task, lesson in lessons.items()
    ]
    return table(head, rows)
