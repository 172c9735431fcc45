"""The code blocks of README.md and docs/*.md, and what their first line says they are.

A block is fenced, and what stands after the fence says what is done with it:

    sh                      run by bash, in the order of the page
    yaml [FILE]             an environment; with a name, saved for what follows
    python [FILE]           run; with a name, saved instead
    prism FILE              saved
    json METHOD /path       the body of a request, sent
    json Schema             such a value, of service.http.schemas
    json                    part of what the block before it answered
    text                    all that the block before it printed; else a drawing
    ltl, query              a formula, a contextual query: one a line
"""

from __future__ import annotations

import re
from dataclasses import dataclass
from pathlib import Path

ROOT = Path(__file__).parents[2]
PAGES = ("README.md", *sorted(f"docs/{path.name}" for path in (ROOT / "docs").glob("*.md")))
FENCE = re.compile(r"^```(.*)$")


@dataclass(frozen=True)
class Block:
    """A fenced block: where it stands, its language, what else its first line says, its text."""

    page: str
    line: int
    language: str
    info: str
    text: str
    follows: bool  # directly, with nothing but empty lines between, upon another one

    @property
    def place(self) -> str:
        return f"{self.page}:{self.line}"


def read(page: str) -> str:
    return (ROOT / page).read_text(encoding="utf-8")


def prose(page: str) -> str:
    """A page without its blocks."""
    return re.sub(r"^```.*?^```$", "", read(page), flags=re.DOTALL | re.MULTILINE)


def blocks(page: str) -> list[Block]:
    """All blocks of a page, in order."""
    found: list[Block] = []
    lines = read(page).splitlines()
    opened: tuple[int, str] | None = None
    follows = False
    for number, line in enumerate(lines, 1):
        fence = FENCE.match(line)
        if opened is not None:
            if fence:
                begin, said = opened
                language, _, info = said.partition(" ")
                text = "\n".join(lines[begin : number - 1])
                found.append(Block(page, begin, language, info.strip(), text, follows))
                opened, follows = None, True
        elif fence:
            opened = number, fence[1].strip()
        elif line.strip():
            follows = False
    assert opened is None, f"{page}:{opened} is never closed"
    return found


def indented(page: str) -> list[str]:
    """Blocks that are indented instead of fenced: nothing would run them."""
    found = []
    within, before = False, ""
    for number, line in enumerate(read(page).splitlines(), 1):
        if FENCE.match(line):
            within = not within
        listed = re.match(r"^\s*([-*]|\d+\.) ", before)
        if not within and line.startswith("    ") and not before.strip() and not listed:
            found.append(f"{page}:{number}")
        before = line
    return found
