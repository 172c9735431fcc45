"""The dynamics of toys and navigation once more, in plain Python on tuples, from their description in words.

A grid of columns x rows with walls at its edge. A move goes where it should with 1 - slip, to each side with
slip / 2; against a wall one stays. A grasp fails with slip. At most one thing is held, and the robot grasps
only what is where it is.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

HELD, BOXED = "held", "boxed"
_MOVES = {"north": (0, -1), "south": (0, 1), "east": (1, 0), "west": (-1, 0)}
_SIDES = {
    "north": ("west", "east"),
    "south": ("west", "east"),
    "east": ("north", "south"),
    "west": ("north", "south"),
}

Cell = tuple[int, int]
ToysState = tuple[Cell, Cell | str, tuple[Cell | str, ...]]
"""The robot's cell; the box's or HELD; each toy's, HELD or BOXED."""


def _mix(*outcomes: tuple[float, object]) -> dict[object, float]:
    result: dict[object, float] = {}
    for chance, state in outcomes:
        if chance > 0:
            result[state] = result.get(state, 0.0) + chance
    return result


@dataclass(frozen=True)
class Grid:
    """Where moves lead."""

    columns: int
    rows: int
    slip: float
    blocked: frozenset[Cell] = frozenset()

    def ahead(self, cell: Cell, direction: str) -> Cell:
        x, y = cell[0] + _MOVES[direction][0], cell[1] + _MOVES[direction][1]
        inside = 0 <= x < self.columns and 0 <= y < self.rows and (x, y) not in self.blocked
        return (x, y) if inside else cell

    def moves(self, cell: Cell) -> dict[str, list[tuple[float, Cell]]]:
        return {
            name: [
                (1 - self.slip, self.ahead(cell, name)),
                *((self.slip / 2, self.ahead(cell, s)) for s in _SIDES[name]),
            ]
            for name in _MOVES
        }


@dataclass(frozen=True)
class Toys:
    """The manipulation world."""

    grid: Grid
    toys: tuple[str, ...]

    def dynamics(self, state: ToysState) -> Mapping[str, Mapping[object, float]]:
        robot, box, toys = state
        slip = self.grid.slip
        free = box != HELD and HELD not in toys
        actions = {
            name: _mix(*((chance, (cell, box, toys)) for chance, cell in outcomes))
            for name, outcomes in self.grid.moves(robot).items()
        }
        if free and box == robot:
            actions["pick(box)"] = _mix((1 - slip, (robot, HELD, toys)), (slip, state))
        if box == HELD:
            actions["drop(box)"] = {(robot, robot, toys): 1.0}
        for i, toy in enumerate(self.toys):
            moved = {where: (robot, box, (*toys[:i], where, *toys[i + 1 :])) for where in (HELD, BOXED, robot)}
            if free and toys[i] == robot:
                actions[f"pick({toy})"] = _mix((1 - slip, moved[HELD]), (slip, state))
            if toys[i] == HELD:
                actions[f"drop({toy})"] = {moved[robot]: 1.0}
                if box == robot:
                    actions[f"put({toy}, box)"] = {moved[BOXED]: 1.0}
            if free and toys[i] == BOXED and box == robot:
                actions[f"take({toy}, box)"] = _mix((1 - slip, moved[HELD]), (slip, state))
        return actions

    def holds(self, state: ToysState, function: str, *arguments: object) -> bool:
        """`at(x, cell)`, `in(toy, box)`, `holding(x)` with cells as coordinates."""
        robot, box, toys = state
        where = dict(zip(self.toys, toys, strict=True)) | {"robot": robot, "box": box}
        match function, arguments:
            case "at", (thing, cell):
                return (box if where[str(thing)] == BOXED else where[str(thing)]) == cell
            case "in", (toy, "box"):
                return where[str(toy)] == BOXED
            case "holding", (thing,):
                return where[str(thing)] == HELD
        raise AssertionError((function, arguments))


@dataclass(frozen=True)
class Navigation:
    """The robot alone."""

    grid: Grid

    def dynamics(self, state: Cell) -> Mapping[str, Mapping[object, float]]:
        return {name: _mix(*outcomes) for name, outcomes in self.grid.moves(state).items()}
