"""Where in a text something is: line, column, and the line with a caret under it."""

from __future__ import annotations

from dataclasses import dataclass

CARET_WIDTH = 78
"""Longest line shown over a caret; of a longer one a window around the column."""
_ECHO = 24  # longest piece of the text repeated in a sentence


@dataclass(frozen=True, slots=True)
class Position:
    """1-based line and column, in characters (a tab is one), and the line or a window of it over a `^`."""

    line: int
    column: int
    caret: str


def locate(text: str, offset: int) -> Position:
    """The position of a 0-based offset into the text; the text's length is the position after its end."""
    start = text.rfind("\n", 0, offset) + 1
    return Position(text.count("\n", 0, offset) + 1, offset - start + 1, _caret(text, start, offset))


def quoted(piece: str) -> str:
    """A piece of the caller's text for use in a sentence: short, on one line, in back quotes."""
    shown = piece if len(piece) <= _ECHO else piece[: _ECHO - 3] + "..."
    return "`" + "".join(c if c.isprintable() else f"U+{ord(c):04X}" for c in shown) + "`"


def _caret(text: str, start: int, offset: int) -> str:
    """The line from `start` and a caret under `offset`, tabs shown as one space so that the two stay in step."""
    end = text.find("\n", offset)
    end = len(text) if end < 0 else end
    left = max(start, min(offset - CARET_WIDTH // 2, end - CARET_WIDTH))
    right = min(end, left + CARET_WIDTH)
    before, after = "..." if left > start else "", "..." if right < end else ""
    window = "".join(c if c.isprintable() else " " for c in text[left:right])
    return f"{before}{window}{after}".rstrip() + "\n" + " " * (len(before) + offset - left) + "^"
