"""The built-in toys domain against a plain Python simulator, state by state."""

import numpy as np
import pytest

from models.logic.formula import Atom, Name
from models.world import compile_world, load_environment, toys_spec
from tests.world.simulator import Toys

GRIDS = [
    pytest.param(2, 1, 1, 0.0, (), id="2x1"),
    pytest.param(1, 1, 1, 0.3, (), id="one cell"),
    pytest.param(4, 1, 1, 0.1, (), id="4x1 slip"),
    pytest.param(2, 2, 2, 0.0, (), id="2x2 two toys"),
    pytest.param(2, 2, 2, 0.25, (((0, 0), (1, 0)),), id="2x2 two toys, wall, slip"),
    pytest.param(3, 3, 1, 0.1, (((0, 0), (0, 1)), ((1, 1), (2, 1))), id="3x3 walls slip"),
    pytest.param(3, 1, 3, 1.0, (), id="three toys, always slips"),
    pytest.param(3, 2, 0, 0.5, (), id="no toy"),
]


def build(columns, rows, toys, slip, walls):
    """The compiled world and the simulator of the same place, and the cells' names."""
    plain = toys_spec(columns=columns, rows=rows, toys=toys, slip=slip)
    names = list(plain["grid"]["names"].values())
    simulator = Toys(columns, rows, toys, slip, walls)
    cell_names = dict(zip(simulator.cells, names, strict=True))
    walled = toys_spec(
        columns=columns, rows=rows, toys=toys, slip=slip, walls=[(cell_names[a], cell_names[b]) for a, b in walls]
    )
    return load_environment(walled), simulator, cell_names


def spoken(state, things, names):
    """A simulator's state in the words of the world."""
    words = {"held": "robot", "boxed": "box"} | names
    return {"robot": {"at": words[state[0]]}} | {
        thing: {"in": words[place]} for thing, place in zip(things, state[1:], strict=True)
    }


@pytest.mark.parametrize(("columns", "rows", "toys", "slip", "walls"), GRIDS)
def test_every_state_and_action_is_as_simulated(columns, rows, toys, slip, walls):
    environment, simulator, names = build(columns, rows, toys, slip, walls)
    world = compile_world(environment)
    things = [symbol.name for symbol in environment.symbols("box", "toy")]
    states = simulator.states()
    index = {state: number for number, state in enumerate(states)}
    assert world.size == len(states) == columns * rows * (columns * rows + 1) * (columns * rows + 2) ** toys
    valid = world.valid()
    everything = {name: world.outcomes(action) for action, name in enumerate(world.actions)}
    for state, number in index.items():
        assert world.decode(number) == spoken(state, things, names)
        assert valid[number] == simulator.legal(state)
        if not valid[number]:
            continue
        assert world.encode(spoken(state, things, names)) == number
        expected = {}
        for action, chances in simulator.moves(state):
            verb, *thing = action.split()
            arguments = [things[int(thing[0]) - 1]] if thing else []
            arguments += ["box"] if verb in ("put", "take") else []
            name = f"{verb}({', '.join(arguments)})" if arguments else verb
            expected[name] = {index[target]: pytest.approx(chance) for target, chance in chances.items()}
        actual = {}
        for name, outcomes in everything.items():
            if outcomes.enabled[number]:
                chances = outcomes.probability[:, number]
                kept = np.flatnonzero(chances)
                assert len(set(outcomes.successor[kept, number])) == len(kept), "same successors are merged"
                actual[name] = {int(outcomes.successor[k, number]): chances[k] for k in kept}
            else:
                assert not outcomes.probability[:, number].any()
            idle = outcomes.probability[:, number] == 0
            assert (outcomes.successor[idle, number] == number).all()
        assert actual == expected


