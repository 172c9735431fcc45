"""Made-up commands in the files of the published ones, for runs of `models.language.human` that measure nothing."""

from __future__ import annotations

from itertools import permutations
from pathlib import Path

COLOURS = ("red", "blue", "green", "yellow")
ORDERS = ("go to {}", "please move to {}", "walk over to {} now")


def write_published(folder: Path) -> None:
    """All files that it reads: four sets of commands."""
    for name, one, two in (
        ("drone", "finally ( the {0} room )", "finally ( and ( the {0} room , finally ( the {1} room ) ) )"),
        (
            "cleanup",
            "finally go to the {0} room",
            "finally ( and ( go to the {0} room , finally go to the {1} room ) )",
        ),
        ("pick", "finally ( any {0} cubes )", "finally ( and ( any {0} cubes , finally ( any {1} cubes ) ) )"),
    ):
        thing = "any {} cubes" if name == "pick" else "the {} room"
        said = [(order.format(thing.format(a)), one.format(a)) for order in ORDERS for a in COLOURS]
        said += [
            (f"{order.format(thing.format(a))} and then {thing.format(b)}", two.format(a, b))
            for order in ORDERS
            for a, b in permutations(COLOURS, 2)
        ]
        rows = [f"{number % 5}\t{text}\t{formula}" for number, (text, formula) in enumerate(said)]
        _write(folder / f"{name}.tsv", "fold\ttext\tcanonical", rows)
        _write(folder / f"{name}-few.tsv", "text\tcanonical", [row.partition("\t")[2] for row in rows[:30]])
    _write(folder / "lang2ltl-lifted.csv", "pattern_type,props,utterance,ltl_formula", _utterances())


def _utterances() -> list[str]:
    rows = []
    for formula, letters in (("F a", "a"), ("& F a F b", "ab"), ("& F a & F b F c", "abc")):
        named, props = " and ".join(letters), str(list(letters))
        rows += [
            f'visit,"{props}",go to {named} {word},{formula}' for word in ("now", "soon", "today", "first", "next")
        ]
        rows += [f'never,"{props}",avoid {named} {word},G ! {formula}' for word in ("ever", "now", "at all", "please")]
    return rows


def _write(file: Path, head: str, rows: list[str]) -> None:
    file.write_text("\n".join([head, *rows]) + "\n", encoding="utf-8")
