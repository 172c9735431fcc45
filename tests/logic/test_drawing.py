"""Pictures of automata: what is in them, and that nothing lies on top of anything else."""

from __future__ import annotations

from itertools import combinations
from xml.etree import ElementTree

import pytest

from models.logic.drawing import MAX_STATES, Arrow, Diagram, draw

SVG = "{http://www.w3.org/2000/svg}"
LABEL = "!at(robot, kitchen) & holding(sphere) | at(box, bedroom) & !holding(sphere)"


def diagram(states: int, *pairs: tuple[int, int], label: str = "a & !b") -> Diagram:
    return Diagram(
        states=states,
        initial=0,
        accepting={states - 1},
        rejecting={states - 2} if states > 2 else set(),
        arrows=[Arrow(source, target, (label,)) for source, target in pairs],
        title="F a",
    )


CHAIN = [(state, state + 1) for state in range(MAX_STATES - 1)]
DENSE = [(source, target) for source in range(10) for target in range(10)]
EXAMPLES = {
    "one": diagram(1),
    "loop": diagram(1, (0, 0)),
    "two": diagram(2, (0, 0), (0, 1)),
    "there and back": diagram(3, (0, 1), (1, 0), (1, 2), (0, 2), label=LABEL),
    "chain": diagram(MAX_STATES, *CHAIN, *((later, 0) for later in range(1, MAX_STATES, 3))),
    "star": diagram(MAX_STATES, *((0, target) for target in range(1, MAX_STATES)), label=LABEL),
    "dense": diagram(10, *DENSE),
}


@pytest.mark.parametrize("name", EXAMPLES)
def test_every_state_and_arrow_is_there(name: str) -> None:
    drawn = EXAMPLES[name]
    root = ElementTree.fromstring(draw(drawn))
    words = [text.text for text in root.iter(f"{SVG}text")]
    assert {str(state) for state in range(drawn.states)} <= set(words)
    heads = [path for path in root.iter(f"{SVG}path") if path.get("class") == "arrow"]
    assert len(heads) == len(drawn.arrows) + 1, "one says where to begin"
    rings = [circle.get("class") for circle in root.iter(f"{SVG}circle")]
    assert rings.count("accepting") == 2 * len(drawn.accepting)
    assert rings.count("rejecting") == len(drawn.rejecting)
    assert words.count("satisfied") == len(drawn.accepting)
    assert words.count("lost") == len(drawn.rejecting)


@pytest.mark.parametrize("name", EXAMPLES)
def test_nothing_lies_on_anything_else_or_outside(name: str) -> None:
    root = ElementTree.fromstring(draw(EXAMPLES[name]))
    _, *grounds = root.iter(f"{SVG}rect")  # the first is the page
    boxes = [tuple(float(ground.get(side, 0)) for side in ("x", "y", "width", "height")) for ground in grounds]
    for circle in root.iter(f"{SVG}circle"):
        x, y, radius = (float(circle.get(part, 0)) for part in ("cx", "cy", "r"))
        if radius == 20:
            boxes.append((x - radius, y - radius, 2 * radius, 2 * radius))
    for (x, y, width, height), (u, v, wide, high) in combinations(boxes, 2):
        assert x + width <= u or u + wide <= x or y + height <= v or v + high <= y
    for x, y, width, height in boxes:
        assert min(x, y) >= 0
        assert x + width <= float(root.get("width", 0))
        assert y + height <= float(root.get("height", 0))


def test_the_initial_state_is_leftmost() -> None:
    root = ElementTree.fromstring(draw(diagram(3, (0, 2), (2, 1), (1, 0), (1, 2))))
    x = [float(text.get("x", 0)) for state in "012" for text in root.iter(f"{SVG}text") if text.text == state]
    assert x[0] < x[2] < x[1]


def test_long_labels_are_broken_and_whole_in_the_tooltip() -> None:
    many = " | ".join(f"in(thing {number}, box)" for number in range(30))
    root = ElementTree.fromstring(draw(diagram(2, (0, 1), label=many)))
    assert many in [title.text for title in root.iter(f"{SVG}title")]
    assert "…" in [text.text for text in root.iter(f"{SVG}text")]


def test_any_text_is_text() -> None:
    odd = '<script>&"\x00\ud800'
    svg = draw(diagram(2, (0, 1), label=odd))
    assert "<script>" not in svg
    assert '<script>&"\ufffd\ufffd' in [text.text for text in ElementTree.fromstring(svg).iter(f"{SVG}text")]


def test_the_same_picture_each_time() -> None:
    assert draw(EXAMPLES["dense"]) == draw(EXAMPLES["dense"])
