"""Every kind of wrong data is refused with the exact place."""

import time
from unittest.mock import patch

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from models.logic.formula import Atom, Name
from models.world import WorldError, builtin_environments, compile_world, load_environment, toys_spec
from models.world.limits import MAX_ARGUMENTS, MAX_DECLARATIONS, MAX_NAME, MAX_OBJECTS
from tests.world.worlds import REMOVE, SWITCHES, TINY, changed

D = "domain_spec/"
LIT = f"{D}functions/lit/"
FLIP = f"{D}actions/flip/"


def faults(data):
    """pointer -> detail of each fault of refused data."""
    with pytest.raises(WorldError) as caught:
        load_environment(data)
    error = caught.value
    assert error.slug == "invalid-environment"
    assert error.places
    assert error.places[0].detail in error.detail
    assert error.places[0].pointer in error.detail
    return {place.pointer: place.detail for place in error.places}


SHAPES = [
    ("name", REMOVE, "/name", "field required"),
    ("name", 7, "/name", "valid string"),
    ("name", True, "/name", "true is not text: YAML reads on, off, yes and no as true and false"),
    ("kind", REMOVE, "/kind", "the kind is missing: give oomdp or explicit"),
    ("kind", "pomdp", "/kind", "there is no such kind of environment: give oomdp or explicit"),
    ("kind", ["oomdp"], "/kind", "give oomdp or explicit"),
    ("colour", "red", "/colour", "extra"),
    ("objects/one/class", REMOVE, "/objects/one/class", "required"),
    ("objects/one/colour", "red", "/objects/one/colour", "extra"),
    (f"{D}actions/flip/outcomes", [], "/domain_spec/actions/flip/outcomes", "at least 1"),
    (f"{FLIP}outcomes/0/probability", None, "/domain_spec/actions/flip/outcomes/0/probability", "finite number"),
    (f"{FLIP}outcomes/0/probability", float("inf"), "/domain_spec/actions/flip/outcomes/0/probability", "finite"),
    (f"{FLIP}outcomes/0/set", {"robot.by": ["x"]}, "/domain_spec/actions/flip/outcomes/0/set/robot.by", "is text"),
    (f"{FLIP}when", 10**400, "/domain_spec/actions/flip/when", "finite number"),
    (f"{D}parameters/p", 0.5, "/domain_spec/parameters/p", "dictionary"),
    (f"{D}parameters/p/default", "0.5", "/domain_spec/parameters/p/default", "number"),
    (f"{D}parameters/p/default", float("nan"), "/domain_spec/parameters/p/default", "finite"),
    (f"{D}classes", REMOVE, "/domain_spec/classes", "required"),
    ("state/robot", "none", "/state/robot", "dictionary"),
    ("domain", "toys", "", "exactly one of domain and domain_spec"),
    ("domain_spec", REMOVE, "", "exactly one of domain and domain_spec"),
]

