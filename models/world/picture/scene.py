"""The picture of a world in a state, with the way the robot goes if one is given."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from itertools import pairwise

from models.world.environment import Environment
from models.world.picture.glyphs import GREY, color_of, glyph, landmark
from models.world.picture.layout import CELL, FIXTURE, Layout, Spot, layout_of
from models.world.picture.shapes import Circle, Group, Line, Picture, Polygon, Rect, Shape, Text
from models.world.world import State

MARGIN = 8.0
LINE = 22.0
"""Height of a line of a list."""
WIDE = 0.62
"""Width of a letter, of its height."""
SIZES = {"tiny": 0.7, "small": 0.82, "little": 0.82, "big": 1.15, "large": 1.15, "huge": 1.25}
"""How large a thing is drawn that is called so."""
MOST_CELLS = 2_500
"""Most cells of a picture, and things on it."""


def size_of(environment: Environment) -> int:
    """How many cells, things or lines the picture of a world has, whichever is more."""
    cells = 0 if environment.grid is None else len(environment.grid.cells)
    return max(cells, len(environment.world.variables))


def picture(environment: Environment, state: State, *, run: Sequence[State] = (), caption: str = "") -> Picture:
    """What a world looks like in a complete state; `run` are the states of a way to be drawn.

    Worlds whose cells were not drawn as a map are listed: a line for each attribute that changes.
    """
    layout = layout_of(environment)
    if layout is None:
        return _listed(environment, state, caption)
    spots = layout.place(state)
    ways = [layout.place(passed).get(layout.robot or "") for passed in run]
    below = any(spot.y > CELL * layout.rows for spot in spots.values())
    width, map_height = CELL * layout.columns, CELL * (layout.rows + below)
    parts: list[Shape] = [
        Rect(-MARGIN, -MARGIN, width + 2 * MARGIN, map_height + 2 * MARGIN + LINE * bool(caption), "ground"),
        Group(list(_floor(layout)), kind="floor"),
        Group(list(_trail([way for way in ways if way is not None])), kind="way"),
        Group([_thing(name, spot, layout, state) for name, spot in spots.items()], kind="things"),
    ]
    if caption:
        parts.append(Text(0, map_height + LINE - 4, caption, "caption", 12))
    height = map_height + LINE * bool(caption)
    moved = Group(parts, MARGIN, MARGIN)
    title = f"{environment.name}: {said(state)}"
    return Picture(width + 2 * MARGIN, height + 2 * MARGIN, title, [moved])


def said(state: State) -> str:
    """A state in words."""
    return ", ".join(
        f"{shown(name)} {attribute} {shown(value)}"
        for name, attributes in state.items()
        for attribute, value in attributes.items()
    )


def shown(name: str) -> str:
    """A name as people write it."""
    return name.replace("_", " ")


def _floor(layout: Layout) -> Iterator[Shape]:
    for name, (x, y) in layout.grid.cells.items():
        yield Rect(CELL * x, CELL * y, CELL, CELL, "cell", data={"cell": name, "says": layout.says(name)})
    tinted = layout.region_of
    few = len(layout.generated) > len(layout.grid.cells) / 3 and not layout.regions
    for name, (x, y) in layout.grid.cells.items():
        fill = color_of(layout.attributes.get(name, {})) or color_of(layout.attributes.get(tinted.get(name, ""), {}))
        if fill:
            yield Rect(CELL * x, CELL * y, CELL, CELL, "tint", fill)
        if few and name not in layout.generated:
            yield Group(landmark(fill or GREY), CELL * x + FIXTURE[0] - 4, CELL * y + FIXTURE[1] + 17)
    for x1, y1, x2, y2 in layout.walls():
        yield Line([(x1, y1), (x2, y2)], "wall")
    for region, cells in layout.regions.items():
        free = [cell for cell in cells if cell not in layout.fixtures.values()] or cells
        x, y = min((layout.grid.cells[cell] for cell in free), key=lambda place: (place[1], place[0]))
        columns = len({layout.grid.cells[cell][0] for cell in cells if layout.grid.cells[cell][1] == y})
        yield Text(CELL * x + 8, CELL * y + 17, shown(region), "name", fitted(shown(region), 12, columns), bold=True)
    for name, (x, y) in layout.grid.cells.items():
        if name not in layout.generated:
            yield Text(CELL * x + 8, CELL * y + 17, shown(name), "name", fitted(shown(name), 12), bold=True)


def _thing(name: str, spot: Spot, layout: Layout, state: State) -> Group:
    kind = " ".join(["thing-group", *(["inside"] if spot.host else [])])
    data = {"object": name, **({"robot": "true"} if name == layout.robot else {})}
    if name in layout.fixtures:
        data["fixed"] = layout.fixtures[name]
    size = next((SIZES[value] for value in layout.attributes.get(name, {}).values() if value in SIZES), 1.0)
    parts: list[Shape] = [Group(glyph(name, layout), scale=size)] if size != 1.0 else glyph(name, layout)
    if name != layout.robot:
        values = {a: v for a, v in state.get(name, {}).items() if v not in layout.grid.cells and not _named(v, layout)}
        letters = fitted(shown(name), 9.5, 0.75 if name in layout.fixtures else 1)
        parts.append(Text(0, 24.5, shown(name), "label", letters, middle=True, data={"part": "label"}))
        if values:
            status = ", ".join(map(shown, values.values()))
            data["status"] = " ".join(values)
            parts.append(Text(0, 34.5, status, "status", 9.5, middle=True, bold=True, data={"part": "status"}))
    return Group(parts, spot.x, spot.y, spot.scale, kind, _described(name, layout), data)


def _described(name: str, layout: Layout) -> str:
    """A thing and what never changes of it, so that its colour is not only to be seen: "cup: red"."""
    values = layout.attributes.get(name, {}).values()
    plain = [shown(value) for value in values if value not in layout.attributes and value != name]
    return f"{shown(name)}: {', '.join(plain)}" if plain else shown(name)


def _named(value: str, layout: Layout) -> bool:
    return any(value == symbol.name for symbol in layout.things)


def _trail(ways: Sequence[Spot]) -> Iterator[Shape]:
    """A line through the places where the robot comes, with a head on each piece of it."""
    for one, two in pairwise(ways):
        dx, dy = two.x - one.x, two.y - one.y
        length = (dx * dx + dy * dy) ** 0.5
        if not length:
            continue
        ux, uy = dx / length, dy / length
        x, y = one.x + 0.58 * dx, one.y + 0.58 * dy
        yield Line([(one.x, one.y), (two.x, two.y)], "trail")
        yield Polygon([(x + 6 * ux, y + 6 * uy), (x - 5 * uy, y + 5 * ux), (x + 5 * uy, y - 5 * ux)], "stop")
    if ways:
        yield Circle(ways[-1].x, ways[-1].y, 6, "stop")


def _listed(environment: Environment, state: State, caption: str) -> Picture:
    lines = [
        f"{shown(name)}: {attribute} {shown(value)}"
        for name, attributes in state.items()
        for attribute, value in attributes.items()
    ]
    texts = [
        (environment.name, "name"),
        *((line, "label") for line in lines),
        *([(caption, "caption")] if caption else []),
    ]
    width = max(200.0, *(7.5 * len(text) for text, _ in texts)) + 2 * MARGIN
    height = LINE * len(texts) + 2 * MARGIN
    parts: list[Shape] = [Rect(0, 0, width, height, "ground")]
    parts += [
        Text(MARGIN, MARGIN + LINE * number + 15, text, kind, 12, bold=kind == "name")
        for number, (text, kind) in enumerate(texts)
    ]
    return Picture(width, height, f"{environment.name}: {said(state)}", parts)


def fitted(text: str, size: float, columns: float = 1) -> float:
    """The size of letters, at most `size`, with which a text is no wider than so many cells."""
    return round(min(size, (CELL * columns - 10) / (WIDE * max(1, len(text)))), 1)
