"""The language beyond the built-in domains, against small hand-written simulations."""

import itertools

import numpy as np
import pytest

from models.logic.formula import Atom, Name
from models.world import WorldError, compile_world, load_environment
from tests.world.worlds import SWITCHES, changed

LAMPS = ("one", "two", "three")
PLACES = ("one", "two", "three", "none")


def outcome(world, action, index):
    """successor -> probability of an action by name; None where it is not enabled."""
    result = world.outcomes(world.actions.index(action), np.array([index]))
    if not result.enabled[0]:
        return None
    return {int(s): float(p) for s, p in zip(result.successor[:, 0], result.probability[:, 0], strict=True) if p}


def states(world):
    """(place, levels, index) of every state of the switches."""
    for number, (by, *levels) in enumerate(itertools.product(PLACES, *[("low", "high")] * 3)):
        assert world.decode(number) == {"robot": {"by": by}} | {
            lamp: {"level": level} for lamp, level in zip(LAMPS, levels, strict=True)
        }
        yield by, levels, number


def expected(by, levels):
    """action -> {(place, levels): probability} by the rules in words."""
    for lamp in LAMPS:
        if by != lamp:
            yield f"go({lamp})", {(lamp, tuple(levels)): 1.0}
    if by == "none":
        return
    yield "flip", {("none", tuple(levels)): 0.3, (by, tuple(levels)): 0.7}
    pressed = [
        "low" if (lamp == by) == (level == "high") else "high" for lamp, level in zip(LAMPS, levels, strict=True)
    ]
    pressed = [p if lamp == by else level for lamp, level, p in zip(LAMPS, levels, pressed, strict=True)]
    if pressed.count("high") <= 2:
        yield f"press({by})", {(by, tuple(pressed)): 1.0}


def check_switches():
    world = compile_world(load_environment(changed(SWITCHES, ("parameters", {"p": 0.3}))))
    index = {(by, tuple(levels)): number for by, levels, number in states(world)}
    valid = world.valid()
    for by, levels, number in states(world):
        assert valid[number] == (levels.count("high") <= 2)
        if valid[number]:
            wanted = {
                name: {index[target]: pytest.approx(chance) for target, chance in chances.items()}
                for name, chances in expected(by, levels)
            }
            actual = {name: outcome(world, name, number) for name in world.actions}
            assert {name: chances for name, chances in actual.items() if chances} == wanted
    atoms = {
        Atom("lit", (Name("two"),)): lambda _by, levels: levels[1] == "high",
        Atom("by", (Name("three"),)): lambda by, _levels: by == "three",
        Atom("idle"): lambda by, _levels: by == "none",
        Atom("alike", (Name("one"), Name("three"))): lambda _by, levels: levels[0] == levels[2],
        Atom("alike", (Name("one"), Name("two"))): lambda _by, _levels: False,
        Atom("painted", (Name("two"), Name("blue"))): lambda _by, _levels: True,
    }
    labels = world.labels(list(atoms))
    for row, holds in zip(labels, atoms.values(), strict=True):
        assert row.tolist() == [holds(by, levels) for by, levels, _ in states(world)]


def test_switches():
    check_switches()


@pytest.mark.parametrize("entries", [1, 4, 8])
def test_what_does_not_fit_a_table_is_computed_alike(monkeypatch, entries):
    monkeypatch.setattr("models.world.algebra.MAX_TABLE", entries)
    monkeypatch.setattr("models.world.actions.MAX_TABLE", entries)
    check_switches()


def test_effects_are_simultaneous():
    swap = {"outcomes": [{"set": {"a.at": "b.at", "b.at": "a.at"}}]}
    data = {
        "name": "swap",
        "kind": "oomdp",
        "domain_spec": {
            "name": "swap",
            "classes": {"spot": {}, "thing": {"state": {"at": "spot"}}},
            "constants": {"a": "thing", "b": "thing"},
            "actions": {"swap": swap},
        },
        "objects": {"left": {"class": "spot"}, "right": {"class": "spot"}},
        "state": {"a": {"at": "left"}, "b": {"at": "right"}},
    }
    world = compile_world(load_environment(data))
    (target,) = outcome(world, "swap", world.initial)
    assert world.decode(target) == {"a": {"at": "right"}, "b": {"at": "left"}}


def test_following_attributes_through_the_state():
    """A chain of boxes: where is the thing in the thing in the thing?"""
    data = {
        "name": "chain",
        "kind": "oomdp",
        "domain_spec": {
            "name": "chain",
            "classes": {"spot": {}, "big": {"state": {"in": "spot"}}, "small": {"state": {"in": "spot | big"}}},
            "functions": {
                "lies": {
                    "arguments": ["x: small", "s: spot"],
                    "is": "(x.in if x.in is spot else x.in.in) == s",
                },
                "inside": {"arguments": ["x: small"], "is": "x.in.in is spot"},
                "together": {"arguments": ["x: small", "y: small"], "is": "x != y and x.in == y.in"},
                "crowded": {"is": "any(b: big; count(x: small; x.in == b) >= 2)"},
                "sorted": {"is": "all(x: small; x.in is big) and not crowded()"},
            },
        },
        "objects": {name: {"class": "spot"} for name in "st"}
        | {name: {"class": "big"} for name in "AB"}
        | {name: {"class": "small"} for name in "xy"},
        "state": {name: {"in": "s"} for name in "ABxy"},
    }
    world = compile_world(load_environment(data))
    assert world.size == 2 * 2 * 4 * 4
    atoms = {
        Atom("lies", (Name("x"), Name("t"))): lambda w: (w[w["x"]] if w["x"] in "AB" else w["x"]) == "t",
        Atom("inside", (Name("y"),)): lambda w: w["y"] in "AB",
        Atom("together", (Name("x"), Name("y"))): lambda w: w["x"] == w["y"],
        Atom("together", (Name("x"), Name("x"))): lambda _w: False,
        Atom("crowded"): lambda w: w["x"] == w["y"] and w["x"] in "AB",
        Atom("sorted"): lambda w: w["x"] != w["y"] and {w["x"], w["y"]} == {"A", "B"},
    }
    labels = world.labels(list(atoms))
    for number in range(world.size):
        where = {name: attributes["in"] for name, attributes in world.decode(number).items()}
        assert labels[:, number].tolist() == [holds(where) for holds in atoms.values()]