DOMAINS = [
    (f"{D}name", "", "name", "empty"),
    (f"{D}parameters/p/default", 2.0, "parameters/p/default", "outside"),
    (f"{D}parameters/q q", {"default": 1.0}, "parameters/q q", "not a name"),
    (f"{D}attributes/level/2", "low", "attributes/level/2", "listed twice"),
    (f"{D}attributes/level/2", "none", "attributes/level/2", "none"),
    (f"{D}attributes/level/2", " x", "attributes/level/2", "space"),
    (f"{D}attributes/level/2", "x" * (MAX_NAME + 1), "attributes/level/2", "at most"),
    (f"{D}attributes/level/2", 'a"b', "attributes/level/2", "quotes"),
    (f"{D}attributes/lamp", ["x"], "attributes/lamp", "class too"),
    (f"{D}ordered", {"levle": {}}, "ordered/levle", "did you mean level"),
    (f"{D}ordered", {"lamp": {}}, "ordered/lamp", "no attribute type lamp"),
    (f"{D}ordered", {"level": {"less": ["low"]}}, "ordered/level/less/0", "low is a value of level itself"),
    (f"{D}ordered", {"level": {"more": ["tall", ""]}}, "ordered/level/more/1", "empty"),
    (f"{D}ordered", {"level": {"less": ["odd"], "more": ["odd"]}}, "ordered/level/more/0", "both less and more"),
    (f"{D}ordered", {"level": {"more": [f"m{i}" for i in range(51)]}}, "ordered/level/more", "at most 50"),
    (f"{D}classes/true", {}, "classes/true", "not a name"),
    (f"{D}classes/lamp/static/colour", "colour", "classes/lamp/static/colour", "did you mean color"),
    (f"{D}classes/lamp/static/level", "level", "classes/lamp/state/level", "static attribute too"),
    (f"{D}classes/lamp/static/a-b", "level", "classes/lamp/static/a-b", "not a name"),
    (f"{D}constants/robot", "robo", "constants/robot", "did you mean robot"),
    (f"{D}constants/none", "robot", "constants/none", "none"),
    (f"{D}define/lit", {"is": "true"}, "functions/lit", "definition too"),
    (f"{LIT}arguments/0", "x", "functions/lit/arguments/0", "name: kinds"),
    (f"{LIT}arguments/0", "x: lamb", "functions/lit/arguments/0", "did you mean lamp"),
    (f"{LIT}arguments/1", "x: lamp", "functions/lit/arguments/1", "two arguments"),
    (f"{LIT}arguments", ["x: lamp"] * (MAX_ARGUMENTS + 1), "functions/lit/arguments", "at most"),
    (f"{LIT}is", "bright(x", "functions/lit/is", "too early"),
    (f"{LIT}is", "x.level", "functions/lit/is", "must be true or false"),
    (f"{LIT}is", "1 + 1", "functions/lit/is", "must be true or false, not number"),
    (f"{LIT}is", "x.levl == high", "functions/lit/is", "did you mean level"),
    (f"{LIT}is", "x.level == red", "functions/lit/is", "never equal"),
    (f"{LIT}is", "x.level == hihg", "functions/lit/is", "nothing is called hihg"),
    (f"{LIT}is", "x.level == highest", "functions/lit/is", "nothing is called highest (did you mean high?)"),
    (f"{LIT}is", "x.level == HIGH", "functions/lit/is", "nothing is called HIGH (did you mean high?)"),
    (f"{LIT}is", "True", "functions/lit/is", "nothing is called True (did you mean true?)"),
    (f"{LIT}is", "brite", "functions/lit/is", "nothing is called brite (did you mean bright?)"),
    (f"{LIT}is", "bright", "functions/lit/is", "bright is a definition or function: write bright(x)"),
    (f"{LIT}is", "idle", "functions/lit/is", "idle is a definition or function: write idle()"),
    (f"{LIT}is", "x == lamp", "functions/lit/is", "lamp is a kind, not an object or value"),
    (f"{LIT}is", "x.level == level.hig", "functions/lit/is", "level has no value hig (did you mean high?)"),
    (f"{LIT}is", "x.level is high", "functions/lit/is", "high is not a kind: write == high"),
    (f"{LIT}is", "x.level = high", "functions/lit/is", "write == to compare"),
    (f"{LIT}is", "brigt(x)", "functions/lit/is", "did you mean bright"),
    (f"{LIT}is", "bright(x, x)", "functions/lit/is", "1 arguments, not 2"),
    (f"{LIT}is", "bright(robot)", "functions/lit/is", "must be lamp, but may be robot"),
    (f"{LIT}is", "x and true", "functions/lit/is", "must be true or false, not lamp"),
    (f"{LIT}is", "x < x", "functions/lit/is", "must be number"),
    (f"{LIT}is", "x is robot", "functions/lit/is", "never robot"),
    (f"{LIT}is", "x is lampe", "functions/lit/is", "did you mean lamp"),
    (f"{LIT}is", "any(y: lampe; true)", "functions/lit/is", "did you mean lamp"),
    (f"{LIT}is", "p.level == high", "functions/lit/is", "object or value is needed"),
    (f"{LIT}is", "(x if true else 1) == x", "functions/lit/is", "one branch"),
    (f"{LIT}is", "x.level == none", "functions/lit/is", "never equal"),
    (f"{LIT}says", "{x} is\non", "functions/lit/says", "line breaks"),
    (f"{LIT}says", "x" * 1_001, "functions/lit/says", "at most 1000 characters"),
    (f"{LIT}display", ["{x}_on"] * 51, "functions/lit/display", "at most 50"),
    (f"{D}classes/lamp/words", ["a\nb"], "classes/lamp/words/0", "control"),
    (f"{LIT}says", "{y} is on", "functions/lit/says", "no argument"),
    (f"{LIT}denies", "{y} is off", "functions/lit/denies", "no argument"),
    (f"{LIT}display/0", "on", "functions/lit/display/0", "exactly once"),
    (f"{D}functions/alike/display", ["{x}{y}"], "functions/alike/display/0", "a word between"),
    (f"{D}define/bright/is", "lit(x)", "functions/lit/is", "may not call themselves: bright -> lit -> bright"),
    (f"{FLIP}when", "robot.by", "actions/flip/when", "must be true or false"),
    (f"{FLIP}outcomes/0/probability", "true", "actions/flip/outcomes/0/probability", "must be number"),
    (f"{FLIP}outcomes/0/set", {"robot": "none"}, "actions/flip/outcomes/0/set/robot", "object.attribute"),
    (f"{FLIP}outcomes/0/set", {"robo.by": "none"}, "actions/flip/outcomes/0/set/robo.by", "did you mean robot"),
    (f"{FLIP}outcomes/0/set", {"robot.bye": "none"}, "actions/flip/outcomes/0/set/robot.bye", "did you mean by"),
    (f"{FLIP}outcomes/0/set", {"robot.by": "high"}, "actions/flip/outcomes/0/set/robot.by", "never level"),
    (f"{FLIP}outcomes/0/set", {"robot.by": "x"}, "actions/flip/outcomes/0/set/robot.by", "nothing is called x"),
    (f"{D}actions/press/outcomes/0/set", {"x.color": "red"}, "actions/press/outcomes/0/set/x.color", "no state"),
    (f"{D}constraints/0", "robot.by", "constraints/0", "must be true or false"),
    (f"{D}constraints", ["true"] * (MAX_DECLARATIONS + 1), "constraints", "at most"),
    (f"{FLIP}outcomes/0/probability", "p + 0.1", "actions/flip/outcomes", "do not sum to 1"),
    (f"{FLIP}outcomes/0/probability", "p - 1", "actions/flip/outcomes/0/probability", "not between 0 and 1"),
    (f"{FLIP}outcomes/0/probability", "1 / (p - p)", "actions/flip/outcomes/0/probability", "not between 0 and 1"),
    (
        f"{FLIP}outcomes/0/probability",
        "0.5 if robot.by.color == red else 0.6",
        "actions/flip/outcomes",
        "do not sum to 1 when robot.by is two",
    ),
    (f"{FLIP}outcomes/0/set", {"robot.by": "robot.by.next"}, "actions/flip/outcomes/0/set", None),
    (
        f"{D}actions/press/outcomes/0/set",
        {"x.level": "x.next.level"},
        "actions/press/outcomes/0/set/x.level",
        "press(three): three.level would become something it cannot be when robot.by is three",
    ),
    (
        f"{D}actions/two",
        {"arguments": ["x: lamp", "y: lamp"], "outcomes": [{"set": {"x.level": "low", "y.level": "high"}}]},
        "actions/two",
        "set twice",
    ),
]  # fmt: skip

