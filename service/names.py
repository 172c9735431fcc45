"""Names that somebody may have meant who gave one that is not there."""

from __future__ import annotations

from collections.abc import Iterable
from difflib import get_close_matches

MOST_COMPARED = 1_000
"""Names that a wrong one is compared with, at most."""
_LONGEST = 100
"""Characters of a name beyond which none is compared."""


def or_rather(name: str, known: Iterable[str]) -> str:
    """The end of a sentence on a name that is not known: `; did you mean "toys"?`, or nothing where none is like it."""
    by_folded = {other.lower(): other for other in known}
    near = get_close_matches(name.lower(), by_folded, n=3) if len(name) <= _LONGEST else []
    said = " or ".join(f'"{by_folded[folded]}"' for folded in near)
    return f"; did you mean {said}?" if near else ""
