"""The paper's two figures of accuracy over training epochs, with the range over seeds."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

import matplotlib as mpl
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.ticker import FixedLocator, FuncFormatter, NullLocator

from models.language.dataset import Domain
from models.language.experiments.commands import AS_IS
from models.language.experiments.default import WITH
from models.language.experiments.measurement import OVERALL
from models.language.experiments.paper_systems import CQ, LTL, LTL_NAMES, POS, QUERY_NAMES

FIGURES = ("accuracy-overall", "accuracy-by-task")
"""The names of the figures' files."""
COLORS = {CQ: "#0072b2", POS: "#d55e00", LTL: "#009e73"}  # told apart by the colour-blind too (Okabe & Ito 2008)
DEFAULT_COLOR = "#444444"
SETS = {"S": "seen", "U": "unseen"}
_STYLE: Any = {
    "font.size": 9,
    "axes.titlesize": 9.5,
    "axes.spines.top": False,
    "axes.spines.right": False,
    "axes.grid": True,
    "axes.axisbelow": True,
    "grid.color": "#e2e2e2",
    "grid.linewidth": 0.6,
    "lines.linewidth": 1.5,
    "lines.markersize": 5,
    "svg.fonttype": "none",  # text stays text
    "svg.hashsalt": "cqltl",  # the same bytes every time
}
_DOTTED = (0, (1.2, 1.6))
_DASHED = (0, (6, 3))

Look = dict[str, Any]


def draw(results: Mapping[str, Any], folder: Path) -> list[Path]:
    """Both figures as SVG and PNG in a folder; the same results give the same SVG. Needs the paper's part."""
    folder.mkdir(parents=True, exist_ok=True)
    written = []
    with mpl.rc_context(_STYLE):
        for name, figure in zip(FIGURES, (_overall(results), _by_task(results)), strict=True):
            for kind, metadata in (("svg", {"Date": None, "Creator": None}), ("png", {"Software": None})):
                written.append(folder / f"{name}.{kind}")
                figure.savefig(written[-1], dpi=160, metadata=metadata)
    return written


def _overall(results: Mapping[str, Any]) -> Figure:
    """Two by two: manipulation over navigation, seen beside unseen."""
    figure = Figure(figsize=(8.4, 6.6), layout="constrained")
    panels = figure.subplots(2, 2, sharex=True, sharey=True)
    for row, domain in zip(panels, Domain, strict=True):
        part = results["paper"][domain]
        for axes, (name, said) in zip(row, SETS.items(), strict=True):
            axes.set_title(f"{str(domain).capitalize()}, {said} vocabulary ({name})")
            _reference(axes, results, name, domain, OVERALL, _DASHED)
            for system, curves in part["curves"].items():
                group = curves[name][OVERALL]
                if system in QUERY_NAMES:
                    _curve(axes, part["epochs"], group["query"], _query_look(system))
                _curve(axes, part["epochs"], group["ltl"], _ltl_look(system))
            _axis(axes, part["epochs"])
    _label_edges(panels)
    entries = [
        *(_entry(f"{label}: contextual queries", _query_look(system)) for system, label in QUERY_NAMES.items()),
        *(_entry(f"{label}: grounded LTL", _ltl_look(system)) for system, label in LTL_NAMES.items()),
        *_reference_entries(results, {"default translator: grounded LTL": _DASHED}),
    ]
    figure.legend(handles=entries, loc="outside lower center", ncols=2, frameon=False)
    return figure