ENVIRONMENTS = [
    ("name", "", "/name", "empty"),
    ("name", "a\nb", "/name", "control"),
    ("name", "\ud800", "/name", "control"),
    ("name", "a ", "/name", "end with a space"),
    ("name", "a/b", "/name", "part of a web address"),
    ("name", "a\\b", "/name", "part of a web address"),
    ("name", ".", "/name", "part of a web address"),
    ("name", "..", "/name", "part of a web address"),
    ("parameters", {"q": 0.5}, "/parameters/q", "no parameter q"),
    ("parameters", {"p": 1.5}, "/parameters/p", "between 0 and 1, not 1.5"),
    ("values", {"colour": ["teal"]}, "/values/colour", "did you mean color"),
    ("values", {"color": ["teal", "teal"]}, "/values/color/1", "listed twice"),
    ("objects/one/class", "lamb", "/objects/one/class", "did you mean lamp"),
    ("objects/robot", {"class": "lamp"}, "/objects/robot/class", "robot already"),
    ("objects/none", {"class": "lamp"}, "/objects/none", "none"),
    ("objects/one/synonyms", [""], "/objects/one/synonyms/0", "empty"),
    ("objects/one/attributes/colour", "red", "/objects/one/attributes/colour", "did you mean color"),
    ("objects/one/attributes/color", "rad", "/objects/one/attributes/color", "did you mean red"),
    ("objects/one/attributes/next", "robot", "/objects/one/attributes/next", "must be lamp"),
    ("objects", {str(i): {"class": "lamp"} for i in range(MAX_OBJECTS + 1)}, "/objects", "at most"),
    ("state/on", {"level": "low"}, "/state/on", "did you mean one"),
    ("state/one/levle", "low", "/state/one/levle", "did you mean level"),
    ("state/one/level", "lo", "/state/one/level", "did you mean low"),
    ("state/robot/by", "robot", "/state/robot/by", "cannot be robot"),
    ("state/two", REMOVE, "/state", "level of two is missing"),
    ("state/two/level", REMOVE, "/state/two", "level of two is missing"),
]


