"""Automata as SVG: pictures that need neither another program nor anything from the network to be looked at.

States stand in columns, from the initial one rightwards, with the labels of the arrows in columns between them; which
row each gets is the layout of Sugiyama, Tagawa and Toda ("Methods for visual understanding of hierarchical system
structures", 1981), by igraph. Arrows bend between columns only and pass straight through them, so they cross no text.
"""

from __future__ import annotations

import math
import re
import unicodedata
from collections.abc import Sequence, Set
from dataclasses import dataclass
from itertools import pairwise
from typing import NamedTuple
from xml.sax.saxutils import escape

MAX_STATES = 20
"""Most states of a picture; of more, nobody sees anything."""

RADIUS = 20.0
GAP = 40.0
"""Least distance of two columns, where arrows bend; more in high pictures, so that they are not too steep."""
LINE = 15.0
"""Height of a line of text."""
CHARACTER = 7.3
"""Width of a character, which is the same for all."""
LONGEST, MOST_LINES = 30, 5
"""Of a label, in characters and lines; the whole text is its tooltip."""
LOOP = 24.0
"""How far a loop rises above its state."""
MARGIN = 16.0

_STYLE = """
    text { font: 12px 'DejaVu Sans Mono', 'Liberation Mono', Menlo, Consolas, monospace; fill: #1a1a1a; }
    .name { font-weight: bold; } .middle { text-anchor: middle; }
    circle { fill: #ffffff; stroke: #1a1a1a; stroke-width: 1.5; } rect { fill: #ffffff; }
    .accepting { fill: #d9f2df; } .rejecting { fill: #f6dcdc; stroke-dasharray: 4 3; }
    .arrow { fill: none; stroke: #4a4a4a; stroke-width: 1.2; marker-end: url(#head); } marker { fill: #4a4a4a; }
    @media (prefers-color-scheme: dark) {
    text { fill: #f5f7fa; } circle { fill: #1b242d; stroke: #f5f7fa; } rect { fill: #1b242d; }
    .accepting { fill: #1f4d2e; } .rejecting { fill: #5a2a2a; }
    .arrow { stroke: #c3ced9; } marker { fill: #c3ced9; }
    }
"""
_NOT_XML = re.compile("[^\t\n\r -\ud7ff\ue000-\ufffd\U00010000-\U0010ffff]")


class Arrow(NamedTuple):
    """What leads from a state to another or itself: for each transition, the letters in words."""

    source: int
    target: int
    labels: tuple[str, ...]


@dataclass(frozen=True, slots=True)
class Diagram:
    """An automaton to be drawn: states from 0, at most one arrow for each pair of them."""

    states: int
    initial: int  # leads to all others
    accepting: Set[int]  # where every word is accepted from here
    rejecting: Set[int]  # where none is
    arrows: Sequence[Arrow]
    title: str
    notes: Sequence[str] = ()  # lines under the title


@dataclass(slots=True)
class _Box:
    """What a column has in a row: a state, a label, or an arrow that passes."""

    column: int
    width: float = 0.0
    above: float = 5.0  # height above the row
    below: float = 5.0
    lines: Sequence[str] = ()
    tooltip: str = ""
    x: float = 0.0  # middle
    y: float = 0.0


class _Point(NamedTuple):
    x: float
    y: float
    to: tuple[float, float]  # direction in which an arrow leaves rightwards, of length 1


def draw(diagram: Diagram) -> str:
    """The picture of at most MAX_STATES states. Accepting states have a double ring, rejecting ones a dashed one, and
    both say so in words.
    """
    loops = {arrow.source: arrow for arrow in diagram.arrows if arrow.source == arrow.target}
    arrows = [arrow for arrow in diagram.arrows if arrow.source != arrow.target]
    columns = _columns(diagram, arrows)
    boxes = [_state(diagram, state, 2 * columns[state], loops.get(state)) for state in range(diagram.states)]
    ways = [_way(arrow, boxes) for arrow in arrows]
    _place(boxes, ways, top=MARGIN + LINE * (1 + len(diagram.notes)) + 8)
    width = max(box.x + box.width / 2 for box in boxes)
    width = max(width, *(_length(text) for text in (diagram.title, *diagram.notes))) + 2 * MARGIN
    height = max(box.y + box.below for box in boxes) + MARGIN
    parts = [
        f'<svg xmlns="http://www.w3.org/2000/svg" width="{width:.0f}" height="{height:.0f}"'
        f' viewBox="0 0 {width:.0f} {height:.0f}" role="img">',
        f"<title>{_text(diagram.title)}</title>",
        f"<style>{_STYLE}</style>",
        '<defs><marker id="head" viewBox="0 0 10 10" refX="9" refY="5" markerWidth="8" markerHeight="8"'
        ' orient="auto"><path d="M 0 1 L 10 5 L 0 9 z"/></marker></defs>',
        f'<rect width="{width:.0f}" height="{height:.0f}"/>',
        _line(diagram.title, MARGIN, MARGIN + 10, "name"),
        *(_line(note, MARGIN, MARGIN + 10 + LINE * row, "") for row, note in enumerate(diagram.notes, start=1)),
        _start(boxes[diagram.initial]),
        *(_bend(arrow, boxes, way) for arrow, way in zip(arrows, ways, strict=True)),
        *(_label(box, box.y - LINE * len(box.lines) / 2) for box in boxes[diagram.states :] if box.lines),
        *(_circle(diagram, state, boxes[state]) for state in range(diagram.states)),
        "</svg>",
    ]
    return "\n".join(part for part in parts if part) + "\n"