def _by_task(results: Mapping[str, Any]) -> Figure:
    """One panel for each task class, grounded LTL only; seen dotted, unseen solid."""
    figure = Figure(figsize=(13, 5.8), layout="constrained")
    panels = figure.subplots(2, 4, sharex=True, sharey=True)
    for row, domain in zip(panels, Domain, strict=True):
        part = results["paper"][domain]
        final = part["final"][LTL]
        tasks = [task for task in final["S"] if task != OVERALL]
        for axes, task in zip(row, tasks, strict=False):
            sizes = ", ".join(f"{name} {final[name][task]['commands']}" for name in SETS)
            axes.set_title(f"{task} ({sizes})")
            for name in SETS:
                _reference(axes, results, name, domain, task, _DOTTED if name == "S" else _DASHED)
                for system, curves in part["curves"].items():
                    _curve(axes, part["epochs"], curves[name][task]["ltl"], _set_look(system, name))
            _axis(axes, part["epochs"])
        for axes in row[len(tasks) :]:
            axes.set_axis_off()
    _label_edges(panels)
    entries = [
        _entry(f"{name}-{label}", _set_look(system, name)) for system, label in LTL_NAMES.items() for name in SETS
    ]
    entries += _reference_entries(results, {"S-default translator": _DOTTED, "U-default translator": _DASHED})
    panels[-1, -1].legend(handles=entries, loc="center", frameon=False)
    return figure


def _curve(axes: Axes, epochs: Sequence[int], spreads: Sequence[Mapping[str, float]], look: Look) -> None:
    """The mean over seeds as a line, from the least to the greatest as a band; in percent."""
    low, mean, high = ([100 * spread[key] for spread in spreads] for key in ("low", "mean", "high"))
    axes.fill_between(epochs, low, high, color=look["color"], alpha=0.13, linewidth=0)
    axes.plot(epochs, mean, **look, clip_on=False)


def _reference(
    axes: Axes, results: Mapping[str, Any], name: str, domain: Domain, group: str, style: tuple[int, tuple[float, ...]]
) -> None:
    """A level line at the mean of the default translator, where it was measured."""
    if "default" in results:
        rate = results["default"]["accuracy"][AS_IS][name][domain][WITH][group]["ltl"]["mean"]
        axes.axhline(100 * rate, color=DEFAULT_COLOR, linestyle=style, linewidth=1, zorder=2, clip_on=False)


def _reference_entries(results: Mapping[str, Any], styles: Mapping[str, Any]) -> list[Line2D]:
    if "default" not in results:
        return []
    look = {"color": DEFAULT_COLOR, "linewidth": 1}
    return [_entry(label, {**look, "linestyle": style}) for label, style in styles.items()]


def _axis(axes: Axes, epochs: Sequence[int]) -> None:
    axes.set_xscale("log")
    axes.xaxis.set_major_locator(FixedLocator(list(epochs)))
    axes.xaxis.set_minor_locator(NullLocator())
    axes.xaxis.set_major_formatter(FuncFormatter(lambda epoch, _: f"{epoch:.0f}"))
    axes.set_ylim(-3, 103)


def _label_edges(panels: Any) -> None:
    for row in panels:
        row[0].set_ylabel("correct, %")
    for axes in panels[-1]:
        axes.set_xlabel("training epoch")
    for row in panels[:-1]:
        for axes in row:
            axes.tick_params(labelbottom=True)


def _query_look(system: str) -> Look:
    look = _size(system)
    return {**look, "linestyle": ":", "marker": "o", "markerfacecolor": "white", "zorder": look["zorder"] + 0.1}


def _ltl_look(system: str) -> Look:
    return {**_size(system), "linestyle": "-", "marker": "D"}


def _set_look(system: str, name: str) -> Look:
    """Filled and solid for what was never seen; open, dotted and on top for what was."""
    look = _ltl_look(system)
    if name == "U":
        return look
    return {**look, "linestyle": ":", "markerfacecolor": "white", "zorder": look["zorder"] + 0.1}


def _size(system: str) -> Look:
    """Colour, and a width and a size of markers of its own, so that of curves that coincide each can be seen."""
    width, marker = {LTL: (3.2, 7.0), CQ: (1.9, 5.0), POS: (0.9, 3.0)}[system]
    return {"color": COLORS[system], "linewidth": width, "markersize": marker, "zorder": 5 - width / 2}


def _entry(label: str, look: Look) -> Line2D:
    return Line2D([], [], label=label, **look)