@pytest.mark.parametrize("data", [SWITCHES, TINY])
@pytest.mark.parametrize("name", ["Küche 2", "東京", "a.b", "...", "50% off?", "H&M #1"])
def test_names_that_fit_an_address(data, name):
    assert load_environment(changed(data, ("name", name))).name == name


@pytest.mark.parametrize("name", ["a/b", "a\\b", ".", "..", " a", "a\n"])
def test_names_of_explicit_environments_fit_an_address_too(name):
    assert list(faults(changed(TINY, ("name", name)))) == ["/name"]


@pytest.mark.parametrize(("path", "value", "pointer", "detail"), SHAPES)
def test_wrong_shapes(path, value, pointer, detail):
    found = faults(changed(SWITCHES, (path, value)))
    assert list(found) == [pointer]
    assert detail in found[pointer]


@pytest.mark.parametrize(("path", "value", "pointer", "detail"), DOMAINS)
def test_wrong_domains(path, value, pointer, detail):
    data = changed(SWITCHES, (path, value))
    if detail is None:  # three.next is none, which robot.by may be
        load_environment(data)
        return
    found = faults(data)
    assert list(found) == [f"/domain_spec/{pointer}"]
    assert detail in found[f"/domain_spec/{pointer}"]


@pytest.mark.parametrize(("path", "value", "pointer", "detail"), ENVIRONMENTS)
def test_wrong_environments(path, value, pointer, detail):
    found = faults(changed(SWITCHES, (path, value)))
    assert pointer in found
    assert detail in found[pointer]
    assert list(found) == [pointer] or path == "objects"


def test_the_initial_state_keeps_the_constraints():
    data = changed(SWITCHES, ("state/one/level", "high"), ("state/two/level", "high"))
    assert faults(data) == {"/state": "the initial state breaks a constraint of the domain"}


def test_an_unknown_builtin_domain():
    assert faults(changed(toys_spec(), ("domain", "toy"))) == {
        "/domain": "there is no built-in domain toy (did you mean toys?)"
    }


