"""The results as figures, SVG and PNG."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

import matplotlib as mpl
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from benchmarks.planning.cases import TITLES, Toys, case_of
from benchmarks.planning.measuring import DONE, Result
from benchmarks.planning.report import product_states

MARKS = "osD^vP*X"
LEAST_STATES = 10**5
"""Of a world for which the time of a sweep is shown."""


def draw(results: Sequence[Result], folder: Path) -> None:
    """Time against product states, and our time for a product state and sweep."""
    folder.mkdir(parents=True, exist_ok=True)
    mpl.rcParams["svg.hashsalt"] = "planning"  # the same file for the same figures
    worlds = [result for result in results if result["status"] == DONE and not result["case"].startswith("random")]
    _save(_times(worlds), folder / "planning_time")
    _save(_sweeps(worlds), folder / "planning_sweep")


def sweep_points(results: Sequence[Result]) -> dict[int, list[tuple[int, float]]]:
    """By number of toys, on which the number of actions depends: product states, from 100,000, and nanoseconds for each
    of them in a sweep of ours.
    """
    found: dict[int, list[tuple[int, float]]] = {}
    for result in results:
        case = case_of(result["case"])
        if result["status"] != DONE or result["route"] != "ours" or not isinstance(case, Toys):
            continue
        states, sweep_s = result["notes"]["product_states"], result["notes"]["sweep_s"]
        if states >= LEAST_STATES and sweep_s:
            found.setdefault(case.toys, []).append((states, sweep_s / states * 1e9))
    return {toys: sorted(points) for toys, points in sorted(found.items())}


def _times(results: Sequence[Result]) -> Figure:
    figure = Figure(figsize=(7, 4.5), layout="constrained")
    axes = figure.subplots()
    sizes = product_states(results)
    for mark, (route, title) in zip(MARKS, TITLES.items(), strict=True):
        points = sorted((sizes[r["case"]], r["seconds"]) for r in results if r["route"] == route and r["case"] in sizes)
        if points:
            axes.plot(*zip(*points, strict=True), marker=mark, markersize=5, label=title)
    axes.set_yscale("log")
    _label(axes, "seconds, from formula to policy")
    return figure


def _sweeps(results: Sequence[Result]) -> Figure:
    figure = Figure(figsize=(7, 3), layout="constrained")
    axes = figure.subplots()
    for mark, (toys, points) in zip(MARKS, sweep_points(results).items(), strict=False):
        axes.plot(*zip(*points, strict=True), marker=mark, markersize=5, label=f"{toys} toys")
    axes.set_xlim(LEAST_STATES, 3e8)
    axes.set_ylim(bottom=0)
    _label(axes, "ns a product state and sweep")
    return figure


def _label(axes: Axes, what: str) -> None:
    axes.set_xscale("log")
    axes.set_xlabel("product states (world × automaton)")
    axes.set_ylabel(what)
    axes.grid(visible=True, which="major", alpha=0.3)
    if axes.get_lines():
        axes.legend(frameon=False)


def _save(figure: Figure, file: Path) -> None:
    figure.savefig(file.with_suffix(".svg"), metadata={"Date": None})
    figure.savefig(file.with_suffix(".png"), dpi=160)
