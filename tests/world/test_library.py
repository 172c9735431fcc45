"""What comes with the package, and the builders."""

import json

import numpy as np
import pytest

from models.logic.formula import Atom, Name
from models.world import atom_symbols, builtin_environments, compile_world, load_environment, navigation_spec, toys_spec
from models.world.specs import ENVIRONMENT

BUILTIN = dict(builtin_environments())


def test_the_environments_of_a_new_service():
    assert sorted(BUILTIN) == [
        "city",
        "house",
        "navigation",
        "toys",
        "toys-4x1-cylinder",
        "toys-4x1-sphere",
        "warehouse",
    ]
    sizes = {name: compile_world(load_environment(data)).size for name, data in BUILTIN.items()}
    assert sizes["toys"] == 4 * 5 * 6**4
    assert (sizes["house"], sizes["warehouse"]) == (20 * 21 * 22**2 * 2**2, 24 * 25 * 29**2)
    assert sizes["toys-4x1-cylinder"] == sizes["toys-4x1-sphere"] == 4 * 5 * 6
    landmarks = [s for s in load_environment(BUILTIN["navigation"]).symbols("place") if "_" not in s.name]
    assert len(landmarks) >= 12


@pytest.mark.parametrize("name", BUILTIN)
def test_every_place_can_be_reached(name):
    world = compile_world(load_environment(BUILTIN[name]))
    seen, frontier = np.zeros(world.size, dtype=bool), np.array([world.initial])
    while len(frontier):
        seen[frontier] = True
        targets = [world.outcomes(action, frontier).successor.ravel() for action in range(len(world.actions))]
        entered = np.unique(np.concatenate(targets))
        frontier = entered[~seen[entered]]
    reached = {world.decode(state)["robot"]["at"] for state in np.flatnonzero(seen)} if world.size < 200 else None
    robot = next(v for v in world.variables if v.object == "robot")
    assert reached is None or reached == set(robot.values)
    assert (seen == world.valid()).all(), "every legal state can be reached"


@pytest.mark.parametrize("name", BUILTIN)
def test_the_data_are_json_of_the_published_shape(name):
    data = json.loads(json.dumps(BUILTIN[name]))
    assert data == BUILTIN[name]
    dumped = ENVIRONMENT.validate_python(data).model_dump(by_alias=True, mode="json")
    assert compile_world(load_environment(dumped)).actions == compile_world(load_environment(data)).actions


def test_the_schema_of_an_environment():
    schema = ENVIRONMENT.json_schema(by_alias=True)
    for name, kind in (("OomdpSpec", "oomdp"), ("ExplicitSpec", "explicit")):
        spec = schema["$defs"][name]
        assert {"kind", "name"} <= set(spec["required"])
        assert spec["properties"]["kind"]["const"] == kind
        assert "default" not in spec["properties"]["kind"]
    texts = [
        schema["$defs"]["OutcomeSpec"]["properties"]["probability"],
        schema["$defs"]["ActionSpec"]["properties"]["when"],
        schema["$defs"]["FunctionSpec"]["properties"]["is"],
        schema["$defs"]["DefinitionSpec"]["properties"]["is"],
    ]
    for text in texts:
        assert text["type"] == "string"
        assert "read too" in text["description"]


@pytest.mark.parametrize("name", BUILTIN)
def test_every_built_in_environment_gives_its_kind(name):
    assert BUILTIN[name]["kind"] == "oomdp"
    assert toys_spec()["kind"] == navigation_spec()["kind"] == "oomdp"


def test_builtin_environments_are_fresh_copies():
    dict(builtin_environments())["toys"]["objects"].clear()
    assert dict(builtin_environments())["toys"]["objects"]


def test_toys_by_shape_and_color():
    environment = load_environment(toys_spec(toys=[("star", "red"), ("star", "blue"), ("cube", "teal")]))
    assert [symbol.name for symbol in environment.symbols("toy")] == ["red_star", "blue_star", "cube"]
    assert atom_symbols(Atom("shaped", (Name("red_star"), Name("star"))), environment)[1].kind == "shape"


def test_seeded_placement_is_repeatable():
    one, other = toys_spec(columns=4, rows=4, toys=3, seed=1), toys_spec(columns=4, rows=4, toys=3, seed=2)
    assert one == toys_spec(columns=4, rows=4, toys=3, seed=1)
    assert one["state"] != other["state"]
    load_environment(one)


def test_placement_by_hand():
    spec = toys_spec(toys=1, state={"cylinder": {"in": "box"}, "robot": {"at": "bathroom"}})
    assert compile_world(load_environment(spec)).decode(compile_world(load_environment(spec)).initial) == {
        "robot": {"at": "bathroom"},
        "box": {"in": "bedroom"},
        "cylinder": {"in": "box"},
    }


def test_large_grids_have_generated_names():
    world = compile_world(load_environment(toys_spec(columns=10, rows=10, toys=1)))
    assert world.size == 100 * 101 * 102
    assert world.variables[0].values[-1] == "cell_10_10"


def test_navigation_defaults():
    world = compile_world(load_environment(navigation_spec()))
    assert world.decode(world.initial) == {"robot": {"at": "home"}}
    assert world.size == 16
