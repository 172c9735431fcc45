"""Storm's sparse engine with sound numerics and its default precision, 1e-6 relative, with schedulers.

What there is beforehand is the parsed PRISM program and property, or the model itself where it is given explicitly.
"""

from __future__ import annotations

import tempfile
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import stormpy
from stormpy.datastructures import BitVector, SparseMatrixBuilder
from stormpy.environments import MinMaxMethod
from stormpy.models import SparseMdp, SparseModelComponents, StateLabeling

from benchmarks.planning.cases import Case, Random, Toys
from benchmarks.planning.random_mdp import RandomMdp, random_mdp
from benchmarks.planning.run import Limits, Run
from benchmarks.planning.toys import prism_text

METHODS = {"topological": MinMaxMethod.TOPOLOGICAL, "optimistic": MinMaxMethod.OPTIMISTIC_VALUE_ITERATION}
"""Storm's own choice, and the one that it comes to for the components, for the whole system at once; on our worlds
interval and sound value iteration took longer, and policy iteration did not end within minutes."""
ROWS = 100_000


def ltl(case: Case, _limits: Limits) -> Callable[[], Run]:
    """Build the model, then check the formula; Storm makes the automaton and the product."""
    assert isinstance(case, Toys)
    text = prism_text(case)
    program, query = _parsed(text.model, text.ltl)

    def run() -> Run:
        found = Run()
        with found.timed("build"):
            model = stormpy.build_model(program, [query])
        _check(found, model, query, "probability", "topological")
        return found

    return run


def least_steps(case: Case, _limits: Limits) -> Callable[[], Run]:
    """Build the model, which holds the automaton, then the least expected steps by the quicker of two methods."""
    assert isinstance(case, Toys)
    text = prism_text(case)
    program, query = _parsed(text.model, text.least_steps)

    def run() -> Run:
        found = Run()
        with found.timed("build"):
            model = stormpy.build_model(program, [query])
        _quicker(found, model, query, "steps")
        return found

    return run


def reachability(case: Case, _limits: Limits) -> Callable[[], Run]:
    """The probability of a label in a model that is there, by the quicker of two methods."""
    assert isinstance(case, Random)
    model = explicit_model(random_mdp(case.states))
    query = stormpy.parse_properties('Pmax=? [ F "goal" ]')[0]

    def run() -> Run:
        found = Run()
        _quicker(found, model, query, "probability")
        return found

    return run


def explicit_model(mdp: RandomMdp) -> Any:
    """The MDP as Storm's; given to it in pieces, since its builder takes Python numbers."""
    states, choices = len(mdp.first_choice) - 1, len(mdp.action)
    row = np.repeat(np.arange(choices), np.diff(mdp.first_outcome))
    builder = SparseMatrixBuilder[float](choices, states, len(row), True, True, states)
    for begin in range(0, states, ROWS):
        groups = mdp.first_choice[begin : begin + ROWS]
        ends = mdp.first_choice[min(states, begin + ROWS)]
        part = slice(mdp.first_outcome[groups[0]], mdp.first_outcome[ends])
        builder.add_next_values(row[part], mdp.successor[part], mdp.probability[part], groups)
    labels = StateLabeling(states)
    for name, members in (("init", [0]), ("goal", mdp.goal.tolist())):
        labels.add_label(name)
        labels.set_states(name, BitVector(states, members))
    return SparseMdp[float](SparseModelComponents[float](builder.build(), labels))


def _parsed(model: str, query: str) -> tuple[Any, Any]:
    with tempfile.TemporaryDirectory() as folder:
        file = Path(folder) / "model.prism"
        file.write_text(model, encoding="utf-8")
        program = stormpy.parse_prism_program(str(file))
    return program, stormpy.parse_properties(query, program)[0]


def _quicker(found: Run, model: Any, query: Any, value: str) -> None:
    tried = {}
    for method in METHODS:
        _check(found, model, query, value, method)
        tried[method] = found.seconds["check"]
    found.seconds["check"] = min(tried.values())
    found.notes["check_s"] = tried


def _check(found: Run, model: Any, query: Any, value: str, method: str) -> None:
    environment = stormpy.environments.sound()
    environment.solver().min_max().method = METHODS[method]
    with found.timed("check"):
        result = stormpy.model_checking(
            model, query, only_initial_states=True, extract_scheduler=True, environment=environment
        )
        result.get_scheduler()
    found.value(value, result.get_value(model.initial_states[0]))
    found.notes |= {"states": model.nr_states, "choices": model.nr_choices, "transitions": model.nr_transitions}
