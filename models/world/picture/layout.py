"""Where everything stands on the picture of a world, read off what the domain says of cells, places and containers.

Lengths are in hundredths of a cell: the cell in column x and row y has its upper left corner at (100 x, 100 y). The
page places things by the same rules (`service/http/static/world.js`); a test compares the two.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

from models.world.environment import Environment
from models.world.grid import DIRECTIONS, Grid
from models.world.vocabulary import Symbol
from models.world.world import State

CELL = 100.0
"""Side of a cell."""
FIXTURE = (67.0, 31.0)
"""In a cell: what always stands there."""
ROBOT = (28.0, 47.0)
"""In a cell: the robot."""
FLOOR = 73.0
"""In a cell: the height at which things lie."""
HELD = (19.0, -14.0)
"""What is carried, from its carrier."""
SHRUNK = 0.66
"""Size of what is in or on something else."""
DEEPEST = 8
"""Most things within one another that are looked through."""

Segment = tuple[float, float, float, float]


@dataclass(frozen=True, slots=True)
class Spot:
    """Where a thing is drawn and how large; `host` is what it is in, on or held by."""

    x: float
    y: float
    scale: float = 1.0
    host: str | None = None


@dataclass(frozen=True, slots=True, eq=False)
class Layout:
    """What does not change while the robot acts. All by name."""

    grid: Grid
    generated: frozenset[str]  # cells whose names nobody gave
    regions: Mapping[str, tuple[str, ...]]  # what groups cells, such as rooms, with their cells
    fixtures: Mapping[str, str]  # what always stands in a cell, and which
    things: tuple[Symbol, ...]  # all that is drawn on cells, the robot last
    robot: str | None
    containers: frozenset[str]  # what others may be in or on
    attributes: Mapping[str, Mapping[str, str]]  # of things, regions and cells: those that never change

    @property
    def columns(self) -> int:
        """How many cells there are from west to east."""
        return 1 + max(x for x, _ in self.grid.cells.values())

    @property
    def rows(self) -> int:
        """How many cells there are from north to south."""
        return 1 + max(y for _, y in self.grid.cells.values())

    @property
    def region_of(self) -> dict[str, str]:
        """Cell to region."""
        return {cell: region for region, cells in self.regions.items() for cell in cells}

    def says(self, cell: str) -> str:
        """What people call a cell: its own name, else the region with the place on the map."""
        if cell not in self.generated:
            return cell.replace("_", " ")
        column, row = (place + 1 for place in self.grid.cells[cell])
        region = self.region_of.get(cell)
        place = f"column {column}, row {row}"
        return f"{region.replace('_', ' ')} ({place})" if region else place

    def walls(self) -> list[Segment]:
        """Edges of the map, and walls between neighbours: x1, y1, x2, y2, each once."""
        found: dict[Segment, None] = {}
        for name, (x, y) in self.grid.cells.items():
            for direction, (dx, dy) in DIRECTIONS.items():
                if self.grid.neighbours[name][direction] == name:
                    left, top = x + max(dx, 0), y + max(dy, 0)
                    across = (0, 1) if dx else (1, 0)
                    ends = (left, top, left + across[0], top + across[1])
                    found[tuple(CELL * end for end in ends)] = None  # type: ignore[index]  # of four numbers
        return list(found)

    def place(self, state: State) -> dict[str, Spot]:
        """Where each thing is drawn in a state; what is nowhere stands below the map."""
        hosts = {symbol.name: self._host(symbol.name, state) for symbol in self.things}
        spots: dict[str, Spot] = {}
        for cell in self.grid.cells:
            self._fill(cell, [name for name, host in hosts.items() if host == cell], spots)
        nowhere = [name for name, host in hosts.items() if host is None]
        for number, name in enumerate(nowhere):
            spots[name] = Spot(CELL * (number + 0.5), CELL * self.rows + 40)
        for _ in range(DEEPEST):
            for host in list(spots):
                inside = [name for name, owner in hosts.items() if owner == host and name not in spots]
                self._load(host, inside, spots)
        return {symbol.name: spots[symbol.name] for symbol in self.things if symbol.name in spots}

    def _host(self, name: str, state: State) -> str | None:
        """The cell or thing that something is in."""
        if name in self.fixtures:
            return self.fixtures[name]
        known = {symbol.name for symbol in self.things} - {name}
        for value in state.get(name, {}).values():
            if value in self.grid.cells or value in known:
                return value
        return None

    def _fill(self, cell: str, names: list[str], spots: dict[str, Spot]) -> None:
        left, top = (CELL * place for place in self.grid.cells[cell])
        lying = [name for name in names if name not in self.fixtures and name != self.robot]
        for name in names:
            if name in self.fixtures:
                spots[name] = Spot(left + FIXTURE[0], top + FIXTURE[1])
            elif name == self.robot:
                spots[name] = Spot(left + ROBOT[0], top + ROBOT[1])
        for number, name in enumerate(lying):
            spots[name] = Spot(left + CELL * (number + 1) / (len(lying) + 1), top + FLOOR)

    def _load(self, host: str, names: list[str], spots: dict[str, Spot]) -> None:
        base = spots[host]
        for number, name in enumerate(names):
            dx, dy = HELD if host == self.robot else (11.0 * (number - (len(names) - 1) / 2), -9.0)
            scale = base.scale * SHRUNK
            spots[name] = Spot(base.x + base.scale * dx, base.y + base.scale * dy, scale, host)


def layout_of(environment: Environment) -> Layout | None:
    """The layout of a world whose cells were drawn as a map; None of others."""
    grid = environment.grid
    if grid is None:
        return None
    vocabulary = environment.vocabulary
    cells = [symbol for symbol in vocabulary.objects if symbol.name in grid.cells]
    kind = cells[0].kind
    regions = _regions(environment, cells)
    fixtures = _fixtures(environment, kind)
    movable = {variable.object for variable in environment.world.variables}
    drawn = [
        symbol
        for symbol in vocabulary.objects
        if symbol.name not in grid.cells and (symbol.name in movable or symbol.name in fixtures)
    ]
    robot = next((symbol.name for symbol in vocabulary.constants if symbol in drawn), None)
    drawn.sort(key=lambda symbol: (symbol.name == robot, symbol.name not in fixtures))
    holding = {kind for kinds in vocabulary.state_kinds.values() for held in kinds.values() for kind in held}
    attributes = {
        symbol.name: {name: value.name for name, value in vocabulary.static.get(symbol, {}).items()}
        for symbol in vocabulary.objects
    }
    return Layout(
        grid=grid,
        generated=frozenset(f"{kind}_{x + 1}_{y + 1}" for x, y in grid.cells.values()) & grid.cells.keys(),
        regions=regions,
        fixtures=fixtures,
        things=tuple(drawn),
        robot=robot,
        containers=frozenset(symbol.name for symbol in drawn if symbol.kind in holding and symbol.name != robot),
        attributes=attributes,
    )


def _regions(environment: Environment, cells: list[Symbol]) -> dict[str, tuple[str, ...]]:
    """By the first attribute of cells, other than the compass, that holds objects of another class."""
    vocabulary = environment.vocabulary
    for attribute in vocabulary.static.get(cells[0], {}):
        held = {cell.name: vocabulary.static.get(cell, {}).get(attribute) for cell in cells}
        groups = {value for value in held.values() if value is not None}
        if attribute in DIRECTIONS or not all(vocabulary.is_object(value) for value in groups):
            continue
        names = dict.fromkeys(value.name for value in held.values() if value is not None)
        return {
            region: tuple(cell for cell, value in held.items() if value and value.name == region) for region in names
        }
    return {}


def _fixtures(environment: Environment, kind: str) -> dict[str, str]:
    """What has a cell among its unchanging attributes."""
    found: dict[str, str] = {}
    for symbol, attributes in environment.vocabulary.static.items():
        for value in attributes.values():
            if symbol.kind != kind and value.kind == kind:
                found.setdefault(symbol.name, value.name)
    return found
