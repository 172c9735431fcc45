"""Our planner, from the formula to the policy and its likeliest run; the compiled world is there beforehand."""

from __future__ import annotations

import time
from collections.abc import Callable
from dataclasses import dataclass, field

import torch

from benchmarks.planning.cases import Case, Random
from benchmarks.planning.random_mdp import listed_world, random_mdp
from benchmarks.planning.run import Limits, Run
from benchmarks.planning.toys import resolved
from models.logic import Formula, parse
from models.planning import Options, plan
from models.planning.options import MOST_BYTES, Device, Stage
from models.world import World

MOST_STATES = 10**9


@dataclass(slots=True)
class Sweeps:
    """When the sweeps of the expected steps ended, and the seconds before the reports of each stage."""

    last: float = field(default_factory=time.perf_counter)
    ends: list[float] = field(default_factory=list)
    stages: dict[str, float] = field(default_factory=dict)

    def __call__(
        self, stage: Stage, _sweep: int, _lower: float, _upper: float, _states: int, _left: float = 0.0, /
    ) -> None:
        """See `models.planning.Progress`."""
        now = time.perf_counter()
        self.stages[stage] = self.stages.get(stage, 0.0) + now - self.last
        self.last = now
        if stage == "steps":
            self.ends.append(now)

    def seconds(self) -> float | None:
        """Of one sweep, on average; None unless there are two at least. The first has no beginning to count from."""
        return (self.ends[-1] - self.ends[0]) / (len(self.ends) - 1) if len(self.ends) > 1 else None


def prepare(case: Case, limits: Limits, *, relevance: bool, device: Device) -> Callable[[], Run]:
    """The world and the formula's text; the automaton is made in the run."""
    world, formula = _problem(case)
    options = Options(
        relevance=relevance, device=device, max_states=MOST_STATES, max_bytes=min(limits.bytes, MOST_BYTES)
    )

    def run() -> Run:
        found, sweeps = Run(), Sweeps()
        with found.timed("plan"):
            answer = plan(world, formula, options=options, progress=sweeps)
        if answer.expected_steps is not None and answer.expected_steps_upper is not None:
            found.values["steps"] = (answer.expected_steps, answer.expected_steps_upper)
        found.values["probability"] = (answer.lower, answer.upper)
        found.notes = {
            "product_states": answer.sizes.product_states,
            "automaton_states": answer.sizes.automaton_states,
            "sweeps": len(sweeps.ends),
            "sweep_s": sweeps.seconds(),
            "stages_s": sweeps.stages,
        }
        if device == "cuda":
            found.notes["gpu_bytes"] = torch.cuda.max_memory_allocated()
        return found

    return run


def _problem(case: Case) -> tuple[World, Formula]:
    if isinstance(case, Random):
        return listed_world(random_mdp(case.states)), parse("F goal")
    environment, formula = resolved(case)
    return environment.world, formula
