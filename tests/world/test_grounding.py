"""Phrases to symbols."""

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from models.world import Symbol, builtin_environments, ground, load_environment, toys_spec
from tests.world.worlds import TINY, changed


@pytest.fixture(scope="module")
def home():
    """Two buckets, two balls, an orange, a bag that is a toy and one that is a box, rooms with colours."""
    objects = {
        "kitchen": {"class": "cell", "synonyms": ["galley"], "attributes": {"color": "yellow"}},
        "bedroom": {"class": "cell", "attributes": {"color": "red"}},
        "small_red_bucket": {"class": "box", "attributes": {"size": "small", "color": "red"}},
        "crate": {"class": "box", "synonyms": ["large bucket"], "attributes": {"size": "large", "color": "blue"}},
        "bag": {"class": "box", "synonyms": ["sack"]},
        "bag_toy": {"class": "toy", "synonyms": ["bag"], "attributes": {"color": "black", "size": "small"}},
        "ball": {"class": "toy", "attributes": {"color": "red", "shape": "sphere", "size": "large"}},
        "marble": {"class": "toy", "attributes": {"color": "dark blue", "shape": "sphere", "size": "small"}},
        "orange": {"class": "toy", "synonyms": ["fruit"], "attributes": {"color": "orange"}},
        "H&M (2nd floor)": {"class": "toy", "synonyms": ["H&M"]},
        "child's_glasses": {"class": "toy"},
    }
    things = [name for name, data in objects.items() if data["class"] in ("toy", "box")]
    data = toys_spec(columns=2, rows=1, toys=0)
    data["values"] = {"color": ["dark blue"]}
    data["objects"] = objects
    data["state"] = {"robot": {"at": "kitchen"}} | {name: {"in": "kitchen"} for name in things}
    return load_environment(data)


ALL = None
THINGS = frozenset({"toy", "box"})


@pytest.mark.parametrize(
    ("phrase", "kinds", "expected"),
    [
        ("ball", ALL, ["ball"]),
        ("The Ball!", ALL, ["ball"]),
        ("a ball", {"toy"}, ["ball"]),
        ("balls", ALL, ["ball"]),
        ("galley", ALL, ["kitchen"]),
        ("the galleys", ALL, ["kitchen"]),
        ("small red bucket", ALL, ["small_red_bucket"]),
        ("small_red_bucket", ALL, ["small_red_bucket"]),
        ("red bucket", THINGS, ["small_red_bucket"]),
        ("red, small bucket", THINGS, ["small_red_bucket"]),
        ("bucket", ALL, ["small_red_bucket", "crate"]),
        ("the large bucket", ALL, ["crate"]),
        ("blue bucket", ALL, ["crate"]),
        ("box", {"box"}, ["small_red_bucket", "crate", "bag"]),
        ("blue box", ALL, ["crate"]),
        ("large container", ALL, ["crate"]),
        ("red toy", ALL, ["ball"]),
        ("the red one", {"toy"}, ["ball"]),
        ("the red one", THINGS, ["small_red_bucket", "ball"]),
        ("red", {"toy"}, ["ball"]),
        ("red", {"color"}, ["red"]),
        ("red", ALL, ["red"]),
        ("red room", ALL, ["bedroom"]),
        ("bedroom", {"toy"}, []),
        ("sphere", {"toy"}, ["ball", "marble"]),
        ("small sphere", {"toy"}, ["marble"]),
        ("dark blue sphere", ALL, ["marble"]),
        ("sphere that is dark blue", {"toy"}, ["marble"]),
        ("sphere colored dark blue", {"toy"}, ["marble"]),
        ("sphere coloured red", {"toy"}, ["ball"]),
        ("blue sphere", ALL, []),
        ("bag", ALL, ["bag", "bag_toy"]),
        ("bag", {"box"}, ["bag"]),
        ("bag", {"toy"}, ["bag_toy"]),
        ("black bag", ALL, ["bag_toy"]),
        ("orange", ALL, ["orange", "orange"]),
        ("orange", {"toy"}, ["orange"]),
        ("orange", {"color"}, ["orange"]),
        ("the orange orange", ALL, ["orange"]),
        ("color orange", ALL, ["orange"]),
        ("H&M", ALL, ["H&M (2nd floor)"]),
        ("the h & m 2nd floor", ALL, ["H&M (2nd floor)"]),
        ("child's glasses", ALL, ["child's_glasses"]),
        ("childs glasses", ALL, ["child's_glasses"]),
        ("robot", ALL, ["robot"]),
        ("green ball", ALL, []),
        ("ball in the kitchen", ALL, []),
        ("small", ALL, ["small"]),
        ("purple elephant", ALL, []),
        ("bal", ALL, []),
        ("the", ALL, []),
        ("", ALL, []),
        ("!?", ALL, []),
        ("ball", set(), []),
    ],
)
def test_grounds(home, phrase, kinds, expected):
    grounding = ground(phrase, home, kinds=None if kinds is None else frozenset(kinds))
    assert grounding.phrase == phrase
    assert [candidate.symbol.name for candidate in grounding.candidates] == expected
    assert all(kinds is None or candidate.symbol.kind in kinds for candidate in grounding.candidates)


