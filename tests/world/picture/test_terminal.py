"""Worlds as text."""

from models.world import builtin_environments, load_environment, toys_spec
from models.world.picture import changes, to_text
from tests.world.worlds import TINY


def test_a_small_world_to_the_letter():
    spec = toys_spec(columns=2, rows=1, toys=1)
    assert to_text(
        load_environment(spec), {"robot": {"at": "kitchen"}, "box": {"in": "bedroom"}, "cylinder": {"in": "box"}}
    ) == "\n".join(
        [
            "┼────────────────┼────────────────┼",
            "│ kitchen          bedroom        │",
            "│ @                box (cylinder) │",
            "┼────────────────┼────────────────┼",
        ]
    )


def test_walls_are_lines_and_doors_are_not():
    spec = toys_spec(columns=2, rows=2, toys=1, walls=[("kitchen", "bedroom")])
    lines = to_text(load_environment(spec), spec["state"]).split("\n")
    width = len(lines[0]) // 2
    assert [line[width] for line in lines[1:3]] == ["│", "│"]
    assert lines[5][width] == " ", "between bathroom and living room one can pass"
    assert set(lines[3]) == {"┼", " "}, "so one can from row to row"


def test_a_world_without_a_map_is_said_in_words():
    assert to_text(load_environment(TINY), {"mdp": {"state": "2"}}) == "mdp state 2"


def test_changes_in_words():
    world = load_environment(dict(builtin_environments())["toys"]).world
    before, after = (world.decode(world.encode({"robot": {"at": at}})) for at in ("kitchen", "living_room"))
    assert changes(before, after) == "robot at living room"
    assert changes(after, after) == "nothing changes"