def _columns(diagram: Diagram, arrows: Sequence[Arrow]) -> list[int]:
    """The column of each state: every arrow leads to another one, and only those that close a circle leftwards."""
    following: list[list[int]] = [[] for _ in range(diagram.states)]
    for arrow in arrows:
        following[arrow.source].append(arrow.target)
    order: list[int] = []
    seen: set[int] = set()

    def visit(state: int) -> None:
        seen.add(state)
        for target in sorted(following[state], reverse=True):
            if target not in seen:
                visit(target)
        order.insert(0, state)

    visit(diagram.initial)
    column = [0] * diagram.states
    for position, state in enumerate(order):
        before = (other for other in order[:position] if state in following[other] or other in following[state])
        column[state] = max((column[other] + 1 for other in before), default=0)
    return column


def _state(diagram: Diagram, state: int, column: int, loop: Arrow | None) -> _Box:
    """The box of a state, with the label of its loop above and what it says of itself below."""
    box = _Box(column, 2 * RADIUS, RADIUS + 4, RADIUS + 4)
    word = _word(diagram, state)
    if word:
        box.width, box.below = max(box.width, _length(word)), RADIUS + LINE + 6
    if loop is not None:
        box.lines, box.tooltip = _wrapped(loop.labels), "\n".join(loop.labels)
        box.width = max(box.width, *map(_length, box.lines))
        box.above = RADIUS + LOOP + LINE * len(box.lines)
    return box


def _word(diagram: Diagram, state: int) -> str:
    if state in diagram.accepting:
        return "satisfied"
    return "lost" if state in diagram.rejecting else ""


def _way(arrow: Arrow, boxes: list[_Box]) -> list[int]:
    """The boxes through which an arrow goes, one a column, from left to right; its label stands next to its source."""
    ends = boxes[arrow.source].column, boxes[arrow.target].column
    passed = [_Box(column) for column in range(min(ends) + 1, max(ends))]
    label = passed[0 if ends[0] < ends[1] else -1]
    label.lines, label.tooltip = _wrapped(arrow.labels), "\n".join(arrow.labels)
    label.width = max(map(_length, label.lines)) + 8
    label.above = label.below = LINE * len(label.lines) / 2 + 3
    boxes += passed
    left, right = (arrow.source, arrow.target) if ends[0] < ends[1] else (arrow.target, arrow.source)
    return [left, *range(len(boxes) - len(passed), len(boxes)), right]


def _place(boxes: Sequence[_Box], ways: Sequence[Sequence[int]], *, top: float) -> None:
    """Give every box its middle."""
    import igraph

    graph = igraph.Graph(n=len(boxes), edges=[pair for way in ways for pair in pairwise(way)], directed=True)
    rows = [row for row, _ in graph.layout_sugiyama(layers=[box.column for box in boxes]).coords[: len(boxes)]]
    columns: list[list[int]] = [[] for _ in range(1 + max(box.column for box in boxes))]
    for number in sorted(range(len(boxes)), key=lambda number: (rows[number], number)):
        columns[boxes[number].column].append(number)
    scale = 1.0
    for column in columns:
        for upper, lower in pairwise(column):
            apart = boxes[upper].below + boxes[lower].above + 6
            scale = max(scale, apart / max(rows[lower] - rows[upper], 1e-6))
    gap = max(GAP, scale * max(rows) / 16)
    x = MARGIN + GAP
    for column in columns:
        width = max(boxes[number].width for number in column)
        for number in column:
            boxes[number].x, boxes[number].y = x + width / 2, rows[number] * scale
        for number in column:
            boxes[number].width = width
        x += width + gap
    first = min(box.y - box.above for box in boxes)
    for box in boxes:
        box.y += top - first


def _bend(arrow: Arrow, boxes: Sequence[_Box], way: Sequence[int]) -> str:
    """The line of an arrow."""
    left, right = boxes[way[0]], boxes[way[-1]]
    points = [_port(left, boxes[way[1]], 1)]
    for number in way[1:-1]:
        box = boxes[number]
        points += [_Point(box.x + side * box.width / 2, box.y, (1.0, 0.0)) for side in (-1, 1)]
    points.append(_port(right, boxes[way[-2]], -1))
    side = 1 if way[0] == arrow.source else -1
    path = _curve(points[::side], side)
    return f'<path class="arrow" d="{path}"/>'


