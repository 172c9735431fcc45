"""Pictures as SVG: whole, self-contained, and well-formed whatever things are called."""

from xml.etree import ElementTree

import pytest
from hypothesis import given
from hypothesis import strategies as st

from models.world import builtin_environments, load_environment, toys_spec
from models.world.errors import WorldError
from models.world.picture import picture, to_svg
from tests.world.worlds import TINY

WORLDS = {name: load_environment(data) for name, data in builtin_environments()}
SVG = "{http://www.w3.org/2000/svg}"


def drawn(environment, **changes):
    world = environment.world
    state = world.decode(world.encode(changes))
    return ElementTree.fromstring(to_svg(picture(environment, state, caption="step 1 of 2")))


@pytest.mark.parametrize("name", WORLDS)
def test_every_cell_and_thing_is_there_once(name):
    root, environment = drawn(WORLDS[name]), WORLDS[name]
    cells = [rect.get("data-cell") for rect in root.iter(f"{SVG}rect") if rect.get("data-cell")]
    assert cells == list(environment.grid.cells)
    things = [group.get("data-object") for group in root.iter(f"{SVG}g") if group.get("data-object")]
    assert len(set(things)) == len(things)
    assert {variable.object for variable in environment.world.variables} <= set(things)
    assert root.find(f"{SVG}title").text.startswith(name)


@pytest.mark.parametrize("name", WORLDS)
def test_nothing_outside_the_picture_is_needed(name):
    text = to_svg(picture(WORLDS[name], WORLDS[name].world.decode(WORLDS[name].world.initial)))
    assert text.count("http") == 1, "the name space"
    assert not any(word in text for word in ("<script", "<image", "href", "@import", "url("))


def test_an_appliance_says_whether_it_is_on():
    status = [
        text.text
        for text in drawn(WORLDS["house"], oven={"power": "on"}).iter(f"{SVG}text")
        if text.get("data-part") == "status"
    ]
    assert sorted(status) == ["off", "on"]


def test_a_way_is_a_line_for_each_move():
    environment = WORLDS["toys-4x1-sphere"]
    world = environment.world
    states = [
        world.decode(world.encode({"robot": {"at": at}})) for at in ("kitchen", "living_room", "living_room", "bedroom")
    ]
    root = ElementTree.fromstring(to_svg(picture(environment, states[-1], run=states)))
    assert sum(line.get("class") == "trail" for line in root.iter(f"{SVG}polyline")) == 2


def test_a_world_without_a_map_is_listed():
    root = drawn(load_environment(TINY))
    assert "mdp: state 0" in [text.text for text in root.iter(f"{SVG}text")]


@given(st.text(min_size=1, max_size=20))
def test_any_name_that_a_world_may_have_is_drawn(name):
    spec = toys_spec(columns=2, rows=1, toys=1)
    spec["objects"][name] = spec["objects"].pop("cylinder")
    spec["state"][name] = spec["state"].pop("cylinder")
    try:
        environment = load_environment(spec)
    except WorldError:
        return
    groups = [group for group in drawn(environment).iter(f"{SVG}g") if group.get("data-object")]
    assert len(groups) == 3


def test_what_never_changes_of_a_thing_is_said_and_its_size_is_drawn():
    groups = {
        group.get("data-object"): group for group in drawn(WORLDS["toys"]).iter(f"{SVG}g") if group.get("data-object")
    }
    assert groups["cylinder"].find(f"{SVG}title").text == "cylinder: red, small"
    assert groups["robot"].find(f"{SVG}title").text == "robot"
    scales = {name: group.find(f"{SVG}g").get("transform") for name, group in groups.items() if name != "robot"}
    assert "scale(0.82)" in scales["cylinder"]
    assert "scale(1.15)" in scales["bag"]
