"""A world in a state as text, for terminals."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from models.world.environment import Environment
from models.world.grid import Grid
from models.world.picture.layout import Layout, layout_of
from models.world.picture.scene import said, shown
from models.world.world import State

WIDEST = 18
"""Most characters across a cell."""
LEAST = 5


def to_text(environment: Environment, state: State) -> str:
    """The map with the names of what is in each cell; without a map, the state in words.

    A cell has the name of its region or its own, the robot as `@`, and what is there; `(...)` is in or on what stands
    before it. Solid lines are walls, open sides can be passed.
    """
    layout = layout_of(environment)
    if layout is None:
        return said(state)
    lines = {cell: _lines(cell, layout, state) for cell in layout.grid.cells}
    longest = max(len(line) for found in lines.values() for line in found)
    width = min(WIDEST, max(LEAST, longest)) + 2
    height = max(len(found) for found in lines.values())
    rows = [_edge(layout.grid, layout.columns, 0, width)]
    for y in range(layout.rows):
        for number in range(height):
            rows.append(_row(layout, lines, y, number, width))
        rows.append(_edge(layout.grid, layout.columns, y + 1, width))
    return "\n".join(row.rstrip() for row in rows)


def changes(before: State, after: State) -> str:
    """What one state has that another one had not, in words; "nothing changes" where they are alike."""
    found = [
        f"{shown(name)} {attribute} {shown(value)}"
        for name, attributes in after.items()
        for attribute, value in attributes.items()
        if before.get(name, {}).get(attribute) != value
    ]
    return ", ".join(found) or "nothing changes"


def _lines(cell: str, layout: Layout, state: State) -> list[str]:
    spots = layout.place(state)
    region = next((name for name, cells in layout.regions.items() if cells[0] == cell), None)
    title = [shown(region)] if region else [] if cell in layout.generated else [shown(cell)]
    left, top = (100.0 * place for place in layout.grid.cells[cell])
    here = [
        name
        for name, spot in spots.items()
        if spot.host is None and left <= spot.x < left + 100 and top <= spot.y < top + 100
    ]
    carried = {name: [inner for inner, spot in spots.items() if spot.host == name] for name in spots}

    def say(name: str) -> str:
        inner = carried[name]
        known = "@" if name == layout.robot else shown(name)
        return f"{known} ({', '.join(map(say, inner))})" if inner else known

    return [line[:WIDEST] for line in [*title, *map(say, sorted(here, key=lambda name: name != layout.robot))]]


def _row(layout: Layout, lines: Mapping[str, Sequence[str]], y: int, number: int, width: int) -> str:
    cells = {place: name for name, place in layout.grid.cells.items()}
    row = ""
    for x in range(layout.columns + 1):
        west, east = cells.get((x - 1, y)), cells.get((x, y))
        row += "│" if _apart(layout.grid, west, east, "east", "west") else " "
        found = lines[east] if east else []
        row += (" " + (found[number] if number < len(found) else "")).ljust(width) if x < layout.columns else ""
    return row


def _edge(grid: Grid, columns: int, y: int, width: int) -> str:
    cells = {place: name for name, place in grid.cells.items()}
    row = ""
    for x in range(columns):
        north, south = cells.get((x, y - 1)), cells.get((x, y))
        row += "┼" + ("─" if _apart(grid, north, south, "south", "north") else " ") * width
    return row + "┼"


def _apart(grid: Grid, one: str | None, other: str | None, there: str, back: str) -> bool:
    """Whether nothing passes between two neighbouring places, of which one is a cell."""
    if one is None or other is None:
        return (one or other) is not None
    return grid.neighbours[one][there] == one and grid.neighbours[other][back] == other