def _port(state: _Box, near: _Box, side: int) -> _Point:
    """Where an arrow between a state and the box `near` to its right (1) or left (-1) meets the state's ring."""
    across = side * (near.x - state.x) - near.width / 2
    angle = max(-1.1, min(1.1, math.atan2(near.y - state.y, across)))
    out = side * math.cos(angle), math.sin(angle)
    return _Point(state.x + RADIUS * out[0], state.y + RADIUS * out[1], (side * out[0], side * out[1]))


def _curve(points: Sequence[_Point], side: int) -> str:
    """A path through the points: bends between columns, straight lines through them."""
    path = [f"M {points[0].x:.1f} {points[0].y:.1f}"]
    for index, (one, two) in enumerate(pairwise(points)):
        if index % 2:
            path.append(f"L {two.x:.1f} {two.y:.1f}")
            continue
        reach = side * 0.45 * max(abs(two.x - one.x), GAP)
        path.append(
            f"C {one.x + reach * one.to[0]:.1f} {one.y + reach * one.to[1]:.1f}"
            f" {two.x - reach * two.to[0]:.1f} {two.y - reach * two.to[1]:.1f} {two.x:.1f} {two.y:.1f}"
        )
    return " ".join(path)


def _start(box: _Box) -> str:
    end = box.x - RADIUS
    return f'<path class="arrow" d="M {end - 28:.1f} {box.y:.1f} L {end:.1f} {box.y:.1f}"/>'


def _circle(diagram: Diagram, state: int, box: _Box) -> str:
    """A state with its loop, its number and what it says of itself."""
    word = _word(diagram, state)
    kind = {"satisfied": ' class="accepting"', "lost": ' class="rejecting"'}.get(word, "")
    place = f'cx="{box.x:.1f}" cy="{box.y:.1f}"'
    parts = [f'<circle{kind} {place} r="{RADIUS:g}"/>']
    if word == "satisfied":
        parts.append(f'<circle{kind} {place} r="{RADIUS - 4:g}"/>')
    parts.append(_line(str(state), box.x, box.y + 4, "name middle"))
    if word:
        parts += _on_white([word], box.x, box.y + RADIUS + 4)
    if box.lines:
        x, y, high = box.x, box.y - RADIUS, box.y - RADIUS - LOOP - 4
        parts.append(
            f'<path class="arrow" d="M {x - 9:.1f} {y + 2:.1f} C {x - 20:.1f} {high:.1f}'
            f' {x + 20:.1f} {high:.1f} {x + 9:.1f} {y + 2:.1f}"/>'
        )
        parts.append(_label(box, y - LOOP + 2 - LINE * len(box.lines)))
    return "\n".join([f'<g class="state" data-state="{state}">', *parts, "</g>"])


def _label(box: _Box, top: float) -> str:
    """The lines of a box, and all of its text as a tooltip."""
    return "\n".join([f"<g><title>{_text(box.tooltip)}</title>", *_on_white(box.lines, box.x, top), "</g>"])


def _on_white(lines: Sequence[str], x: float, top: float) -> list[str]:
    """Lines of text that hide what runs behind them."""
    width, height = max(map(_length, lines)), LINE * len(lines)
    ground = f'<rect x="{x - width / 2 - 3:.1f}" y="{top:.1f}" width="{width + 6:.1f}" height="{height:.1f}"/>'
    return [ground, *(_line(line, x, top + LINE * row + 11, "middle") for row, line in enumerate(lines))]


def _line(text: str, x: float, y: float, kind: str) -> str:
    return f'<text class="{kind}" x="{x:.1f}" y="{y:.1f}">{_text(text)}</text>'


def _wrapped(labels: Sequence[str]) -> list[str]:
    """Labels, a comma between two, broken into lines after `&` and `|` where one is too long."""
    lines: list[str] = []
    for number, label in enumerate(labels, start=1):
        line = ""
        for part in re.split(r"(?<= [&|]) ", label):
            if line and len(line) + len(part) >= LONGEST:
                lines.append(line)
                line = part
            else:
                line = f"{line} {part}" if line else part
        lines.append(line + "," if number < len(labels) else line)
    shown = lines if len(lines) <= MOST_LINES else [*lines[: MOST_LINES - 1], "…"]
    return [line if len(line) <= 2 * LONGEST else line[: 2 * LONGEST - 1] + "…" for line in shown]


def _length(text: str) -> float:
    wide = sum(unicodedata.east_asian_width(character) in "WF" for character in text)
    return CHARACTER * (len(text) + wide)


def _text(text: str) -> str:
    return escape(_NOT_XML.sub("\ufffd", text))
