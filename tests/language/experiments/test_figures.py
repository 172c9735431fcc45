"""The figures show every curve of the results where it belongs."""

from __future__ import annotations

from pathlib import Path
from typing import Any
from xml.etree import ElementTree

from matplotlib.axes import Axes

from models.language.experiments import figures
from models.language.experiments.figures import COLORS, DEFAULT_COLOR, draw
from models.language.experiments.paper_systems import CQ, LTL, POS


def _curves(axes: Axes, color: str) -> list[tuple[list[float], str, str]]:
    return [
        ([round(y, 6) for y in line.get_ydata()], line.get_linestyle(), str(line.get_marker()))
        for line in axes.get_lines()
        if line.get_color() == color
    ]


def test_overall_has_four_panels_with_five_curves_and_the_default(results: dict[str, Any]) -> None:
    panels = figures._overall(results).axes
    assert [panel.get_title() for panel in panels] == [
        "Manipulation, seen vocabulary (S)",
        "Manipulation, unseen vocabulary (U)",
        "Navigation, seen vocabulary (S)",
        "Navigation, unseen vocabulary (U)",
    ]
    for panel in panels:
        queries, ltl = ([0.0, 37.5, 75.0], ":", "o"), ([0.0, 37.5, 75.0], "-", "D")
        assert _curves(panel, COLORS[CQ]) == [queries, ltl]
        assert [(style, marker) for _, style, marker in _curves(panel, COLORS[POS])] == [(":", "o"), ("-", "D")]
        assert _curves(panel, COLORS[LTL]) == [([0.0, 12.5, 25.0], "-", "D")]
        assert [values for values, _, _ in _curves(panel, DEFAULT_COLOR)] == [[87.5, 87.5]]
        assert len(panel.collections) == 5  # the bands


def test_one_panel_for_every_task_class(results: dict[str, Any]) -> None:
    panels = [panel for panel in figures._by_task(results).axes if panel.get_title()]
    assert len(panels) == 7
    assert panels[0].get_title() == "move_to (S 40, U 40)"
    for panel in panels:
        for color in COLORS.values():
            assert [style for _, style, _ in _curves(panel, color)] == [":", "-"]


def test_without_the_default_translator(results: dict[str, Any]) -> None:
    panel = figures._overall({"paper": results["paper"]}).axes[0]
    assert not _curves(panel, DEFAULT_COLOR)


def test_files(results: dict[str, Any], tmp_path: Path) -> None:
    written, again = (draw(results, tmp_path / name) for name in ("one", "two"))
    assert [path.name for path in written] == [
        "accuracy-overall.svg",
        "accuracy-overall.png",
        "accuracy-by-task.svg",
        "accuracy-by-task.png",
    ]
    assert written[1].read_bytes().startswith(b"\x89PNG")
    text = "".join(ElementTree.parse(written[0]).getroot().itertext())
    for label in ("CQ-LTL-CopyNet+POS: grounded LTL", "CQ-CopyNet: contextual queries", "default translator"):
        assert label in text
    assert [path.read_bytes() for path in written] == [path.read_bytes() for path in again]
