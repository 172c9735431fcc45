"""Data of toys and navigation environments of any size, for tests, benchmarks and callers who want one
quickly.
"""

from __future__ import annotations

import random
from collections.abc import Mapping, Sequence
from itertools import islice, product
from typing import Any

_ROOMS = ("kitchen", "bedroom", "bathroom", "living_room", "hallway", "office", "garage", "attic")
_CHARACTERS = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789"
_COLORS = ("red", "green", "blue", "yellow", "purple", "orange", "white", "black")
_SHAPES = ("cylinder", "sphere", "cube", "cone")


def toys_spec(
    *,
    columns: int = 4,
    rows: int = 1,
    toys: int | Sequence[tuple[str, str]] = 1,
    slip: float = 0.0,
    name: str = "toys",
    walls: Sequence[tuple[str, str]] = (),
    state: Mapping[str, Mapping[str, str]] | None = None,
    seed: int | None = None,
) -> dict[str, Any]:
    """A toys environment on a grid of named rooms: one box called `box`, and toys (or so many) by shape and
    color.

    A toy is named after its shape, or color and shape when the shape occurs twice. The robot starts in the
    first cell, the box in the second, toy i in the last but i; with a seed everything starts in a random
    cell; `state` overrides either.
    """
    names = _cell_names(columns * rows)
    kinds = _default_toys(toys) if isinstance(toys, int) else list(toys)
    objects = _toy_objects(kinds)
    start = _scattered(names, objects, seed) if seed is not None else _lined_up(names, objects)
    for owner, attributes in (state or {}).items():
        start[owner] = {**start.get(owner, {}), **attributes}
    return {
        "name": name,
        "kind": "oomdp",
        "domain": "toys",
        "parameters": {"slip": slip},
        "values": _extra_values(kinds),
        "grid": _grid("cell", columns, rows, dict(zip(_CHARACTERS, names, strict=False)), walls),
        "objects": {"box": {"class": "box"}, **objects},
        "state": start,
    }


def navigation_spec(
    *,
    columns: int = 4,
    rows: int = 4,
    landmarks: Mapping[str, tuple[int, int]] | None = None,
    slip: float = 0.0,
    name: str = "navigation",
    walls: Sequence[tuple[str, str]] = (),
    blocked: Sequence[tuple[int, int]] = (),
    start: str | None = None,
) -> dict[str, Any]:
    """A navigation environment: landmarks by column and row from 1 at the north-west (default: two opposite
    corners).

    Other cells are called `place_{column}_{row}`. The robot starts in the first landmark, or in `start`.
    """
    places = dict(landmarks) if landmarks is not None else {"home": (1, 1), "goal": (columns, rows)}
    marks = {place: mark for mark, place in zip(_CHARACTERS, places.values(), strict=False)}
    lines = [
        "".join("#" if (x, y) in blocked else marks.get((x, y), ".") for x in range(1, columns + 1))
        for y in range(1, rows + 1)
    ]
    return {
        "name": name,
        "kind": "oomdp",
        "domain": "navigation",
        "parameters": {"slip": slip},
        "grid": {
            "class": "place",
            "map": lines,
            "names": {marks[place]: landmark for landmark, place in places.items()},
            "walls": [list(wall) for wall in walls],
        },
        "state": {"robot": {"at": start if start is not None else next(iter(places))}},
    }


def _cell_names(count: int) -> list[str]:
    return [_ROOMS[i] if i < len(_ROOMS) else f"room_{i + 1}" for i in range(min(count, len(_CHARACTERS)))]


def _grid(
    kind: str, columns: int, rows: int, names: Mapping[str, str], walls: Sequence[tuple[str, str]]
) -> dict[str, Any]:
    marks = [*names, *["."] * (columns * rows - len(names))]
    lines = ["".join(marks[row * columns : (row + 1) * columns]) for row in range(rows)]
    return {"class": kind, "map": lines, "names": dict(names), "walls": [list(wall) for wall in walls]}


def _default_toys(count: int) -> list[tuple[str, str]]:
    mixed = [(shape, _COLORS[(i + j) % len(_COLORS)]) for j, (i, shape) in product(range(8), enumerate(_SHAPES))]
    return list(islice(mixed, count))


def _toy_objects(kinds: Sequence[tuple[str, str]]) -> dict[str, dict[str, Any]]:
    shapes = [shape for shape, _ in kinds]
    objects: dict[str, dict[str, Any]] = {}
    for shape, color in kinds:
        name = shape if shapes.count(shape) == 1 else f"{color}_{shape}"
        unique = name if name not in objects else f"{name}_{len(objects) + 1}"
        objects[unique] = {"class": "toy", "attributes": {"shape": shape, "color": color}}
    return objects


def _extra_values(kinds: Sequence[tuple[str, str]]) -> dict[str, list[str]]:
    return {
        "shape": sorted({shape for shape, _ in kinds} - set(_SHAPES)),
        "color": sorted({color for _, color in kinds} - set(_COLORS)),
    }


def _lined_up(cells: Sequence[str], objects: Mapping[str, object]) -> dict[str, dict[str, str]]:
    start = {"robot": {"at": cells[0]}, "box": {"in": cells[1 % len(cells)]}}
    return start | {toy: {"in": cells[-1 - i % len(cells)]} for i, toy in enumerate(objects)}


def _scattered(cells: Sequence[str], objects: Mapping[str, object], seed: int) -> dict[str, dict[str, str]]:
    chance = random.Random(seed)
    start = {"robot": {"at": chance.choice(cells)}, "box": {"in": chance.choice(cells)}}
    return start | {toy: {"in": chance.choice(cells)} for toy in objects}
