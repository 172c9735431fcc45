"""Phrases that say where things are, compare them, and speak of several: computed by hand, and against the state."""

from __future__ import annotations

import time

import pytest
from hypothesis import given
from hypothesis import strategies as st

from models.world import Quantifier, StateError, ground, load_environment, widened, with_values
from tests.world.worlds import NURSERY, PANTRY, TINY

MOVABLE = frozenset({"toy", "box"})
WORDS = ("any", "every", "the", "smallest", "toy", "one", "of", "red", "in", "box", "with", "two", "ball", "kitchen")
ROOMS = ("kitchen", "bedroom", "living_room", "bathroom")


@pytest.fixture(scope="module")
def nursery():
    return load_environment(NURSERY)


@pytest.fixture(scope="module")
def pantry():
    return load_environment(PANTRY)


def names(phrase, environment, kinds=None):
    return [candidate.symbol.name for candidate in ground(phrase, environment, kinds=kinds).candidates]


@pytest.mark.parametrize(
    ("phrase", "expected"),
    [
        ("the object in the kitchen", ["blue_ball"]),  # an object is a toy, in this domain
        ("the toy in the box", ["blue_ball"]),
        ("the toy that is in the crate", ["red_ball"]),
        ("the ball from the crate", ["red_ball"]),
        ("the ball in the crate in the bedroom", ["red_ball"]),
        ("the box in the bedroom", ["crate"]),
        ("the red toy in the bedroom", ["red_ball", "cube"]),
        ("the red ball in the bedroom", ["red_ball"]),
        ("the box with the blue ball", ["box"]),
        ("the box containing a red toy", ["crate"]),
        ("the toy in your gripper", ["duck"]),
        ("the toy in the kitchne", ["blue_ball"]),
        ("the toy in the bathroom", []),
        ("the unicorn in the kitchen", []),
        ("the toy in the castle", []),
        ("the toy in the", ["red_ball", "blue_ball", "cube", "duck"]),
        ("in the kitchen", []),
        ("the smaller of the two boxes", ["crate"]),
        ("the smallest box", ["crate"]),
        ("the littlest box", ["crate"]),
        ("the bigger box", ["box"]),
        ("the larger one of the boxes", ["box"]),
        ("the less small box", ["box"]),
        ("the big box", ["box"]),
        ("the biggest red toy", ["cube"]),
        ("the smallest toy", ["red_ball", "duck"]),
        ("the smaller toy", ["red_ball", "duck"]),
        ("the larger", ["box", "blue_ball", "cube"]),
        ("the smaller ball in the kitchen", ["blue_ball"]),  # the only one there
        ("the smalest box", ["crate"]),
        ("the toy in the smaller box", ["red_ball"]),
        ("the nearest ball", ["blue_ball"]),
        ("the farther box", ["crate"]),
        ("the closest toy", ["blue_ball", "duck"]),
        ("the taller box", []),
    ],
)
def test_one_thing(nursery, phrase, expected):
    grounding = ground(phrase, nursery, kinds=MOVABLE)
    assert (grounding.quantifier, [c.symbol.name for c in grounding.candidates]) == (Quantifier.ONE, expected)


@pytest.mark.parametrize(
    ("phrase", "expected"),
    [
        ("the room north of the living room", ["kitchen"]),
        ("the place to the east of the kitchen", ["bedroom"]),
        ("the room with the crate", ["bedroom"]),
        ("the nearest room", ["kitchen"]),
        ("the farthest room", ["bathroom"]),
    ],
)
def test_rooms(nursery, phrase, expected):
    assert names(phrase, nursery, frozenset({"cell"})) == expected


@pytest.mark.parametrize(
    ("phrase", "quantifier", "expected"),
    [
        ("any red toy", "any", ["red_ball", "cube"]),
        ("some toy", "any", ["red_ball", "blue_ball", "cube", "duck"]),
        ("one of the boxes", "any", ["box", "crate"]),
        ("either box", "any", ["box", "crate"]),
        ("any one of the red toys", "any", ["red_ball", "cube"]),
        ("at least one ball", "any", ["red_ball", "blue_ball"]),
        ("anything", "any", ["box", "crate", "red_ball", "blue_ball", "cube", "duck"]),
        ("something red", "any", ["crate", "red_ball", "cube"]),
        ("any rde toy", "any", ["red_ball", "cube"]),
        ("any toy in any box", "any", ["red_ball", "blue_ball"]),
        ("any smallest toy", "any", ["red_ball", "duck"]),
        ("any duck", "any", ["duck"]),
        ("anything in the bathroom", "any", []),
        ("all the toys", "all", ["red_ball", "blue_ball", "cube", "duck"]),
        ("every cube", "all", ["cube"]),
        ("both boxes", "all", ["box", "crate"]),
        ("both of the balls", "all", ["red_ball", "blue_ball"]),
        ("all two boxes", "all", ["box", "crate"]),
        ("each of the red toys", "all", ["red_ball", "cube"]),
        ("everything in the kitchen", "all", ["box", "blue_ball"]),
        ("everything red in the bedroom", "all", ["crate", "red_ball", "cube"]),
        ("every toy that is in the bedroom", "all", ["red_ball", "cube"]),
        ("what is in the crate", "all", ["red_ball"]),
        ("all objects", "all", ["red_ball", "blue_ball", "cube", "duck"]),
        ("all items", "all", ["box", "crate", "red_ball", "blue_ball", "cube", "duck"]),
        ("both toys", "one", ["red_ball", "blue_ball", "cube", "duck"]),  # which two?
        ("all three boxes", "one", []),
        ("a toy", "one", ["red_ball", "blue_ball", "cube", "duck"]),
        ("any", "one", []),
        ("every", "one", []),
    ],
)
def test_several(nursery, phrase, quantifier, expected):
    grounding = ground(phrase, nursery, kinds=MOVABLE)
    assert (grounding.quantifier.value, [c.symbol.name for c in grounding.candidates]) == (quantifier, expected)


