"""What an evaluation writes: `results.json`, two figures, and the tables of a page."""

from __future__ import annotations

import json
import re
from collections.abc import Mapping
from pathlib import Path
from typing import Any

from models.language.experiments.default_tables import default_tables
from models.language.experiments.figures import draw
from models.language.experiments.markdown import filled
from models.language.experiments.paper_tables import paper_tables

FILE = "results.json"
_INNERMOST = re.compile(r"[\[{][^\[\]{}]*[\]}]")


def read_results(folder: Path) -> dict[str, Any]:
    """What `write_results` wrote into a folder, or nothing when it wrote nothing."""
    place = folder / FILE
    found: dict[str, Any] = json.loads(place.read_text(encoding="utf-8")) if place.exists() else {}
    return found


def write_results(results: Mapping[str, Any], folder: Path) -> list[Path]:
    """Write the results, and the figures that can be drawn of them; the same results give the same files."""
    folder.mkdir(parents=True, exist_ok=True)
    (folder / FILE).write_text(as_text(results), encoding="utf-8")
    return [folder / FILE, *(draw(results, folder) if "paper" in results else [])]


def tables(results: Mapping[str, Any]) -> dict[str, str]:
    """The tables of what was measured, by name."""
    found = paper_tables(results) if "paper" in results else {}
    return found | (default_tables(results) if "default" in results else {})


def write_page(results: Mapping[str, Any], page: Path) -> None:
    """Put the tables into their places in a page; raises ValueError when they and the places are not the same."""
    page.write_text(filled(page.read_text(encoding="utf-8"), tables(results)), encoding="utf-8")


def as_text(results: Mapping[str, Any]) -> str:
    """Results as JSON, one line for what holds no further list or object."""
    text = json.dumps(results, indent=1, ensure_ascii=False)
    return _INNERMOST.sub(lambda match: re.sub(r"\n\s*", " ", match.group()), text) + "\n"