FORMS = [
    (f"{FLIP}outcomes/0/probability", 0.5, "1/2"),
    (f"{FLIP}outcomes", [{"probability": 1}], [{"probability": "1"}]),
    (f"{FLIP}outcomes", [{"probability": 1e-7}, {"probability": "1 - 0.0000001"}], None),
    (f"{FLIP}when", True, "true"),
    (f"{FLIP}when", False, "false"),
    (f"{LIT}is", True, "true"),
    (f"{D}define/bright/is", False, "false"),
    (f"{D}constraints", [True], ["true"]),
]  # fmt: skip


@pytest.mark.parametrize(("path", "value", "text"), FORMS)
def test_numbers_and_truth_values_are_expressions(path, value, text):
    world = compile_world(load_environment(changed(SWITCHES, (path, value))))
    if text is None:
        return
    same = compile_world(load_environment(changed(SWITCHES, (path, text))))
    assert (world.actions, world.valid().tolist()) == (same.actions, same.valid().tolist())
    lit = [Atom("lit", (Name("one"),))]
    assert world.labels(lit).tolist() == same.labels(lit).tolist()
    for action in range(len(world.actions)):
        assert world.outcomes(action).enabled.tolist() == same.outcomes(action).enabled.tolist()
        assert world.outcomes(action).probability.tolist() == same.outcomes(action).probability.tolist()


def test_a_number_is_still_checked_as_an_expression():
    found = faults(changed(SWITCHES, (f"{FLIP}when", 1), (f"{FLIP}outcomes/0/set", {"robot.by": 2})))
    assert found == {
        "/domain_spec/actions/flip/when": "must be true or false, not number",
        "/domain_spec/actions/flip/outcomes/0/set/robot.by": "robot.by may be lamp or none, never number",
    }


def test_several_faults_come_out_together():
    data = changed(
        SWITCHES,
        (f"{LIT}is", "x.levl == high"),
        (f"{FLIP}when", "robot.bye is lamp"),
        (f"{D}constraints/0", "count(x: lamp; bright(x)) and true"),
    )
    assert list(faults(data)) == [
        "/domain_spec/functions/lit/is",
        "/domain_spec/actions/flip/when",
        "/domain_spec/constraints/0",
    ]


def test_a_broken_definition_is_reported_once_and_not_where_it_is_used():
    data = changed(SWITCHES, (f"{D}define/bright/is", "x.brightness == high"))
    assert list(faults(data)) == ["/domain_spec/define/bright/is"]


def test_pointers_escape_keys():
    data = changed(SWITCHES, ("objects/one/class", "lamp"))
    data["objects"]["a/b~c"] = {"class": "lamb"}
    assert list(faults(data)) == ["/objects/a~1b~0c/class"]


def test_a_value_that_means_two_things_must_be_qualified():
    ambiguous = changed(SWITCHES, (f"{D}attributes/color/2", "high"))
    assert "high means several things" in faults(ambiguous)["/domain_spec/define/bright/is"]
    load_environment(
        changed(
            ambiguous,
            (f"{D}define/bright/is", "x.level == level.high"),
            (f"{D}actions/press/outcomes/0/set", {"x.level": "level.low if bright(x) else level.high"}),
        )
    )


def test_deep_definitions_are_refused():
    chain = {f"d{i}": {"is": f"d{i + 1}()"} for i in range(150)} | {"d150": {"is": "true"}}
    found = faults(changed(SWITCHES, (f"{D}define", {**chain, "bright": SWITCHES["domain_spec"]["define"]["bright"]})))
    assert all("deep" in detail for detail in found.values())


def test_definitions_that_double_do_not_blow_up():
    """Written out, d0 has 2 ** 60 calls."""
    double = {f"d{i}": {"arguments": ["x: lamp"], "is": f"d{i + 1}(x) and d{i + 1}(x)"} for i in range(30)}
    bright = {"arguments": ["x: lamp"], "is": "x.level == high"}
    define = {**double, "d30": bright, "bright": bright}
    load_environment(changed(SWITCHES, (f"{D}define", define), (f"{LIT}is", "d0(x)")))


