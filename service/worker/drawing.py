"""The automaton of a policy, for people to look at."""

from __future__ import annotations

import re
from dataclasses import dataclass
from typing import Any, Literal

from models.logic.drawing import Arrow, Diagram, draw
from models.logic.spot import library

DrawnFormat = Literal["dot", "svg"]

_QUOTED = re.compile(r'"((?:[^"\\]|\\.)*)"')
"""How Spot writes a proposition whose name is not a plain word."""


@dataclass(frozen=True, slots=True)
class DrawingJob:
    """Draw an automaton in the HOA format, of `formula`, whose states `accepting` and `rejecting` decide it."""

    hoa: str
    formula: str
    accepting: frozenset[int]
    rejecting: frozenset[int]
    format: DrawnFormat


def run_drawing(job: DrawingJob) -> str:
    """The automaton in DOT, by Spot, or as SVG. Raises SpotMissingError."""
    graph = library().automaton(job.hoa)
    return _dot(job, graph) if job.format == "dot" else draw(_diagram(job, graph))


def _dot(job: DrawingJob, graph: Any) -> str:
    words = {**dict.fromkeys(job.accepting, " satisfied"), **dict.fromkeys(job.rejecting, " lost")}
    graph.set_state_names([f"{state}{words.get(state, '')}" for state in range(graph.num_states())])
    return str(graph.to_str("dot"))


def _diagram(job: DrawingJob, graph: Any) -> Diagram:
    """States that decide the formula are left by no arrow; they stay for ever."""
    arrows: dict[tuple[int, int], list[str]] = {}
    marked = False
    for edge in graph.edges():
        if edge.src in job.accepting or edge.src in job.rejecting:
            continue
        marks = ",".join(map(str, edge.acc.sets()))
        marked = marked or bool(marks)
        letters = _letters(graph, edge.cond)
        arrows.setdefault((edge.src, edge.dst), []).append(f"{letters} {{{marks}}}" if marks else letters)
    return Diagram(
        states=graph.num_states(),
        initial=graph.get_init_state_number(),
        accepting=job.accepting,
        rejecting=job.rejecting,
        arrows=[Arrow(source, target, tuple(labels)) for (source, target), labels in arrows.items()],
        title=job.formula,
        notes=[f"acceptance: {graph.get_acceptance()}"] if marked else [],
    )


def _letters(graph: Any, condition: Any) -> str:
    """The letters of a transition, as a formula over the atoms as they are written elsewhere."""
    text = str(library().bdd_format_formula(graph.get_dict(), condition))
    return "true" if text == "1" else _QUOTED.sub(lambda quoted: re.sub(r"\\(.)", r"\1", quoted[1]), text)
