"""Where things are drawn, against places worked out by hand."""

import pytest

from models.world import builtin_environments, load_environment, toys_spec
from models.world.picture import CELL, layout_of
from models.world.picture.layout import HELD, ROBOT, SHRUNK
from tests.world.worlds import TINY

WORLDS = {name: load_environment(data) for name, data in builtin_environments()}


def place(environment, **changes):
    world = environment.world
    return layout_of(environment).place(world.decode(world.encode(changes)))


def test_things_share_the_floor_of_their_cell():
    spots = place(WORLDS["toys"])
    assert (spots["robot"].x, spots["robot"].y) == ROBOT, "the kitchen is the first cell"
    assert [spots[name].x for name in ("sphere", "bag")] == pytest.approx([CELL + CELL / 3, CELL + 2 * CELL / 3])
    assert spots["box"].x == CELL / 2
    assert spots["box"].y == CELL + spots["sphere"].y


def test_what_is_held_or_inside_moves_with_its_host_and_is_smaller():
    spots = place(WORLDS["toys"], box={"in": "robot"}, cylinder={"in": "box"})
    box, cylinder = spots["box"], spots["cylinder"]
    assert (box.x, box.y, box.scale, box.host) == (ROBOT[0] + HELD[0], ROBOT[1] + HELD[1], SHRUNK, "robot")
    assert cylinder.host == "box"
    assert cylinder.scale == pytest.approx(SHRUNK**2)
    assert abs(cylinder.x - box.x) < 15


CLOCKS = {
    "name": "clocks",
    "attributes": {"time": ["noon", "night"]},
    "classes": {
        "cell": {"static": dict.fromkeys(("north", "south", "east", "west"), "cell")},
        "robot": {"state": {"at": "cell"}},
        "clock": {"state": {"shows": "time"}},
    },
    "constants": {"robot": "robot"},
    "functions": {"at": {"arguments": ["r: robot", "c: cell"], "is": "r.at == c"}},
    "actions": {"east": {"outcomes": [{"set": {"robot.at": "robot.at.east"}}]}},
}


def test_what_is_nowhere_stands_below_the_map():
    state = {"robot": {"at": "hall"}, "clock": {"shows": "noon"}}
    data = {"name": "one", "kind": "oomdp", "domain_spec": CLOCKS, "objects": {"clock": {"class": "clock"}}}
    grid = {"class": "cell", "map": ["HK"], "names": {"H": "hall", "K": "kitchen"}}
    spots = layout_of(load_environment({**data, "grid": grid, "state": state})).place(state)
    assert spots["clock"].y > CELL
    assert spots["robot"].y < CELL


def test_walls_are_the_edges_and_what_parts_neighbours_each_once():
    row = layout_of(WORLDS["toys-4x1-sphere"]).walls()
    assert sorted(row) == sorted(
        [(100.0 * x, y, 100.0 * x + 100, y) for x in range(4) for y in (0.0, 100.0)]
        + [(x, 0.0, x, 100.0) for x in (0.0, 400.0)]
    )
    parted = load_environment(toys_spec(columns=2, rows=1, toys=1, walls=[("kitchen", "bedroom")]))
    assert (100.0, 0.0, 100.0, 100.0) in layout_of(parted).walls()


def test_rooms_group_cells_and_appliances_stand_in_them():
    layout = layout_of(WORLDS["house"])
    assert {name: len(cells) for name, cells in layout.regions.items()} == {
        "kitchen": 4,
        "living_room": 6,
        "bedroom": 4,
        "bathroom": 6,
    }
    assert layout.fixtures == {"oven": "spot_2_1", "washing_machine": "spot_5_4"}
    assert layout.robot == "robot"
    assert layout.containers == {"basket"}
    assert layout.says("spot_2_1") == "kitchen (column 2, row 1)"
    shelves = layout_of(WORLDS["warehouse"])
    assert {"trolley", "shelf_a"} <= shelves.containers


def test_worlds_without_a_map_have_no_layout():
    assert layout_of(load_environment(TINY)) is None


@pytest.mark.parametrize("name", WORLDS)
def test_everything_has_a_place_within_the_picture(name):
    layout, world = layout_of(WORLDS[name]), WORLDS[name].world
    spots = layout.place(world.decode(world.initial))
    assert spots.keys() == {symbol.name for symbol in layout.things}
    for spot in spots.values():
        assert 0 < spot.x < CELL * layout.columns
        assert 0 < spot.y < CELL * layout.rows
