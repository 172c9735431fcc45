"""The tables say what the results say."""

from __future__ import annotations

from typing import Any

from models.language.experiments.default_tables import default_tables
from models.language.experiments.paper_tables import paper_tables


def test_overall(results: dict[str, Any]) -> None:
    lines = paper_tables(results)["ltl"].splitlines()
    assert lines[0] == "|  | manipulation S | manipulation U | navigation S | navigation U |"
    assert [line.split(" | ")[0] for line in lines[2:]] == [
        "| LTL-CopyNet",
        "| CQ-LTL-CopyNet",
        "| CQ-LTL-CopyNet+POS",
        "| default",
    ]
    assert lines[3].split(" | ")[1] == "75 ± 10 (62.5 to 87.5)"
    assert lines[5].split(" | ")[1] == "87.5 ± 10 (75 to 100)"


def test_without_the_default_translator(results: dict[str, Any]) -> None:
    tables = paper_tables({"paper": results["paper"]})
    assert "default" not in tables["queries"]
    assert "| ship | 25 | 25 | 75 | 75 | 50 | 50 |  |  |" in tables["by-task"]


def test_by_task(results: dict[str, Any]) -> None:
    assert "| ship | 25 | 25 | 75 | 75 | 50 | 50 | 87.5 | 87.5 |" in paper_tables(results)["by-task"]


def test_failures(results: dict[str, Any]) -> None:
    tables = paper_tables(results)
    assert "| LTL-CopyNet | manipulation | S | 160 | 1.5 |" in tables["causes"]
    assert tables["causes"].splitlines()[0].endswith("| commands | wrong argument |")
    example = '| navigate_one | wrong argument | 1.5 | 40 | "Take the ball": pickup(cube) |'
    assert f"| CQ-LTL-CopyNet | navigation | U {example}" in tables["failures"]


def test_templates(results: dict[str, Any]) -> None:
    assert "| CQ-CopyNet | move_to | 7, 8 | `F holding($1)` |" in paper_tables(results)["lessons"]


def test_default(results: dict[str, Any]) -> None:
    tables = default_tables(results)
    alone, placed = "62.5 ± 10 (50 to 75)", "87.5 ± 10 (75 to 100)"
    assert f"| W | navigation | 40 | {alone} | {alone} | {placed} |" in tables["default-accuracy"]
    assert f"| ship | W | 40 | {placed} |" in tables["default-by-task"]
    assert f"| one typo | U | manipulation | 40 | {alone} | {placed} |" in tables["robustness"]
    assert "| U | 0, 1 |" in tables["changed"]
    assert "| refused, of 50 | 49, 50 | 98, 100 |" in tables["refusals"]
    assert '| "Open it" | pickup(it) |  |' in tables["refusals"]
    assert "| U | with environment | 9 | 0.0200 (0.0100 to 0.0300) |" in tables["calibration"]
    assert "| W | 0.93 to 1.00 | 9 | 98 | 100 |" in tables["reliability"]
    assert "| one typo | S | manipulation | 160 | 1.5 |" in tables["default-causes"]
    assert "navigation" not in tables["default-causes"]
