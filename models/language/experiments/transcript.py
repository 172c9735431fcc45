"""What the paper's networks said of S and U at one point of their training, kept so that it can be measured again."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import lru_cache
from typing import Any, Self

from models.logic import Formula, parse, to_text
from models.queries import ContextualQuery


@dataclass(frozen=True, slots=True)
class Transcript:
    """Answers to the texts of S and then U of one domain, in the order of `paper_sets`.

    Attributes:
        queries: of CQ-CopyNet.
        tagged: of CQ-CopyNet+POS.
        formulas: of LTL-CopyNet.
    """

    queries: tuple[ContextualQuery | None, ...]
    tagged: tuple[ContextualQuery | None, ...]
    formulas: tuple[Formula | None, ...]

    def as_json(self) -> dict[str, Any]:
        """The transcript as plain data, each different answer once."""
        return {
            "queries": _packed([_query_data(query) for query in self.queries]),
            "tagged": _packed([_query_data(query) for query in self.tagged]),
            "formulas": _packed([None if formula is None else to_text(formula) for formula in self.formulas]),
        }

    @classmethod
    def from_json(cls, data: dict[str, Any]) -> Self:
        """What `as_json` gave; raises KeyError or TypeError for anything else."""
        return cls(
            tuple(_query(entry) for entry in _unpacked(data["queries"])),
            tuple(_query(entry) for entry in _unpacked(data["tagged"])),
            tuple(None if entry is None else _parse(entry) for entry in _unpacked(data["formulas"])),
        )


def _query_data(query: ContextualQuery | None) -> str | None:
    return None if query is None else "\t".join((query.task, *query.arguments))


@lru_cache(maxsize=65_536)
def _query(entry: str | None) -> ContextualQuery | None:
    if entry is None:
        return None
    task, *arguments = entry.split("\t")
    return ContextualQuery(task, tuple(arguments))


_parse = lru_cache(maxsize=65_536)(parse)


def _packed(entries: Sequence[str | None]) -> dict[str, Any]:
    different = {entry: number for number, entry in enumerate(dict.fromkeys(entries))}
    return {"different": list(different), "which": [different[entry] for entry in entries]}


def _unpacked(data: dict[str, Any]) -> list[str | None]:
    different = data["different"]
    return [different[number] for number in data["which"]]
