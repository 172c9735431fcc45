"""Maps."""

import numpy as np
import pytest

from models.world import WorldError, compile_world, load_environment, navigation_spec, toys_spec
from models.world.grid import read_grid
from models.world.report import Report
from models.world.specs import GridSpec
from tests.world.worlds import changed


def read(lines, names=None, walls=()):
    report = Report()
    spec = GridSpec(class_="cell", map=lines, names=names or {}, walls=[list(wall) for wall in walls])
    return read_grid(spec, report), {place.pointer: place.detail for place in report.places}


def test_neighbours():
    grid, faults = read(["A.#", ".B."], {"A": "attic", "B": "bath"}, [("attic", "cell_2_1")])
    assert not faults
    assert list(grid.cells) == ["attic", "cell_2_1", "cell_1_2", "bath", "cell_3_2"]
    assert grid.neighbours["attic"] == {"north": "attic", "south": "cell_1_2", "east": "attic", "west": "attic"}
    assert grid.neighbours["cell_2_1"] == {
        "north": "cell_2_1", "south": "bath", "east": "cell_2_1", "west": "cell_2_1",
    }  # fmt: skip
    assert grid.neighbours["bath"] == {"north": "cell_2_1", "south": "bath", "east": "cell_3_2", "west": "cell_1_2"}
    assert grid.neighbours["cell_3_2"]["north"] == "cell_3_2"


@pytest.mark.parametrize(
    ("lines", "names", "walls", "pointer", "detail"),
    [
        (["..", "."], {}, [], "/grid/map/1", "has 1 characters, the first 2"),
        (["A."], {}, [], "/grid/map/0", "'A' is not in names"),
        (["AA"], {"A": "a"}, [], "/grid/map/0", "twice"),
        (["AB"], {"A": "a", "B": "a"}, [], "/grid/map/0", "two cells are called a"),
        (["."], {"A": "a"}, [], "/grid/names/A", "not on the map"),
        (["."], {"#": "a"}, [], "/grid/names/#", "other than"),
        (["A"], {"A": ""}, [], "/grid/names/A", "empty"),
        (["##"], {}, [], "/grid/map", "no cell"),
        ([""], {}, [], "/grid/map", "no cell"),
        (["." * 100] * 51, {}, [], "/grid/map", "at most"),
        (["AB"], {"A": "a", "B": "b"}, [("a",)], "/grid/walls/0", "pair"),
        (["AB"], {"A": "a", "B": "b"}, [("a", "c")], "/grid/walls/0", "no cell is called c"),
        (["A.B"], {"A": "a", "B": "b"}, [("a", "b")], "/grid/walls/0", "not neighbours"),
    ],
)
def test_wrong_maps(lines, names, walls, pointer, detail):
    _, faults = read(lines, names, walls)
    assert pointer in faults
    assert detail in faults[pointer]


def test_cells_are_objects_with_attributes():
    data = changed(
        toys_spec(),
        ("objects/kitchen", {"class": "cell", "synonyms": ["galley"], "attributes": {"color": "red", "east": "attic"}}),
    )
    with pytest.raises(WorldError, match="no"):
        load_environment(data)
    data["objects"]["kitchen"]["attributes"]["east"] = "kitchen"
    environment = load_environment(data)
    assert environment.symbols("cell")[0].name == "kitchen"
    world = environment.world
    east = world.outcomes(world.actions.index("east"))
    assert east.successor[0, world.initial] == world.initial, "an attribute given by hand beats the map"


def test_the_class_of_a_grid_needs_directions():
    with pytest.raises(WorldError, match="/grid/class"):
        load_environment(changed(toys_spec(), ("grid/class", "toy")))


def test_navigation_moves_as_drawn():
    spec = navigation_spec(columns=3, rows=3, landmarks={"a": (1, 1), "b": (3, 3)}, blocked=[(2, 1)], slip=0.5)
    world = load_environment(spec).world
    assert world.size == 8

    def reach(place, action):
        index = world.encode({"robot": {"at": place}})
        outcomes = world.outcomes(world.actions.index(action))
        pairs = zip(outcomes.successor[:, index], outcomes.probability[:, index], strict=True)
        return {world.decode(int(s))["robot"]["at"]: float(p) for s, p in pairs if p}

    assert reach("a", "east") == {"a": 0.75, "place_1_2": 0.25}
    assert reach("place_2_2", "north") == {"place_2_2": 0.5, "place_1_2": 0.25, "place_3_2": 0.25}
    assert reach("b", "south") == {"b": 0.75, "place_2_3": 0.25}


def garden(**changes):
    """A robot that fills its can at the tap, which the domain names and the grid has as a cell."""
    cells = {"north": "bed", "south": "bed", "east": "bed", "west": "bed"}
    return {
        "name": "garden",
        "kind": "oomdp",
        "domain_spec": {
            "name": "watering",
            "attributes": {"can": ["empty", "full"]},
            "classes": {"bed": {"static": cells}, "robot": {"state": {"at": "bed", "can": "can"}}},
            "constants": {"robot": "robot", "tap": "bed"},
            "functions": {"ready": {"is": "robot.can == full"}},
            "actions": {
                "east": {"outcomes": [{"set": {"robot.at": "robot.at.east"}}]},
                "fill": {"when": "robot.at == tap", "outcomes": [{"set": {"robot.can": "full"}}]},
            },
        },
        "grid": {"class": "bed", "map": ["ST"], "names": {"S": "shed", "T": "tap"}},
        "state": {"robot": {"at": "shed", "can": "empty"}},
        **changes,
    }


def test_a_constant_may_be_a_cell():
    environment = load_environment(garden())
    world = compile_world(environment)
    assert world.size == 4
    there = world.outcomes(world.actions.index("east"), np.array([world.initial])).successor[0]
    filled = world.outcomes(world.actions.index("fill"), there)
    assert filled.enabled.tolist() == [True]
    assert world.decode(int(filled.successor[0, 0])) == {"robot": {"at": "tap", "can": "full"}}
    assert not world.outcomes(world.actions.index("fill"), np.array([world.initial])).enabled[0]


def test_a_constant_of_another_class_is_no_cell():
    with pytest.raises(WorldError) as caught:
        load_environment(garden(grid={"class": "bed", "map": ["ST"], "names": {"S": "robot", "T": "tap"}}))
    first = caught.value.places[0]
    assert (first.pointer, first.detail) == ("/grid", "robot is a robot of the domain already")
