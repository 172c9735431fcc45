"""What the logic refuses.

CqltlError
├── FormulaSyntaxError      the text is not a formula: line, column, caret
├── FormulaTooLargeError    text, depth, size, atoms or automaton beyond a limit
├── InvalidNameError        a name that is empty or holds control characters
└── SpotMissingError        Spot is not installed on this machine
"""

from __future__ import annotations

from models.errors import CqltlError, Place


class FormulaSyntaxError(CqltlError):
    """The text is not a formula.

    `line` and `column` are 1-based and count characters (a tab is one); `caret` is the offending line, or a window of
    a long one, with a `^` under the column.
    """

    slug = "formula-syntax"

    def __init__(self, detail: str, *, line: int, column: int, caret: str) -> None:
        super().__init__(detail, places=(Place("", detail),))
        self.line = line
        self.column = column
        self.caret = caret


class FormulaTooLargeError(CqltlError):
    """The formula or its automaton is beyond a limit."""

    slug = "formula-too-large"


class InvalidNameError(CqltlError):
    """A name of a function or of a term is empty or cannot be printed. `parse` reports it as FormulaSyntaxError."""

    slug = "invalid-name"


class SpotMissingError(CqltlError):
    """Spot is needed for automata and equivalence and is not importable."""

    slug = "spot-missing"