def test_probabilities_may_depend_on_the_state():
    data = changed(
        SWITCHES,
        ("domain_spec/actions/flip/outcomes/0/probability", "count(x: lamp; bright(x)) / 4"),
        ("domain_spec/actions/flip/outcomes/1/probability", "1 - count(x: lamp; bright(x)) / 4"),
    )
    world = compile_world(load_environment(data))
    for number_lit in range(3):
        state = {lamp: {"level": "high" if i < number_lit else "low"} for i, lamp in enumerate(LAMPS)}
        chances = outcome(world, "flip", world.encode({"robot": {"by": "one"}, **state}))
        away = world.encode({"robot": {"by": "none"}, **state})
        assert chances.get(away, 0) == pytest.approx(number_lit / 4)
        assert sum(chances.values()) == pytest.approx(1.0)


def test_an_effect_may_be_impossible_where_the_guard_forbids_it():
    hop = {"when": "robot.by.next != none", "outcomes": [{"set": {"robot.by": "robot.by.next"}}]}
    walk = changed(
        SWITCHES,
        ("domain_spec/classes/robot/state/by", "lamp"),
        ("domain_spec/functions/idle", {"is": "false"}),
        ("domain_spec/actions", {"hop": hop}),
        ("state/robot/by", "one"),
    )
    world = compile_world(load_environment(walk))
    enabled = world.outcomes(0).enabled
    assert [bool(enabled[world.encode({"robot": {"by": lamp}})]) for lamp in LAMPS] == [True, True, False]


def test_constants_by_quoted_name_and_environment_values():
    data = changed(
        SWITCHES,
        ("domain_spec/constants/the \u00e9tag\u00e8re", "lamp"),
        ("domain_spec/functions/special", {"is": '"the \u00e9tag\u00e8re".level == high'}),
        ("values", {"color": ["teal"]}),
        ("objects/one/attributes/color", "teal"),
        ("state/the \u00e9tag\u00e8re", {"level": "low"}),
    )
    environment = load_environment(data)
    world = compile_world(environment)
    assert 'go("the \u00e9tag\u00e8re")' in world.actions
    assert not world.labels([Atom("special")], np.array([world.initial]))[0, 0]
    assert [symbol.name for symbol in environment.symbols("color")] == ["red", "blue", "teal"]


def test_static_guards_drop_actions():
    data = changed(SWITCHES, ("domain_spec/actions/press/when", "robot.by == x and x.color == red"))
    world = compile_world(load_environment(data))
    assert [name for name in world.actions if name.startswith("press")] == ["press(one)", "press(three)"]


def test_numbers_that_are_not_finite_stay_where_the_action_is_impossible():
    share = "1 / count(x: lamp; bright(x))"
    data = changed(
        SWITCHES,
        ("domain_spec/actions/flip/when", "robot.by is lamp and any(x: lamp; bright(x))"),
        ("domain_spec/actions/flip/outcomes/0/probability", share),
        ("domain_spec/actions/flip/outcomes/1/probability", f"1 - {share}"),
    )
    world = compile_world(load_environment(data))
    flip = world.outcomes(world.actions.index("flip"))
    assert np.isfinite(flip.probability).all()
    two_lit = world.encode({"robot": {"by": "one"}, "one": {"level": "high"}})
    assert flip.probability[:, two_lit].tolist() == [0.5, 0.5]


def test_asking_for_many_labels_never_runs_out_of_work():
    world = compile_world(load_environment(SWITCHES))
    atoms = [Atom("alike", (Name(x), Name(y))) for x in LAMPS for y in LAMPS]
    for _ in range(20_000 // len(atoms)):
        world.labels(atoms, np.array([world.initial]))


def test_a_proposition_beyond_the_limit_of_work_is_refused():
    lamps = {f"l{i}": {"class": "lamp"} for i in range(60)}
    state = {"robot": {"by": "none"}} | {name: {"level": "low"} for name in lamps}
    heavy = "all(a: lamp; all(b: lamp; all(c: lamp; a.level == b.level or b.level == c.level)))"
    data = changed(
        SWITCHES,
        ("objects", {name: lamps[name] for name in list(lamps)[:30]}),
        ("state", {name: state[name] for name in ["robot", *list(lamps)[:30]]}),
        ("domain_spec/functions/heavy", {"is": heavy}),
    )
    world = compile_world(load_environment(data))
    with pytest.raises(WorldError, match="heavy: the world takes too much work"):
        world.labels([Atom("heavy")], np.array([world.initial]))
