"""What a phrase that names nothing may be a misspelling of."""

import difflib
import time

import pytest
from hypothesis import given
from hypothesis import strategies as st

from models.world import builtin_environments, ground, load_environment, suggest, toys_spec
from tests.world.worlds import TINY, changed

BUILTIN = {name: load_environment(data) for name, data in builtin_environments()}
TOYS, NAVIGATION = BUILTIN["toys"], BUILTIN["navigation"]


@pytest.mark.parametrize(
    ("phrase", "names"),
    [
        ("cylindr", ("cylinder",)),
        ("the Spere", ("sphere",)),
        ("bal", ("ball",)),  # a synonym of the sphere
        ("living rom", ("living_room",)),
        ("bath-room", ("bathroom",)),
        ("small red cylindr", ("cylinder",)),
        ("kitchens", ("kitchen",)),
        ("blu", ("blue",)),
        ("unicorn", ()),
        ("song", ()),
        ("bog", ()),
        ("kitchen", ()),  # no misspelling
        ("red ball", ()),  # the ball is green
        ("the", ()),
        ("...", ()),
        ("", ()),
        ("x" * 100_000, ()),
    ],
)
def test_suggests(phrase, names):
    assert suggest(phrase, TOYS) == names


def test_landmarks():
    assert suggest("train staton", NAVIGATION) == ("train_station",)
    assert suggest("clothes shp", NAVIGATION) == ("clothes shop",)
    assert suggest("train staton", load_environment(TINY)) == ()


def test_kinds_narrow():
    assert suggest("orang", TOYS) == ("orange",)  # the fruit and the colour are spelled alike
    assert suggest("kichen", TOYS, kinds=frozenset({"toy", "box"})) == ()
    assert suggest("kichen", TOYS, kinds=frozenset({"cell"})) == ("kitchen",)
    assert suggest("kichen", TOYS, kinds=frozenset()) == ()


def test_closest_first_then_in_order_and_at_most_three():
    names = ["marble a", "marbles a", "marbled", "marbel", "warble", "garble"]
    data = changed(
        toys_spec(toys=1),
        *((f"objects/{name}", {"class": "toy"}) for name in names),
        *((f"state/{name}", {"in": "kitchen"}) for name in names),
    )
    expected = sorted(names, key=lambda name: -difflib.SequenceMatcher(None, name, "marble").ratio())[:3]
    assert suggest("marble", load_environment(data)) == tuple(expected)


def test_one_name_of_each_symbol():
    data = changed(toys_spec(toys=1), ("objects/cylinder/synonyms", ["cylindre", "cylinders"]))
    assert suggest("cylindrs", load_environment(data), kinds=frozenset({"toy"})) == ("cylinders",)


ENGLISH = st.lists(st.sampled_from(["the", "red", "cylinder", "cylindr", "kichen", "xyz", "H&M", "a"]), max_size=4)


@given(st.one_of(st.text(max_size=30), ENGLISH.map(" ".join)))
def test_suggestions_are_names_that_ground(phrase):
    found = suggest(phrase, TOYS)
    assert found == suggest(phrase, TOYS)
    assert len(found) == len(set(found)) <= 3
    for name in found:
        assert ground(name, TOYS).candidates


def test_many_synonyms_are_quick():
    letters = "abcdefgh"
    words = ["".join(letters[(i * j + j) % 8] for j in range(1, 90)) + str(i) for i in range(10_000)]
    plain = toys_spec(columns=20, rows=10, toys=0)
    rooms = [symbol.name for symbol in load_environment(plain).symbols("cell")]
    named = {name: {"class": "cell", "synonyms": words[i * 50 : i * 50 + 50]} for i, name in enumerate(rooms)}
    environment = load_environment({**plain, "objects": {**plain["objects"], **named}})
    before = time.process_time()
    suggest(words[77][::-1], environment)
    assert time.process_time() - before < 5
