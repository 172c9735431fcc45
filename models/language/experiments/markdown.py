"""Markdown: tables, numbers, and the places of a page that are written by a command."""

from __future__ import annotations

import re
from collections.abc import Iterable, Mapping, Sequence

Row = Sequence[str]


def table(head: Row, rows: Iterable[Row]) -> str:
    """A table; the first column is text, the others are numbers unless their head ends with a space."""
    rule = ["---", *("---" if name.endswith(" ") else "---:" for name in head[1:])]
    return "\n".join(_line(row) for row in (head, rule, *rows))


def percent(rate: float) -> str:
    """A rate in percent, as exact as results are kept."""
    return f"{100 * rate:.2f}".removesuffix("0").removesuffix(".0")


def spread(values: Mapping[str, float]) -> str:
    """Mean, standard deviation and range of a rate over seeds, in percent; one number when all are the same."""
    mean = percent(values["mean"])
    if values["low"] == values["high"]:
        return mean
    return f"{mean} ± {percent(values['deviation'])} ({percent(values['low'])} to {percent(values['high'])})"


def number(value: float) -> str:
    """A count, or a mean of counts to one decimal place."""
    return f"{value:.1f}".removesuffix(".0")


def count(values: Sequence[int]) -> str:
    """A number that each seed has: once when it is the same, else all of them."""
    return str(values[0]) if len(set(values)) == 1 else ", ".join(map(str, values))


def filled(page: str, tables: Mapping[str, str]) -> str:
    """The page with each table between its markers, `<!-- table NAME -->` and `<!-- end -->`.

    Raises ValueError when the page has a marker without a table, or lacks one of the tables.
    """
    found: set[str] = set()

    def replace(match: re.Match[str]) -> str:
        name = match["name"]
        if name not in tables:
            raise ValueError(f"there is no table {name}")
        found.add(name)
        return f"<!-- table {name} -->\n\n{tables[name]}\n\n<!-- end -->"

    text = re.sub(r"<!-- table (?P<name>[\w-]+) -->.*?<!-- end -->", replace, page, flags=re.DOTALL)
    if missing := sorted(set(tables) - found):
        raise ValueError(f"the page has no place for the table {missing[0]}")
    return text


def _line(cells: Row) -> str:
    return "| " + " | ".join(cell.strip().replace("|", "\\|") for cell in cells) + " |"
