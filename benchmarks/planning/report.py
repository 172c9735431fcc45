"""The results as tables, and whether they agree."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence

from benchmarks.planning.cases import TITLES
from benchmarks.planning.measuring import DONE, Result

Cell = Callable[[Result, Result | None], str]
"""What a table says of a result, next to ours on the same case."""
TOLERANCE = 1e-5
"""By how much values of two routes may differ, relatively."""


def agree(left: Sequence[float], right: Sequence[float]) -> bool:
    """Whether two values, given by bounds, may be the same."""
    slack = TOLERANCE * max(map(abs, (*left, *right)))
    return left[0] <= right[1] + slack and right[0] <= left[1] + slack


def mismatches(results: Sequence[Result]) -> list[str]:
    """The values of routes on the same case that differ."""
    found = []
    done = [result for result in results if result["status"] == DONE]
    for index, left in enumerate(done):
        for right in done[index + 1 :]:
            if left["case"] != right["case"]:
                continue
            for name in left["values"].keys() & right["values"].keys():
                if not agree(left["values"][name], right["values"][name]):
                    sides = (f"{side['route']} {side['values'][name]}" for side in (left, right))
                    found.append(f"{left['case']}, {name}: {', '.join(sides)}")
    return found


def tables(results: Sequence[Result]) -> Iterator[str]:
    """Markdown lines: seconds with the ratio to ours, the parts of them, memory; random MDPs apart from the worlds."""
    for random in (False, True):
        chosen = [result for result in results if result["case"].startswith("random") is random]
        if not chosen:
            continue
        yield from _table("Time, and how many times ours", chosen, time_cell)
        yield from _table("Parts of the time", chosen, parts_cell)
        yield from _table("Memory", chosen, memory_cell)
        yield from _table("Value", chosen, value_cell)


def time_cell(result: Result, ours: Result | None) -> str:
    """`4.55 s (11)`."""
    if ours is None or ours["status"] != DONE or ours is result:
        return seconds(result["seconds"])
    ratio = result["seconds"] / ours["seconds"]
    return f"{seconds(result['seconds'])} ({f'{ratio:,.0f}' if ratio >= 10 else f'{ratio:.2g}'}×)"


def parts_cell(result: Result, _ours: Result | None) -> str:
    """`build 0.4 s, check 4.1 s`."""
    return ", ".join(f"{part} {seconds(value)}" for part, value in result["parts"].items())


def memory_cell(result: Result, _ours: Result | None) -> str:
    """`411 MiB`."""
    mib = result["bytes"] / 2**20
    return f"{mib:,.0f} MiB" if mib >= 10 else f"{mib:.1f} MiB"


def value_cell(result: Result, _ours: Result | None) -> str:
    """`9.844067 steps`, and the probability where that is all or is not 1."""
    values = {name: sum(bounds) / 2 for name, bounds in result["values"].items()}
    shown = [f"{values['steps']:.6f} steps"] if "steps" in values else []
    if "probability" in values and (not shown or values["probability"] < 1 - TOLERANCE):
        shown.append(f"probability {values['probability']:.6f}")
    return ", ".join(shown)


def seconds(value: float) -> str:
    """Three digits."""
    if value < 1:
        return f"{value * 1000:.3g} ms"
    return f"{value:.3g} s" if value < 100 else f"{value:,.0f} s"


def product_states(results: Sequence[Result]) -> dict[str, int]:
    """By case, as our planner counts them."""
    return {
        result["case"]: result["notes"]["product_states"]
        for result in results
        if result["route"] in ("ours", "ours-gpu") and result["status"] == DONE
    }


def _table(title: str, results: Sequence[Result], cell: Cell) -> Iterator[str]:
    routes = [route for route in TITLES if any(result["route"] == route for result in results)]
    sizes = product_states(results)
    yield f"\n{title}:\n"
    yield f"| world | product states | {' | '.join(TITLES[route] for route in routes)} |"
    yield "|---" * (len(routes) + 2) + "|"
    for case in dict.fromkeys(result["case"] for result in results):
        row = {result["route"]: result for result in results if result["case"] == case}
        cells = (_cell(row.get(route), row.get("ours"), cell) for route in routes)
        size = f"{sizes[case]:,}" if case in sizes else ""
        yield f"| {case} | {size} | {' | '.join(cells)} |"


def _cell(result: Result | None, ours: Result | None, cell: Cell) -> str:
    if result is None:
        return ""
    return cell(result, ours) if result["status"] == DONE else str(result["status"])
