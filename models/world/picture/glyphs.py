"""How things look, by what the world says of them: their shape, whether others may be in them, whether they move."""

from __future__ import annotations

import math
from collections.abc import Mapping

from models.world.picture.layout import Layout
from models.world.picture.shapes import COLORS, Circle, Line, Polygon, Rect, Shape, Text

GREY = "#9aa5b1"


def glyph(name: str, layout: Layout) -> list[Shape]:
    """The shapes of a thing around (0, 0), about 30 wide and high."""
    attributes = layout.attributes.get(name, {})
    fill = color_of(attributes) or GREY
    if name == layout.robot:
        return _robot()
    if name in layout.containers:
        return _rack(fill) if name in layout.fixtures else _box(fill)
    if name in layout.fixtures:
        return _appliance(name, fill)
    known = {"sphere": _sphere, "cylinder": _cylinder, "cube": _cube, "cone": _cone}
    shape = next((known[value] for value in attributes.values() if value in known), None)
    return shape(fill) if shape else _thing(name, fill)


def landmark(fill: str) -> list[Shape]:
    """A building around (0, 0)."""
    return [
        Polygon([(-14, -2), (0, -14), (14, -2)], "thing", fill),
        Rect(-11, -2, 22, 15, "thing", fill),
        Rect(-3, 4, 6, 9, "sign"),
    ]


def color_of(attributes: Mapping[str, str]) -> str | None:
    """The first attribute value that is a colour, as `#rrggbb`."""
    return next((COLORS[value] for value in attributes.values() if value in COLORS), None)


def letters_on(fill: str) -> str:
    """The kind of shape that is readable on a filling."""
    red, green, blue = (int(fill[place : place + 2], 16) for place in (1, 3, 5))
    return "sign" if 0.299 * red + 0.587 * green + 0.114 * blue > 110 else "eye"


def _robot() -> list[Shape]:
    return [
        Line([(0, -17), (0, -23)], "detail"),
        Circle(0, -24, 2.6, "robot"),
        Rect(-16, -17, 32, 27, "robot", radius=8),
        Circle(-6, -5, 3.8, "eye"),
        Circle(6, -5, 3.8, "eye"),
        Circle(-6, -5, 1.6, "sign"),
        Circle(6, -5, 1.6, "sign"),
        Rect(-13, 10, 10, 6, "sign", radius=2),
        Rect(3, 10, 10, 6, "sign", radius=2),
    ]


def _sphere(fill: str) -> list[Shape]:
    return [Circle(0, 0, 13, "thing", fill), Circle(-4, -5, 3, "eye")]


def _cylinder(fill: str) -> list[Shape]:
    lid = [(10 * math.cos(turn * math.pi / 12), -10 + 4 * math.sin(turn * math.pi / 12)) for turn in range(24)]
    low = [(10 * math.cos(turn * math.pi / 12), 10 + 4 * math.sin(turn * math.pi / 12)) for turn in range(13)]
    return [Polygon([(10, -10), *low, (-10, -10)], "thing", fill), Polygon(lid, "thing", fill)]


def _cube(fill: str) -> list[Shape]:
    return [
        Polygon([(-12, -5), (-5, -13), (13, -13), (6, -5)], "thing", fill),
        Polygon([(6, -5), (13, -13), (13, 5), (6, 13)], "thing", fill),
        Rect(-12, -5, 18, 18, "thing", fill),
    ]


def _cone(fill: str) -> list[Shape]:
    return [Polygon([(0, -15), (12, 12), (-12, 12)], "thing", fill)]


def _box(fill: str) -> list[Shape]:
    """Open above, so that what is in it can be seen."""
    return [
        Polygon([(-19, -7), (-13, -13), (13, -13), (19, -7)], "thing", fill),
        Polygon([(-19, -7), (19, -7), (16, 13), (-16, 13)], "thing", fill),
    ]


def _rack(fill: str) -> list[Shape]:
    return [
        Rect(-21, -19, 42, 30, "cell"),
        *(Rect(-21, height, 42, 4, "thing", fill) for height in (-19, -5, 8)),
        Line([(-21, -19), (-21, 13)], "detail"),
        Line([(21, -19), (21, 13)], "detail"),
    ]


def _appliance(name: str, fill: str) -> list[Shape]:
    return [
        Rect(-16, -16, 32, 32, "thing", fill, radius=4),
        Circle(0, 3, 8.5, "cell"),
        Text(0, 6.5, name[:1].upper(), "sign", 10, middle=True, bold=True),
        Line([(-11, -10.5), (3, -10.5)], "detail"),
    ]


def _thing(name: str, fill: str) -> list[Shape]:
    return [
        Rect(-13, -12, 26, 25, "thing", fill, radius=6),
        Text(0, 5, name[:1].upper(), letters_on(fill), 13, middle=True, bold=True),
    ]
