"""The names of the ways in which formulas are written."""

from __future__ import annotations

from enum import StrEnum


class Dialect(StrEnum):
    """A way of writing formulas.

    `infix` is `F (in(a, b) & !c)`, `spot` the same in the signs of Spot and SPIN (`<> (in(a, b) && !c)`), `unicode` in
    mathematical signs, `latex` LaTeX for math mode, `prefix` Polish notation (`F & in(a, b) ! c`).
    """

    INFIX = "infix"
    SPOT = "spot"
    PREFIX = "prefix"
    LATEX = "latex"
    UNICODE = "unicode"