def test_nested_quantifiers_run_out_of_work():
    nested = "all(a: lamp; all(b: lamp; all(c: lamp; all(d: lamp; a.level == b.level and c.level == d.level))))"
    lamps = {f"l{i}": {"class": "lamp"} for i in range(60)}
    state = {"robot": {"by": "none"}} | {name: {"level": "low"} for name in lamps}
    data = changed(SWITCHES, ("objects", lamps), ("state", state), (f"{D}constraints/0", nested))
    assert "too much work" in faults(data)[""]


def test_too_many_groundings_are_refused():
    lamps = {f"l{i}": {"class": "lamp"} for i in range(40)}
    state = {"robot": {"by": "none"}} | {name: {"level": "low"} for name in lamps}
    action = {"arguments": ["a: lamp", "b: lamp", "c: lamp"], "outcomes": [{}]}
    data = changed(SWITCHES, ("objects", lamps), ("state", state), (f"{D}actions/three", action))
    assert "groundings" in faults(data)["/domain_spec/actions/three"]


EXPLICIT = [
    ("states", 0, ["/states"]),
    ("states", 10**9, ["/states"]),
    ("states", "3", ["/states"]),
    ("initial", 3, ["/initial"]),
    ("initial", -1, ["/initial"]),
    ("labels/a/0", 3, ["/labels/a/0"]),
    ("labels/a/0", -1, ["/labels/a/0"]),
    ("labels/", [0], ["/labels/"]),
    ("transitions/0/from", 3, ["/transitions/0/from"]),
    ("transitions/0/action", "", ["/transitions/0/action"]),
    ("transitions/0/to/0", [1], ["/transitions/0/to/0"]),
    ("transitions/0/to/0", [1, 0.9, 0], ["/transitions/0/to/0"]),
    ("transitions/0/to/0", [3, 0.9], ["/transitions/0/to/0/0"]),
    ("transitions/0/to/0", [0.5, 0.9], ["/transitions/0/to/0/0"]),
    ("transitions/0/to/0/1", 0.8, ["/transitions/0/to"]),
    ("transitions/0/to/0/1", -0.9, ["/transitions/0/to/0/1", "/transitions/0/to"]),
    ("transitions/0/to", [], ["/transitions/0/to"]),
    ("transitions/3", {"from": 0, "action": "go", "to": [[0, 1.0]]}, ["/transitions/3"]),
    ("transitions/0/extra", 1, ["/transitions/0/extra"]),
]


@pytest.mark.parametrize(("path", "value", "pointers"), EXPLICIT)
def test_wrong_explicit_environments(path, value, pointers):
    assert list(faults(changed(TINY, (path, value)))) == pointers


def test_many_outcomes_of_one_transition_are_quick():
    wide = {"from": 0, "action": "go", "to": [[i % 2, 1 / 4_096] for i in range(4_096)]}
    world = compile_world(load_environment(changed(TINY, ("states", 4_096), ("transitions", [wide]))))
    assert world.outcomes(0).probability[:, 0].tolist() == [0.5, 0.5]


def test_a_domain_cannot_hold_any_amount_of_text():
    action = {"outcomes": [{"probability": "0" * 900}] * 200}
    assert (
        "characters together" in faults(changed(SWITCHES, (f"{D}actions", {"a": action, "b": action})))["/domain_spec"]
    )


HEAVY = {
    "chains over many variables": {"when": "x.in.in.in.in.in.in.in.in.in.in.in.in.in.in.in.in != y"},
    "tests of many kinds": {"when": " and ".join(["x.in.in is not cell"] * 40)},
    "checks of large tables": {
        "when": "x != y",
        "outcomes": [{"probability": " + ".join(f"(0.001 * {i} if x.in == y.in else 0)" for i in range(24))}],
    },
}


