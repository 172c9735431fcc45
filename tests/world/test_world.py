"""One contract, checked for every kind of world."""

import numpy as np
import pytest

from models.logic.formula import Atom, Name, Parameter
from models.world import (
    StateError,
    TypeMismatchError,
    UnknownObjectError,
    UnknownPropositionError,
    WorldError,
    builtin_environments,
    compile_world,
    load_environment,
    navigation_spec,
    toys_spec,
)
from tests.world.worlds import SWITCHES, TINY

EVERY = {
    **dict(builtin_environments()),
    "switches": SWITCHES,
    "tiny": TINY,
    "built toys": toys_spec(columns=3, rows=2, toys=2, slip=0.2, seed=3),
    "built navigation": navigation_spec(columns=5, rows=3, slip=0.2, blocked=[(2, 2)]),
}


@pytest.fixture(params=EVERY, scope="module")
def data(request):
    return EVERY[request.param]


@pytest.fixture(scope="module")
def world(data):
    return compile_world(load_environment(data))


def test_size_is_the_product_of_the_variables(world):
    assert world.size == np.prod([len(variable.values) for variable in world.variables])
    assert len({(v.object, v.attribute) for v in world.variables}) == len(world.variables)
    assert all(len(set(v.values)) == len(v.values) for v in world.variables)


def test_the_initial_state_is_valid(world):
    assert 0 <= world.initial < world.size
    assert world.valid()[world.initial]


def test_encode_inverts_decode(world):
    valid = np.flatnonzero(world.valid())
    for index in np.random.default_rng(1).choice(valid, 50).tolist():
        state = world.decode(index)
        assert list(state) == list(dict.fromkeys(v.object for v in world.variables))
        assert world.encode(state) == index
        assert world.encode({}, base=index) == index
    assert world.encode({}) == world.initial


def test_actions_are_named_once(world):
    assert len(set(world.actions)) == len(world.actions)


def test_outcomes_are_distributions_over_valid_states(world):
    valid = world.valid()
    for action in range(len(world.actions)):
        outcomes = world.outcomes(action)
        count = len(outcomes.probability)
        assert outcomes.enabled.shape == (world.size,)
        assert outcomes.enabled.dtype == np.bool_
        assert outcomes.probability.shape == outcomes.successor.shape == (count, world.size)
        assert outcomes.probability.dtype == np.float64
        assert outcomes.successor.dtype == np.int64
        assert (outcomes.probability >= 0).all()
        assert outcomes.enabled.any(), "an action that is possible nowhere is dropped"
        sums = outcomes.probability.sum(axis=0)
        assert sums[outcomes.enabled & valid] == pytest.approx(1.0, abs=1e-9)
        assert not sums[~outcomes.enabled].any()
        assert valid[outcomes.successor[:, outcomes.enabled & valid]].all()
        here = np.broadcast_to(np.arange(world.size), outcomes.successor.shape)
        idle = outcomes.probability == 0
        assert (outcomes.successor[idle] == here[idle]).all()
        for one in range(count):
            for other in range(one):
                both = (outcomes.probability[one] > 0) & (outcomes.probability[other] > 0)
                assert (outcomes.successor[one] != outcomes.successor[other])[both].all()


def test_batches_are_rows_of_the_whole(world):
    chosen = np.random.default_rng(2).integers(0, world.size, 40)
    assert (world.valid(chosen) == world.valid()[chosen]).all()
    for action in range(len(world.actions)):
        every, some = world.outcomes(action), world.outcomes(action, chosen)
        assert (some.enabled == every.enabled[chosen]).all()
        assert (some.probability == every.probability[:, chosen]).all()
        assert (some.successor == every.successor[:, chosen]).all()


def test_loading_twice_gives_the_same(data, world):
    again = compile_world(load_environment(data))
    assert again.variables == world.variables
    assert again.actions == world.actions
    assert again.initial == world.initial
    for action in range(len(world.actions)):
        assert (again.outcomes(action).successor == world.outcomes(action).successor).all()


@pytest.mark.parametrize(
    ("state", "places"),
    [
        ({"robt": {"at": "kitchen"}}, {"/robt": "did you mean robot"}),
        ({"kitchen": {"at": "kitchen"}}, {"/kitchen": "no object kitchen with a state"}),
        ({"robot": {"in": "kitchen"}}, {"/robot/in": "no state attribute in"}),
        ({"robot": {"at": "kitchn"}}, {"/robot/at": "did you mean kitchen"}),
        ({"robot": {"at": "box"}}, {"/robot/at": "cannot be box"}),
        ({"robot": {"at": "attic"}, "box": {"in": "cylinder"}}, {"/robot/at": "attic", "/box/in": "cylinder"}),
    ],
)
def test_wrong_states(state, places):
    world = compile_world(load_environment(toys_spec()))
    with pytest.raises(StateError) as caught:
        world.encode(state)
    assert caught.value.slug == "invalid-state"
    assert {p.pointer for p in caught.value.places} == set(places)
    assert all(places[place.pointer] in place.detail for place in caught.value.places)


def test_a_state_that_breaks_a_constraint():
    world = compile_world(load_environment(toys_spec()))
    with pytest.raises(StateError, match="constraint"):
        world.encode({"box": {"in": "robot"}, "cylinder": {"in": "robot"}})


def test_partial_states_complete_from_a_base():
    world = compile_world(load_environment(toys_spec()))
    moved = world.encode({"robot": {"at": "bathroom"}})
    assert world.decode(moved) == {**world.decode(world.initial), "robot": {"at": "bathroom"}}
    both = world.encode({"cylinder": {"in": "box"}}, base=moved)
    assert world.decode(both) == {**world.decode(moved), "cylinder": {"in": "box"}}


@pytest.mark.parametrize(
    ("atom", "error"),
    [
        (Atom("flies", (Name("box"),)), UnknownPropositionError),
        (Atom("holding"), UnknownPropositionError),
        (Atom("holding", (Name("crate"),)), UnknownObjectError),
        (Atom("holding", (Parameter(1),)), UnknownObjectError),
        (Atom("holding", (Name("kitchen"),)), TypeMismatchError),
    ],
)
def test_wrong_atoms(atom, error):
    world = compile_world(load_environment(toys_spec()))
    with pytest.raises(error):
        world.labels([atom])


def test_a_world_beyond_the_limit_can_be_spoken_of_but_not_computed():
    environment = load_environment(toys_spec(columns=5, rows=2, toys=24))
    world = compile_world(environment)
    assert world.size == 10 * 11 * 12**24
    assert "pick(cylinder)" not in world.actions
    assert "pick(red_cylinder)" in world.actions
    state = world.decode(world.initial)
    assert world.encode(state) == world.initial
    assert world.decode(world.encode({"robot": {"at": "attic"}}))["robot"] == {"at": "attic"}
    with pytest.raises(StateError):
        world.encode({"red_cylinder": {"in": "robot"}, "box": {"in": "robot"}})
    with pytest.raises(WorldError, match="too large"):
        world.outcomes(0)
    with pytest.raises(WorldError, match="too large"):
        world.valid(np.zeros(1, dtype=np.int64))