@pytest.mark.parametrize(
    ("phrase", "expected"),
    [
        ("the dish in the hall", ["soup", "pie"]),  # on a shelf that stands there
        ("the dish in the cellar", ["ice"]),
        ("the dish on the shelf in the cellar", ["ice"]),
        ("any dish on a shelf in the hall", ["soup", "pie"]),
        ("the shelf in the cellar", ["bottom"]),
        ("the cupboard that stands in the hall", ["top"]),
        ("the dish on the bottom shelf", ["ice"]),
        ("the dish on the open shelf", ["soup", "pie"]),
        ("the closed cupboard", ["bottom"]),
        ("the dish beside the soup", ["pie"]),
        ("the dish next to the pie", ["soup"]),
        ("the dish seen from the hall", ["soup", "pie"]),
        ("the owner of the soup", ["ann"]),
        ("the hottest dish on the top shelf", ["soup"]),
        ("the colder of the two dishes in the hall", ["pie"]),
        ("the warmest dish", ["soup"]),
        ("the coolest dish", ["ice"]),
        ("the icy dish", ["ice"]),
        ("the iciest dish", ["ice"]),
        ("the better dish", ["soup"]),
        ("ice on a stick", ["ice"]),  # a name, though "stick" is one too
        ("the ice on a stick in the cellar", ["ice"]),
        ("the best dish in the cellar", []),  # nothing there has a rank
    ],
)
def test_what_a_domain_of_ones_own_says(pantry, phrase, expected):
    assert names(phrase, pantry) == expected


def test_values_from_the_least_to_the_most_decide_which_end_an_adjective_is_for(pantry):
    """Ranks are good, then plain: the best is the first of them, and "plainest" the last."""
    assert names("the plainest dish", pantry) == ["pie"]
    assert names("the best dish", pantry) == ["soup"]


def test_a_name_that_begins_with_a_quantifier_is_a_name():
    data = {**NURSERY, "objects": {**NURSERY["objects"], "every_man": {"class": "toy", "synonyms": ["All Saints"]}}}
    data["state"] = {**NURSERY["state"], "every_man": {"in": "bathroom"}}
    environment = load_environment(data)
    for phrase in ("Every Man", "All Saints"):
        grounding = ground(phrase, environment, kinds=MOVABLE)
        assert (grounding.quantifier, [c.symbol.name for c in grounding.candidates]) == (Quantifier.ONE, ["every_man"])
    assert ground("all saints", environment, kinds=frozenset({"box"})).candidates == ()


def test_what_is_not_said_exactly_is_read_by_name_before_description(nursery):
    """The box named so holds one toy; where it holds none, another box may be meant."""
    assert names("the red toy in the box", nursery, MOVABLE) == ["red_ball"]
    assert names("the toy in the box", nursery, MOVABLE) == ["blue_ball"]


def test_phrases_go_by_the_state(nursery):
    moved = nursery.in_state({"cube": {"in": "kitchen"}, "box": {"in": "bathroom"}})
    assert names("the toy in the kitchen", moved, MOVABLE) == ["cube"]
    assert names("everything in the bathroom", moved, MOVABLE) == ["box", "blue_ball"]
    assert names("the toy in the kitchen", nursery, MOVABLE) == ["blue_ball"], "the other is as it was"
    assert names("the nearest box", nursery.in_state({"robot": {"at": "bedroom"}}), MOVABLE) == ["crate"]
    with pytest.raises(StateError):
        nursery.in_state({"cube": {"in": "nowhere"}})


def test_an_explicit_environment_has_nothing_to_speak_of():
    environment = load_environment(TINY)
    assert names("anything in the kitchen", environment) == []
    assert names("the smaller state", environment.in_state({"mdp": {"state": "2"}})) == []