@pytest.mark.parametrize("action", HEAVY.values(), ids=HEAVY)
def test_work_is_counted_where_it_is_done(action):
    """Each of these took half a minute or more when only array operations counted."""
    things = {f"b{i}": {"class": "thing"} for i in range(60)}
    domain = {
        "name": "heavy",
        "classes": {
            "cell": {"static": dict.fromkeys(("north", "south", "east", "west"), "cell")},
            "thing": {"state": {"in": "cell | thing"}},
        },
        "actions": {"a": {"arguments": ["x: thing", "y: thing"], "outcomes": [{}], **action}},
    }
    data = {
        "name": "heavy",
        "kind": "oomdp",
        "domain_spec": domain,
        "grid": {"class": "cell", "map": ["." * 30] * 30},
        "objects": things,
        "state": {name: {"in": "cell_1_1"} for name in things},
    }
    before = time.process_time()
    assert "too much work" in faults(data)["/domain_spec/actions/a"]
    assert time.process_time() - before < 10


def test_lone_surrogates_do_not_reach_a_message():
    for data in (changed(TINY, ("labels/\ud800", [0])), changed(SWITCHES, ("objects/one/class", "\ud800"))):
        for pointer, detail in faults(data).items():
            (pointer + detail).encode("utf-8")


def test_hints_for_many_long_names_are_quick():
    names = ["".join("abcdefgh"[(i * j) % 8] for j in range(1, 96)) + str(i) for i in range(2_000)]
    wrong = {name: {"class": "lamp", "attributes": {"color": name[::-1]}} for name in names[:60]}
    before = time.process_time()
    assert len(faults(changed(SWITCHES, ("values", {"color": names}), ("objects", wrong)))) == 50
    assert time.process_time() - before < 10


def test_explicit_environments_cannot_fill_the_memory():
    wide = [{"from": i, "action": "go", "to": [[0, 0.5], [1, 0.5]]} for i in range(20)]
    data = changed(TINY, ("states", 1_000_000), ("transitions", wide))
    with patch("models.world.explicit.MAX_EXPLICIT_OUTCOMES", 39):
        assert "more than 39 outcomes" in faults(data)["/transitions"]


JSON = st.recursive(
    st.none() | st.booleans() | st.integers() | st.floats(allow_nan=True) | st.text(max_size=8),
    lambda inner: st.lists(inner, max_size=3) | st.dictionaries(st.text(max_size=8), inner, max_size=3),
    max_leaves=8,
)


def _paths(data, path=()):
    yield path
    items = data.items() if isinstance(data, dict) else enumerate(data) if isinstance(data, list) else ()
    for key, value in items:
        yield from _paths(value, (*path, key))


PLACES = [(index, path) for index, data in enumerate((SWITCHES, TINY)) for path in _paths(data) if path]


@settings(max_examples=100, deadline=None)
@given(st.sampled_from(PLACES), JSON)
def test_anything_anywhere_is_loaded_or_refused(place, value):
    index, path = place
    data = changed((SWITCHES, TINY)[index])
    target = data
    for part in path[:-1]:
        target = target[part]
    target[path[-1]] = value
    try:
        load_environment(data)
    except WorldError:
        faults(data)


@pytest.mark.parametrize("value", [None, [], "toys", 3, {}])
def test_not_even_an_object(value):
    with pytest.raises(WorldError):
        load_environment(value)


@pytest.mark.parametrize(("name", "data"), builtin_environments())
def test_builtin_environments_load(name, data):
    assert load_environment(data).name == name


def test_a_flood_of_faults_is_cut_short():
    lamps = {f"lamp number {i}": {"class": "lamb", "attributes": {"colour": "x"}} for i in range(4_000)}
    found = faults(changed(SWITCHES, ("objects", lamps)))
    assert len(found) == 50


def test_long_names_do_not_make_long_messages():
    data = changed(SWITCHES, ("state", {"x" * 100_000: {}}))
    with pytest.raises(WorldError) as caught:
        load_environment(data)
    assert len(caught.value.detail) < 2_000
    assert all(len(place.detail) < 500 for place in caught.value.places)
