"""Explicit environments."""

import numpy as np

from models.logic.formula import Atom
from models.world import Variable, compile_world, load_environment
from tests.world.worlds import TINY, changed


def test_tiny():
    environment = load_environment(TINY)
    world = compile_world(environment)
    assert (environment.name, environment.kind, environment.domain) == ("tiny", "explicit", None)
    assert world.variables == (Variable("mdp", "state", ("0", "1", "2")),)
    assert world.actions == ("go", "stay")
    assert world.decode(2) == {"mdp": {"state": "2"}}
    assert world.labels([Atom("a"), Atom("b")]).tolist() == [[False, True, False], [False, False, True]]
    assert world.labels([Atom("b")], np.array([2, 0])).tolist() == [[True, False]]
    go, stay = world.outcomes(0), world.outcomes(1)
    assert go.enabled.tolist() == [True, True, False]
    assert go.successor.tolist() == [[1, 2, 2], [0, 1, 2]]
    assert go.probability.tolist() == [[0.9, 1.0, 0.0], [0.1, 0.0, 0.0]]
    assert stay.enabled.tolist() == [False, False, True]


def test_repeated_successors_are_merged():
    data = changed(TINY, ("transitions/0/to", [[1, 0.25], [0, 0.5], [1, 0.25]]))
    go = compile_world(load_environment(data)).outcomes(0)
    assert go.probability[:, 0].tolist() == [0.5, 0.5]
    assert go.successor[:, 0].tolist() == [1, 0]


def test_impossible_outcomes_lead_nowhere():
    data = changed(TINY, ("transitions/0/to", [[2, 0.0], [1, 0.5], [2, 0.5]]))
    go = compile_world(load_environment(data)).outcomes(0)
    assert go.probability.tolist() == [[0.5, 1.0, 0.0], [0.5, 0.0, 0.0]]
    assert go.successor.tolist() == [[1, 2, 2], [2, 1, 2]]


def test_labels_of_some_states_are_those_of_all():
    world = compile_world(load_environment(changed(TINY, ("labels", {"a": [2, 0, 2], "b": [], "c": [1]}))))
    atoms, states = [Atom("a"), Atom("b"), Atom("c")], np.array([2, 1, 0, 0])
    every = world.labels(atoms)
    assert every.tolist() == [[True, False, True], [False, False, False], [False, True, False]]
    assert world.labels(atoms, states).tolist() == every[:, states].tolist()


def test_a_caller_who_changes_an_answer_changes_nothing_else():
    world = compile_world(load_environment(TINY))
    before = world.outcomes(0).probability.copy()
    world.outcomes(0).probability[:] = 0.5
    assert (world.outcomes(0).probability == before).all()


def test_states_without_transitions_are_allowed():
    world = compile_world(load_environment(changed(TINY, ("transitions", []))))
    assert world.actions == ()


def test_labels_are_nullary_propositions():
    functions = load_environment(TINY).functions
    assert list(functions) == ["a", "b"]
    assert functions["a"].parameters == ()