@pytest.mark.parametrize(
    ("pos", "kinds"),
    [("adjective", ["color"]), ("noun", ["toy"]), (None, ["toy", "color"])],
)
def test_part_of_speech_decides_between_a_value_and_an_object(home, pos, kinds):
    assert [c.symbol for c in ground("orange", home, pos=pos).candidates] == [Symbol(k, "orange") for k in kinds]


def test_part_of_speech_does_not_overrule_the_kinds(home):
    adjective = ground("orange", home, kinds=frozenset({"toy"}), pos="adjective")
    assert [c.symbol for c in adjective.candidates] == [Symbol("toy", "orange")]
    noun = ground("red", home, pos="noun")
    assert [c.symbol for c in noun.candidates] == [Symbol("color", "red")]


@pytest.mark.parametrize(
    ("phrase", "reason"),
    [
        ("ball", "a toy named ball"),
        ("galley", "galley is a synonym of kitchen"),
        ("red toy", "a toy whose color is red"),
        ("small sphere", "a toy whose shape is sphere and size is small"),
        ("blue bucket", "a box named crate whose color is blue"),
        ("red", "the color red"),
        ("red room", "a cell whose color is red"),
    ],
)
def test_reasons(home, phrase, reason):
    assert reason in [candidate.reason for candidate in ground(phrase, home).candidates]


def test_an_exact_name_beats_a_description():
    data = toys_spec(toys=0)
    for name in ("small_box", "large_box"):
        data = changed(data, (f"objects/{name}", {"class": "box"}), (f"state/{name}", {"in": "kitchen"}))
    assert [c.symbol.name for c in ground("the box", load_environment(data)).candidates] == ["box"]
    del data["objects"]["box"], data["state"]["box"]
    environment = load_environment(data)
    assert [c.symbol.name for c in ground("the box", environment).candidates] == ["small_box", "large_box"]
    assert [c.symbol.name for c in ground("large box", environment).candidates] == ["large_box"]


def test_every_name_and_synonym_grounds_to_its_symbol():
    for _, data in builtin_environments():
        environment = load_environment(data)
        for symbol in environment.symbols():
            for name in (symbol.name, *environment.vocabulary.synonyms.get(symbol, ())):
                for phrase in (name, f"the {name}", name.upper(), name.replace("_", " ")):
                    found = ground(phrase, environment, kinds=frozenset({symbol.kind}))
                    assert [c.symbol for c in found.candidates] == [symbol]


def test_explicit_environments_have_no_symbols():
    assert ground("a", load_environment(TINY)).candidates == ()


PHRASES = st.lists(
    st.sampled_from(
        ["the", "red", "blue", "dark", "small", "ball", "bucket", "box", "one", "toy", "orange", "is", "&"]
    ),
    max_size=25,
).map(" ".join)


@settings(deadline=None)
@given(PHRASES | st.text(max_size=40))
def test_candidates_are_distinct_and_keep_the_order_of_symbols(home_module, phrase):
    found = [c.symbol for c in ground(phrase, home_module).candidates]
    assert len(set(found)) == len(found)
    order = list(home_module.symbols())
    assert found == sorted(found, key=order.index)


@pytest.fixture(scope="module")
def home_module(home):
    return home
