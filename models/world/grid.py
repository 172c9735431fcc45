"""Cells drawn as a map, and how they are connected."""

from __future__ import annotations

from dataclasses import dataclass

from models.world.limits import MAX_OBJECTS
from models.world.name_faults import name_fault
from models.world.names import hint
from models.world.report import Report
from models.world.specs import GridSpec

DIRECTIONS = {"north": (0, -1), "south": (0, 1), "east": (1, 0), "west": (-1, 0)}
BLOCKED = "#"
UNNAMED = "."


@dataclass(frozen=True, slots=True)
class Grid:
    """Cell name to column and row, and to neighbour by direction; an edge or wall leads back to the cell
    itself.
    """

    cells: dict[str, tuple[int, int]]
    neighbours: dict[str, dict[str, str]]


def read_grid(spec: GridSpec, report: Report) -> Grid:
    """The cells of a map in reading order; faults go to the report (rooted at the environment)."""
    cells = _cells(spec, report)
    walls = _walls(spec, cells, report)
    by_place = {place: name for name, place in cells.items()}
    neighbours: dict[str, dict[str, str]] = {}
    for name, (column, row) in cells.items():
        ahead = {d: by_place.get((column + dx, row + dy), name) for d, (dx, dy) in DIRECTIONS.items()}
        neighbours[name] = {d: name if (name, other) in walls else other for d, other in ahead.items()}
    return Grid(cells, neighbours)


def _cells(spec: GridSpec, report: Report) -> dict[str, tuple[int, int]]:
    if sum(map(len, spec.map)) > MAX_OBJECTS:
        report.add(["grid", "map"], f"at most {MAX_OBJECTS} cells")
        return {}
    _names(spec, report)
    cells: dict[str, tuple[int, int]] = {}
    used: set[str] = set()
    for y, line in enumerate(spec.map):
        if len(line) != len(spec.map[0]):
            report.add(["grid", "map", y], f"the row has {len(line)} characters, the first {len(spec.map[0])}")
        for x, character in enumerate(line):
            if character == BLOCKED:
                continue
            if character != UNNAMED and character not in spec.names:
                report.add(["grid", "map", y], f"the character {character!r} is not in names")
            elif character in used:
                report.add(["grid", "map", y], f"the named cell {character!r} is on the map twice")
            else:
                name = f"{spec.class_}_{x + 1}_{y + 1}" if character == UNNAMED else spec.names[character]
                if name in cells:
                    report.add(["grid", "map", y], f"two cells are called {name}")
                cells[name] = (x, y)
            used |= {character} - {UNNAMED}
    for character in spec.names:
        if character not in used | {BLOCKED, UNNAMED}:
            report.add(["grid", "names", character], f"{character!r} is not on the map")
    if not cells:
        report.add(["grid", "map"], "the map has no cell")
    return cells


def _names(spec: GridSpec, report: Report) -> None:
    for character, name in spec.names.items():
        if len(character) != 1 or character in (BLOCKED, UNNAMED):
            report.add(["grid", "names", character], f"a key is one character other than {BLOCKED} and {UNNAMED}")
        if fault := name_fault(name):
            report.add(["grid", "names", character], fault)


def _walls(spec: GridSpec, cells: dict[str, tuple[int, int]], report: Report) -> set[tuple[str, str]]:
    if len(spec.walls) > 4 * MAX_OBJECTS:
        report.add(["grid", "walls"], f"at most {4 * MAX_OBJECTS} walls")
        return set()
    walls: set[tuple[str, str]] = set()
    for index, pair in enumerate(spec.walls):
        path = ("grid", "walls", index)
        unknown = [name for name in pair if name not in cells]
        if len(pair) != 2:
            report.add(path, "a wall is a pair of cells")
        elif unknown:
            report.add(path, f"no cell is called {unknown[0]}{hint(unknown[0], cells)}")
        else:
            (ax, ay), (bx, by) = cells[pair[0]], cells[pair[1]]
            if abs(ax - bx) + abs(ay - by) != 1:
                report.add(path, f"{pair[0]} and {pair[1]} are not neighbours")
            walls |= {(pair[0], pair[1]), (pair[1], pair[0])}
    return walls