@pytest.mark.parametrize(("columns", "rows", "toys", "slip", "walls"), GRIDS)
def test_propositions_are_as_simulated(columns, rows, toys, slip, walls):
    environment, simulator, names = build(columns, rows, toys, slip, walls)
    things = [symbol.name for symbol in environment.symbols("box", "toy")]
    states = simulator.states()
    expected = {}
    for number, thing in enumerate(things, start=1):
        for cell, name in names.items():
            expected[Atom("at", (Name(thing), Name(name)))] = [simulator.place(s, number) == cell for s in states]
        expected[Atom("holding", (Name(thing),))] = [s[number] == "held" for s in states]
        expected[Atom("near", (Name("robot"), Name(thing)))] = [
            simulator.place(s, number) == s[0] or simulator.carried(s, number) for s in states
        ]
        if number > 1:
            expected[Atom("in", (Name(thing), Name("box")))] = [s[number] == "boxed" for s in states]
    for cell, name in names.items():
        expected[Atom("at", (Name("robot"), Name(name)))] = [s[0] == cell for s in states]
        expected[Atom("near", (Name("robot"), Name(name)))] = [s[0] == cell for s in states]
    labels = compile_world(environment).labels(list(expected))
    assert (labels == np.array(list(expected.values()))).all()


@pytest.mark.parametrize(("columns", "rows", "toys", "slip", "walls"), GRIDS)
def test_legal_states_only_lead_to_legal_states(columns, rows, toys, slip, walls):
    world = compile_world(build(columns, rows, toys, slip, walls)[0])
    valid = world.valid()
    for action in range(len(world.actions)):
        outcomes = world.outcomes(action)
        legal = outcomes.enabled & valid
        assert valid[outcomes.successor[:, legal]].all()
        assert outcomes.probability[:, legal].sum(axis=0) == pytest.approx(1.0)


def test_colors_and_shapes_do_not_change():
    world = compile_world(load_environment(toys_spec(toys=[("cube", "teal"), ("star", "red")])))
    atoms = [
        Atom("colored", (Name("cube"), Name("teal"))),
        Atom("colored", (Name("cube"), Name("red"))),
        Atom("shaped", (Name("star"), Name("star"))),
        Atom("shaped", (Name("star"), Name("cube"))),
    ]
    labels = world.labels(atoms)
    assert labels.all(axis=1).tolist() == [True, False, True, False]
    assert labels.any(axis=1).tolist() == [True, False, True, False]


@pytest.mark.parametrize(("columns", "rows", "toys"), [(4, 1, 1), (4, 1, 4), (3, 3, 3), (5, 2, 2)])
def test_batches_agree_with_all_states(columns, rows, toys):
    environment = load_environment(toys_spec(columns=columns, rows=rows, toys=toys, slip=0.1))
    world = compile_world(environment)
    chosen = np.random.default_rng(0).integers(0, world.size, 300)
    atoms = [Atom("at", (Name("cylinder"), Name("bedroom"))), Atom("near", (Name("robot"), Name("box")))]
    assert (world.labels(atoms, chosen) == world.labels(atoms)[:, chosen]).all()
    assert (world.valid(chosen) == world.valid()[chosen]).all()
    for action in range(len(world.actions)):
        every, some = world.outcomes(action), world.outcomes(action, chosen)
        assert (some.enabled == every.enabled[chosen]).all()
        assert (some.probability == every.probability[:, chosen]).all()
        assert (some.successor == every.successor[:, chosen]).all()


def test_an_empty_batch_is_answered():
    world = compile_world(load_environment(toys_spec()))
    none = np.zeros(0, dtype=np.int64)
    assert world.outcomes(0, none).successor.shape == (1, 0)
    assert world.labels([Atom("holding", (Name("box"),))], none).shape == (1, 0)
    assert world.valid(none).shape == (0,)


def test_variables_and_actions_in_order():
    world = compile_world(load_environment(toys_spec(columns=2, rows=1, toys=1)))
    assert [(v.object, v.attribute, v.values) for v in world.variables] == [
        ("robot", "at", ("kitchen", "bedroom")),
        ("box", "in", ("kitchen", "bedroom", "robot")),
        ("cylinder", "in", ("kitchen", "bedroom", "robot", "box")),
    ]
    assert world.actions == (
        "north", "south", "east", "west", "pick(box)", "pick(cylinder)", "drop(box)", "drop(cylinder)",
        "put(cylinder, box)", "take(cylinder, box)",
    )  # fmt: skip
    # robot in the kitchen (0), box in the bedroom (1), cylinder in the bedroom (1): 0 * 12 + 1 * 4 + 1
    assert world.initial == 5
