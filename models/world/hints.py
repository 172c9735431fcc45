"""What the writer of an unreadable expression probably meant: operators of other languages."""

from __future__ import annotations

import re

_INSTEAD = {
    "=": "==", "===": "==", "<->": "==", "<=>": "==", "=<": "<=", "≤": "<=", "≥": ">=", "<>": "!=", "≠": "!=",
    "->": "implies", "=>": "implies", "-->": "implies", "==>": "implies", "→": "implies",
    "&&": "and", "&": "and", "∧": "and", "||": "or", "|": "or", "∨": "or", "!": "not", "~": "not", "¬": "not",
    "'": "names in double quotes",
}  # fmt: skip
_OPERATORS = frozenset({"==", "!=", "<=", ">=", "<", ">", "-"})
_KEYWORDS = frozenset({"and", "or", "not", "implies", "is", "if", "else"})
_RUN = re.compile(r"[-<>=!&|~]+|[^\w\s]")
_WORD = re.compile(r"[A-Za-z]+")
_WORD_BEFORE = re.compile(r"([A-Za-z]+)\s*\Z")


def syntax_hint(text: str, start: int) -> str:
    """` (write == to compare)`, where reading `text` stopped at `start`, or nothing."""
    run = next((found[0] for found in _RUN.finditer(text) if found.start() <= start < found.end()), None)
    if run is not None:
        instead = None if run in _OPERATORS else _INSTEAD.get(run) or _INSTEAD.get(text[start])
        return "" if instead is None else f" (write {instead}{' to compare' if instead.endswith('=') else ''})"
    for word in (_WORD.match(text, start), _WORD_BEFORE.search(text[:start])):
        if word and word[0].strip().lower() in _KEYWORDS and not word[0].strip().islower():
            return f" (write {word[0].strip().lower()})"
    return ""
