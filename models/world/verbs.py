"""Where "not", "never" and "always" stand in the reading of a propositional function."""

from __future__ import annotations

import re

_HOLDS = " holds"
_BETWEEN = re.compile(r" (?:is|are|can) ")  # the verbs after which "not", "never" and "always" stand


def denial(says: str) -> str:
    """The negation of a reading: `x is at c` -> `x is not at c`."""
    if says.endswith(_HOLDS):
        return f"{says.removesuffix(_HOLDS)} does not hold"
    verb = _BETWEEN.search(says)
    if verb is None:
        return f"it is not so that {says}"
    return _after(says, verb, "cannot" if verb[0] == " can " else f"{verb[0].strip()} not")


def with_adverbs(says: str) -> tuple[str, str] | None:
    """A reading with "always" and with "never", where it has a verb that shows their place."""
    if says.endswith(_HOLDS):
        said = says.removesuffix(_HOLDS)
        return f"{said} always holds", f"{said} never holds"
    verb = _BETWEEN.search(says)
    if verb is None:
        return None
    word = verb[0].strip()
    return _after(says, verb, f"{word} always"), _after(says, verb, f"{word} never")


def _after(says: str, verb: re.Match[str], instead: str) -> str:
    return f"{says[: verb.start()]} {instead} {says[verb.end() :]}"
