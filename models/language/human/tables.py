"""The results as a table of Markdown, beside what is published, and its place in a page."""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

from models.language.experiments.markdown import percent, table

PUBLISHED = {
    ("drone", "folds"): ("87.18", "88.97", "90.86", "92.66"),
    ("cleanup", "folds"): ("95.51", "95.47", "97.84", "99.70"),
    ("pick", "folds"): ("93.78", "93.14", "95.97", "99.87"),
    ("drone", "few"): ("22", "36", "69.4", ""),
    ("cleanup", "few"): ("53", "53", "78.0", ""),
    ("pick", "few"): ("32", "40", "81.5", ""),
}
"""RNN, CopyNet and BART-large as Pan et al. (2023) give them, and the most that any function of the text can reach."""
NAMES = {
    "folds": "five folds",
    "few": "few examples",
    "unseen": "unseen formulas",
    "utterances": "utterance hold-out",
    "formulas": "formula hold-out",
}
HEAD = (
    "commands ",
    "setting ",
    "tested",
    "default",
    "linear baseline",
    "RNN",
    "CopyNet",
    "BART-large",
    "ceiling",
    "default: duplicates",
    "default: others",
)
START, END = "<!-- human commands -->", "<!-- human commands end -->"


def human_table(results: Mapping[str, Any]) -> str:
    """One row for each set of commands and setting."""
    rows = []
    for name in ("drone", "cleanup", "pick", "lang2ltl"):
        for setting, values in results.get(name, {}).items():
            rows.append(_row(name, setting, values))
            if "known families" in values and setting == "formulas":
                rows.append(_known_row(name, values["known families"]))
    return table(HEAD, rows)


def write_table(results: Mapping[str, Any], page: Path) -> None:
    """Put the table between its markers in a page; raises ValueError when the page lacks them."""
    text = page.read_text(encoding="utf-8")
    filled, count = re.subn(
        f"{START}.*?{END}", lambda _: f"{START}\n\n{human_table(results)}\n\n{END}", text, flags=re.DOTALL
    )
    if count != 1:
        raise ValueError(f"{page} has no place for the table of human commands")
    page.write_text(filled, encoding="utf-8")


def _row(name: str, setting: str, values: Mapping[str, Any]) -> Sequence[str]:
    published = PUBLISHED.get((name, setting), ("", "", "", ""))
    parts = [_part(values[part]) for part in ("duplicates", "others")]
    measured = [_mean(values[system]) for system in ("right", "baseline")]
    return [name, NAMES[setting], str(sum(values["tested"])), *measured, *published, *parts]


def _known_row(name: str, part: Mapping[str, Any]) -> Sequence[str]:
    """Of the formula hold-out, what has another length of its family in training."""
    if not part["tested"]:
        return [name, "- family known", "0", *[""] * 8]
    return [name, "- family known", str(part["tested"]), percent(part["right"]), percent(part["baseline"]), *[""] * 6]


def _mean(rates: Sequence[float]) -> str:
    return percent(sum(rates) / len(rates))


def _part(part: Mapping[str, Any]) -> str:
    return f"{percent(part['right'])} of {part['tested']}" if part["tested"] else "none"
