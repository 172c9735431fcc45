"""Pictures as SVG that needs nothing else to be looked at, on a light or dark ground as the reader prefers."""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping, Sequence
from xml.sax.saxutils import escape, quoteattr

from models.world.picture.shapes import DARK, STYLES, Circle, Group, Line, Picture, Polygon, Rect, Shape, Style, Text

_NOT_XML = re.compile("[^\t\n\r -\ud7ff\ue000-\ufffd\U00010000-\U0010ffff]")
_FONT = "system-ui, 'Segoe UI', 'DejaVu Sans', 'Liberation Sans', sans-serif"


def to_svg(picture: Picture) -> str:
    """The picture as an SVG document."""
    size = f'width="{picture.width:.0f}" height="{picture.height:.0f}"'
    return "\n".join(
        [
            f'<svg xmlns="http://www.w3.org/2000/svg" class="world-picture" {size}'
            f' viewBox="0 0 {picture.width:g} {picture.height:g}" role="img">',
            f"<title>{_text(picture.title)}</title>",
            f"<style>{_css()}</style>",
            *(_element(part) for part in picture.parts),
            "</svg>\n",
        ]
    )


def _css() -> str:
    light = "".join(_rules(STYLES))
    hidden = ".inside text[data-part]{display:none}"
    return f"text{{font-family:{_FONT}}}{hidden}{light}@media (prefers-color-scheme:dark){{{''.join(_rules(DARK))}}}"


def _rules(styles: Mapping[str, Style]) -> Iterator[str]:
    for kind, style in styles.items():
        yield f".{kind}:not([fill]){{fill:{style.fill or 'none'}}}"
        rule = f".{kind}{{stroke:{style.stroke or 'none'}"
        if style.stroke:
            rule += f";stroke-width:{style.width:g};stroke-linecap:round;stroke-linejoin:round"
        if style.opacity < 1:
            rule += f";fill-opacity:{style.opacity:g}"
        if style.dashed:
            rule += ";stroke-dasharray:1 7"
        yield rule + "}"


def _element(shape: Shape) -> str:
    match shape:
        case Group():
            return _group(shape)
        case Rect():
            body = f'x="{shape.x:g}" y="{shape.y:g}" width="{shape.width:g}" height="{shape.height:g}"'
            rounded = f' rx="{shape.radius:g}"' if shape.radius else ""
            return f"<rect{_class(shape.kind, shape.fill)} {body}{rounded}{_data(shape.data)}/>"
        case Circle():
            place = f'cx="{shape.x:g}" cy="{shape.y:g}" r="{shape.radius:g}"'
            return f"<circle{_class(shape.kind, shape.fill)} {place}/>"
        case Polygon():
            return f'<polygon{_class(shape.kind, shape.fill)} points="{_points(shape.points)}"/>'
        case Line():
            return f'<polyline{_class(shape.kind, None)} points="{_points(shape.points)}"/>'
        case Text():
            return _line(shape)


def _group(group: Group) -> str:
    title = f"<title>{_text(group.title)}</title>" if group.title else ""
    kind = f' class="{group.kind}"' if group.kind else ""
    moves = f"translate({group.x:g} {group.y:g})" + (f" scale({group.scale:g})" if group.scale != 1 else "")
    place = f' transform="{moves}"' if (group.x, group.y, group.scale) != (0, 0, 1) else ""
    parts = "\n".join(map(_element, group.parts))
    return f"<g{kind}{place}{_data(group.data)}>{title}{parts}</g>"


def _line(text: Text) -> str:
    anchor = ' text-anchor="middle"' if text.middle else ""
    bold = ' font-weight="600"' if text.bold else ""
    place = f'x="{text.x:g}" y="{text.y:g}" font-size="{text.size:g}"'
    return f'<text class="{text.kind}" {place}{anchor}{bold}{_data(text.data)}>{_text(text.text)}</text>'


def _class(kind: str, fill: str | None) -> str:
    return f' class="{kind}"' + (f' fill="{fill}"' if fill else "")


def _points(points: Sequence[tuple[float, float]]) -> str:
    return " ".join(f"{x:g},{y:g}" for x, y in points)


def _data(data: Mapping[str, str]) -> str:
    return "".join(f" data-{name}={quoteattr(_valid(value))}" for name, value in data.items())


def _text(text: str) -> str:
    return escape(_valid(text))


def _valid(text: str) -> str:
    return _NOT_XML.sub("\ufffd", text)
