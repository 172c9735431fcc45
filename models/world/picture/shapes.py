"""What pictures are made of, whether they become SVG or pixels.

Every shape has a `kind` that says how it looks; `STYLES` has the looks, `DARK` what differs on a dark ground.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from typing import NamedTuple


class Style(NamedTuple):
    """Colours as `#rrggbb`, None for nothing; widths in hundredths of a cell."""

    fill: str | None = None
    stroke: str | None = None
    width: float = 0.0
    opacity: float = 1.0  # of the filling
    dashed: bool = False


INK, PAPER, SOFT = "#1f2933", "#ffffff", "#52606d"

STYLES: dict[str, Style] = {
    "ground": Style(fill="#e4e7eb"),
    "cell": Style(fill=PAPER, stroke="#d3d9e0", width=1.0),
    "tint": Style(fill="#9aa5b1", opacity=0.2),
    "wall": Style(stroke="#3e4c59", width=4.0),
    "name": Style(fill=INK),
    "label": Style(fill=SOFT),
    "status": Style(fill=INK),
    "thing": Style(fill="#9aa5b1", stroke=INK, width=1.6),
    "detail": Style(stroke=INK, width=1.6),
    "sign": Style(fill=INK),
    "robot": Style(fill="#3d5afe", stroke=INK, width=1.8),
    "eye": Style(fill=PAPER),
    "trail": Style(stroke="#3d5afe", width=3.5, dashed=True),
    "stop": Style(fill="#3d5afe"),
    "caption": Style(fill=INK),
}
DARK: dict[str, Style] = {
    "ground": Style(fill="#0f1720"),
    "cell": Style(fill="#1e2a36", stroke="#33424f", width=1.0),
    "tint": Style(fill="#9aa5b1", opacity=0.26),
    "wall": Style(stroke="#b6c2cf", width=4.0),
    "name": Style(fill="#f5f7fa"),
    "label": Style(fill="#b6c2cf"),
    "status": Style(fill="#f5f7fa"),
    "thing": Style(fill="#9aa5b1", stroke="#f5f7fa", width=1.6),
    "detail": Style(stroke="#f5f7fa", width=1.6),
    "trail": Style(stroke="#8c9eff", width=3.5, dashed=True),
    "robot": Style(fill="#536dfe", stroke="#f5f7fa", width=1.8),
    "stop": Style(fill="#8c9eff"),
    "caption": Style(fill="#f5f7fa"),
}

COLORS = {
    "red": "#e5484d",
    "green": "#2f9e5b",
    "blue": "#3b82f6",
    "yellow": "#f2c037",
    "orange": "#f08c2e",
    "purple": "#9b5de5",
    "white": "#fafafa",
    "black": "#3a3f45",
    "brown": "#a9713f",
    "pink": "#ec6ead",
    "grey": "#8a94a0",
    "gray": "#8a94a0",
    "teal": "#1aa6a6",
}
"""Of attribute values with these names; others are drawn grey, and every thing has its name beside it anyway."""


@dataclass(frozen=True, slots=True)
class Rect:
    """An upright rectangle."""

    x: float
    y: float
    width: float
    height: float
    kind: str
    fill: str | None = None  # instead of that of the kind
    radius: float = 0.0
    data: Mapping[str, str] = field(default_factory=dict)


@dataclass(frozen=True, slots=True)
class Circle:
    """A circle."""

    x: float
    y: float
    radius: float
    kind: str
    fill: str | None = None


@dataclass(frozen=True, slots=True)
class Polygon:
    """A closed polygon."""

    points: Sequence[tuple[float, float]]
    kind: str
    fill: str | None = None


@dataclass(frozen=True, slots=True)
class Line:
    """A line through points."""

    points: Sequence[tuple[float, float]]
    kind: str


@dataclass(frozen=True, slots=True)
class Text:
    """One line of text; (x, y) is on its base line."""

    x: float
    y: float
    text: str
    kind: str
    size: float
    middle: bool = False
    bold: bool = False
    data: Mapping[str, str] = field(default_factory=dict)


@dataclass(frozen=True, slots=True)
class Group:
    """Shapes drawn around (0, 0), moved to (x, y) and scaled. `title` is its name for people."""

    parts: Sequence[Shape]
    x: float = 0.0
    y: float = 0.0
    scale: float = 1.0
    kind: str = ""
    title: str = ""
    data: Mapping[str, str] = field(default_factory=dict)


Shape = Rect | Circle | Polygon | Line | Text | Group


@dataclass(frozen=True, slots=True)
class Picture:
    """A picture with what it shows in words."""

    width: float
    height: float
    title: str
    parts: Sequence[Shape]
