"""Results on disk and in the page."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

from models.language.experiments.results import as_text, read_results, tables, write_page, write_results

PAGE = Path(__file__).parents[3] / "docs" / "experiments.md"


def test_there_and_back(results: dict[str, Any], tmp_path: Path) -> None:
    assert read_results(tmp_path) == {}
    written = write_results(results, tmp_path)
    assert read_results(tmp_path) == json.loads(json.dumps(results))
    assert len(written) == 5
    assert all(path.exists() for path in written)


def test_without_the_paper_there_is_nothing_to_draw(results: dict[str, Any], tmp_path: Path) -> None:
    assert [path.name for path in write_results({"default": results["default"]}, tmp_path)] == ["results.json"]


def test_text_is_json_with_short_lines_for_what_is_innermost() -> None:
    value = {"a": {"mean": 0.5, "low": 0.25}, "b": [1, 2], "c": [{"d": "x [y] {z}"}], "e": "- , \n"}
    text = as_text(value)
    assert json.loads(text) == value
    assert '"a": { "mean": 0.5, "low": 0.25 }' in text
    assert text.count("\n") < json.dumps(value, indent=1).count("\n")


def test_the_page_in_the_documentation_has_a_place_for_every_table(results: dict[str, Any], tmp_path: Path) -> None:
    page = tmp_path / "experiments.md"
    page.write_text(PAGE.read_text(encoding="utf-8"), encoding="utf-8")
    write_page(results, page)
    text = page.read_text(encoding="utf-8")
    assert all(table in text for table in tables(results).values())


def test_the_page_in_the_documentation_is_that_of_its_results(tmp_path: Path) -> None:
    page = tmp_path / "experiments.md"
    page.write_text(PAGE.read_text(encoding="utf-8"), encoding="utf-8")
    write_page(read_results(PAGE.parent / "experiments"), page)
    assert page.read_text(encoding="utf-8") == PAGE.read_text(encoding="utf-8")