@pytest.mark.parametrize(
    ("phrase", "reason"),
    [
        ("the red toy in the crate", "a toy whose color is red, in crate"),
        ("the smaller box", "a box, the smaller"),
        ("the nearest ball in the bedroom", "a toy named red_ball, in bedroom, the nearest"),
        ("the toy in the kitchne", 'a toy, in kitchen, reading "kitchne" as "kitchen"'),
    ],
)
def test_reasons(nursery, phrase, reason):
    assert [candidate.reason for candidate in ground(phrase, nursery, kinds=MOVABLE).candidates] == [reason]


@pytest.mark.parametrize(
    ("phrase", "values", "expected"),
    [
        ("toy", ["red"], "red toy"),
        ("the toy in the box", ["red"], "red the toy in the box"),
        ("any toy", ["red"], "any red toy"),
        ("one of the toys", ["red", "small"], "one of red small toys"),
        ("everything in the box", ["red"], "everything red in the box"),
    ],
)
def test_values_are_said_of_what_a_phrase_is_of(phrase, values, expected):
    assert with_values(phrase, values) == expected


@pytest.mark.parametrize(
    ("text", "phrase", "expected"),
    [
        ("grab any toy now", "toy", "any toy"),
        ("grab any one of the red toys", "red toys", "any one of the red toys"),
        ("bring all of my toys", "toys", "all of my toys"),
        ("take both the boxes", "boxes", "both the boxes"),
        ("take some toy", "toy", "some toy"),
        ("get all three cups", "cups", "all three cups"),
        ("first of all the toys", "toys", "toys"),
        ("go to the museum", "museum", "museum"),
        ("pick up one box", "box", "box"),
        ("museum", "museum", "museum"),
    ],
)
def test_a_quantifier_before_a_phrase_belongs_to_it(text, phrase, expected):
    said = text.split()
    end = len(said) if text.endswith(phrase) else said.index(phrase.split()[-1]) + 1
    begin = end - len(phrase.split())
    assert " ".join(said[widened(said, begin) : end]) == expected


@st.composite
def states(draw):
    """A state of the nursery in which at most one thing is held, as data."""
    held = draw(st.sampled_from([None, "box", "crate", "red_ball", "blue_ball", "cube", "duck"]))
    state = {"robot": {"at": draw(st.sampled_from(ROOMS))}}
    for name, data in NURSERY["objects"].items():
        places = ROOMS if data["class"] == "box" else (*ROOMS, "box", "crate")
        state[name] = {"in": "robot" if name == held else draw(st.sampled_from(places))}
    return state


@given(states())
def test_what_is_in_a_room_is_what_lies_there_or_in_a_box_there(state):
    environment = _NURSERY.in_state(state)
    for room in ROOMS:
        expected = [
            name
            for name in NURSERY["objects"]
            if room in (state[name]["in"], state.get(state[name]["in"], {}).get("in"))
        ]
        assert names(f"everything in the {room}", environment, MOVABLE) == expected
        assert names(f"anything in the {room}", environment, MOVABLE) == expected


@given(states(), st.sampled_from(sorted(NURSERY["objects"])), st.data())
def test_a_phrase_made_of_what_is_so_of_an_object_can_mean_it(state, name, data):
    environment, spec = _NURSERY.in_state(state), NURSERY["objects"][name]
    values = data.draw(st.lists(st.sampled_from(sorted(spec["attributes"].values())), unique=True))
    noun = data.draw(st.sampled_from({"box": ["container"], "toy": ["toy", "thing"]}[spec["class"]]))
    where = data.draw(st.sampled_from(["", f" in the {state[name]['in']}", f" at {state[name]['in']}"]))
    said = data.draw(st.sampled_from(["the", "any", "every", "all the", "one of the", ""]))
    phrase = " ".join([said, *values, noun]) + where
    assert name in names(phrase, environment, MOVABLE), phrase


@given(states(), st.sampled_from(["small", "large"]))
def test_the_extreme_of_some_things_is_one_of_them(state, size):
    environment = _NURSERY.in_state(state)
    for room in ROOMS:
        there = names(f"every toy in the {room}", environment, MOVABLE)
        sizes = {name: NURSERY["objects"][name]["attributes"]["size"] for name in there}
        wanted = size if size in sizes.values() else next(iter(sizes.values()), None)
        superlative = {"small": "smallest", "large": "largest"}[size]
        assert names(f"the {superlative} toy in the {room}", environment, MOVABLE) == [
            name for name in there if sizes[name] == wanted
        ]


@given(st.lists(st.sampled_from(WORDS), max_size=20))
def test_any_words_are_read_in_little_time(said):
    started = time.process_time()
    grounding = ground(" ".join(said), _NURSERY, kinds=MOVABLE)
    assert time.process_time() - started < 2
    assert all(candidate.symbol.kind in MOVABLE for candidate in grounding.candidates)


_NURSERY = load_environment(NURSERY)
