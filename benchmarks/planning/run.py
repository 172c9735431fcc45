"""What one run of a route finds, and the routes by name."""

from __future__ import annotations

import time
from collections.abc import Callable, Iterator, Mapping
from contextlib import contextmanager
from dataclasses import dataclass, field
from typing import Any

from benchmarks.planning.cases import Case

Bounds = tuple[float, float]


@dataclass(slots=True)
class Run:
    """Seconds by part, the values found (bounds, or the same number twice) and whatever else is worth keeping."""

    seconds: dict[str, float] = field(default_factory=dict)
    values: dict[str, Bounds] = field(default_factory=dict)
    notes: dict[str, Any] = field(default_factory=dict)

    @contextmanager
    def timed(self, part: str) -> Iterator[None]:
        """Time what is done in the context."""
        began = time.perf_counter()
        yield
        self.seconds[part] = time.perf_counter() - began

    def value(self, name: str, number: float) -> None:
        """Keep a value that is known without bounds."""
        self.values[name] = (number, number)


@dataclass(frozen=True, slots=True)
class Limits:
    """What a run may take, as far as the route can be told: our planner refuses, others are stopped from outside."""

    bytes: int


Prepare = Callable[[Case, Limits], Callable[[], Run]]
"""Makes what there is beforehand of a case; the result may be run often."""


def prepares() -> Mapping[str, Callable[[], Prepare]]:
    """What imports and gives each route: a process imports no other solver than the one that it measures."""
    return {
        "ours": lambda: _ours(relevance=False, device="cpu"),
        "ours-relevant": lambda: _ours(relevance=True, device="cpu"),
        "ours-gpu": lambda: _ours(relevance=False, device="cuda"),
        "storm-ltl": lambda: _storm("ltl"),
        "storm-steps": lambda: _storm("least_steps"),
        "storm-reach": lambda: _storm("reachability"),
        "mdpsolver": lambda: _generic("mdpsolver_run"),
        "pymdptoolbox": lambda: _generic("pymdptoolbox_run"),
    }


def _ours(**settings: Any) -> Prepare:
    from benchmarks.planning.ours import prepare

    return lambda case, limits: prepare(case, limits, **settings)


def _storm(name: str) -> Prepare:
    from benchmarks.planning import storm

    found: Prepare = getattr(storm, name)
    return found


def _generic(name: str) -> Prepare:
    from benchmarks.planning import generic

    found: Prepare = getattr(generic, name)
    return found
