"""The tables of the default translator, from `results.json`."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import Any

from models.language.experiments.commands import AS_IS
from models.language.experiments.default import WITH, WITHOUT
from models.language.experiments.failure_tables import Failed, by_cause, by_task, sizes
from models.language.experiments.markdown import Row, count, percent, spread, table
from models.language.experiments.measurement import OVERALL
from models.language.experiments.variants import WAYS


def default_tables(results: Mapping[str, Any]) -> dict[str, str]:
    """Every table by the name of its place; needs the default translator's part."""
    default = results["default"]
    failed = list(_failed(default))
    head = ("said ", "set ", "domain ")
    return {
        "default-accuracy": table(
            ["set ", "domain ", "commands", "exact query, alone", "LTL, alone", "LTL, in the environment"],
            _accuracy(default["accuracy"][AS_IS]),
        ),
        "default-by-task": table(["class ", "set ", "commands", "LTL, in the environment"], _by_task(default)),
        "robustness": table(
            ["said ", "set ", "domain ", "commands", "LTL, alone", "LTL, in the environment"], _robustness(default)
        ),
        "changed": table(["set ", "answers that case and punctuation change"], _changed(default)),
        "refusals": _refusals(default["refusals"]),
        "calibration": table(
            ["set ", "confidence ", "answers", "expected calibration error"], _calibration(default["calibration"])
        ),
        "reliability": table(
            ["set ", "confidence in the environment ", "answers", "mean confidence, %", "right, %"],
            _reliability(default["calibration"][WITH]),
        ),
        "default-causes": by_cause(head, failed),
        "default-failures": by_task(head, failed),
    }


def _accuracy(accuracy: Mapping[str, Any]) -> Iterator[Row]:
    for name, domains in accuracy.items():
        for domain, choices in domains.items():
            alone, placed = choices[WITHOUT][OVERALL], choices[WITH][OVERALL]
            cells = (spread(alone["query"]), spread(alone["ltl"]), spread(placed["ltl"]))
            yield [name, domain, str(placed["commands"]), *cells]


def _by_task(default: Mapping[str, Any]) -> Iterator[Row]:
    for name, domains in default["accuracy"][AS_IS].items():
        for choices in domains.values():
            for task, group in choices[WITH].items():
                if task != OVERALL:
                    yield [task, name, str(group["commands"]), spread(group["ltl"])]


def _robustness(default: Mapping[str, Any]) -> Iterator[Row]:
    for said in WAYS:
        for name, domains in default["accuracy"][said].items():
            for domain, choices in domains.items():
                cells = (spread(choices[choice][OVERALL]["ltl"]) for choice in (WITHOUT, WITH))
                yield [said, name, domain, str(choices[WITH][OVERALL]["commands"]), *cells]


def _changed(default: Mapping[str, Any]) -> Iterator[Row]:
    return ([name, count(counts)] for name, counts in default["changed"].items())


def _refusals(refusals: Mapping[str, Any]) -> str:
    rates = [refused / texts for refused, texts in zip(refusals["refused"], refusals["texts"], strict=True)]
    rows = [["refused, of " + count(refusals["texts"]), count(refusals["refused"]), ", ".join(map(percent, rates))]]
    rows += [[f'"{entry["text"]}"', entry["answer"], ""] for entry in refusals["accepted"]]
    return table(["text without a task ", "answer ", "%"], rows)


def _calibration(calibration: Mapping[str, Any]) -> Iterator[Row]:
    for choice, sets in calibration.items():
        for name, entry in sets.items():
            mean, low, high = (f"{entry['error'][key]:.4f}" for key in ("mean", "low", "high"))
            yield [name, choice, count(entry["answers"]), f"{mean} ({low} to {high})"]


def _reliability(sets: Mapping[str, Any]) -> Iterator[Row]:
    for name, entry in sets.items():
        for row in entry["reliability"]:
            place = f"{row['low']:.2f} to {row['high']:.2f}"
            yield [name, place, str(row["count"]), percent(row["confidence"]), percent(row["accuracy"])]


def _failed(default: Mapping[str, Any]) -> Iterator[Failed]:
    for said, names in default["failures"].items():
        for name, domains in names.items():
            for domain, failures in domains.items():
                groups = default["accuracy"][said][name][domain][WITH]
                if failures:
                    yield Failed((said, name, domain), sizes(groups), failures)
