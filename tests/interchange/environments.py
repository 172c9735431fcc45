"""Environments for the tests of this folder."""

from __future__ import annotations

from typing import Any

from models.world import Environment, load_environment, navigation_spec, toys_spec
from tests.planning.doubles import ArrayWorld
from tests.world.worlds import SWITCHES, changed

CHAIN = {
    "name": "chain",
    "kind": "oomdp",
    "domain_spec": {
        "name": "chain",
        "parameters": {"p": {"default": 0.25}},
        "classes": {"spot": {}, "big": {"state": {"in": "spot"}}, "small": {"state": {"in": "spot | big"}}},
        "functions": {
            "lies": {"arguments": ["x: small", "s: spot"], "is": "(x.in if x.in is spot else x.in.in) == s"},
            "together": {"arguments": ["x: small", "y: small"], "is": "x != y and x.in == y.in"},
            "near": {
                "arguments": ["x: small", "y: small"],
                "is": "(x.in if x.in is spot else x.in.in) == (y.in if y.in is spot else y.in.in)",
            },
            "crowded": {"is": "any(b: big; count(x: small; x.in == b) >= 2)"},
            "same": {"arguments": ["x: small", "y: small"], "is": "(x.in is spot) == (y.in is spot)"},
            "many": {"is": "count(x: small; x.in is big) / 2 + 1 > 1.5 - p"},
        },
        "actions": {
            "carry": {
                "arguments": ["b: big", "s: spot"],
                "when": "b.in != s",
                "outcomes": [{"probability": "1 - p", "set": {"b.in": "s"}}, {"probability": "p"}],
            },
            "put": {
                "arguments": ["x: small", "t: spot | big"],
                "when": "x.in != t",
                "outcomes": [{"set": {"x.in": "t"}}],
            },
            "follow": {
                "arguments": ["x: small"],
                "when": "x.in is big",
                "outcomes": [
                    {"probability": "count(y: small; y.in is big) / 2", "set": {"x.in": "x.in.in"}},
                    {"probability": "1 - count(y: small; y.in is big) / 2", "set": {"x.in": "s"}},
                ],
            },
            "swap": {
                "arguments": ["x: small", "y: small"],
                "when": "x != y",
                "outcomes": [{"set": {"x.in": "y.in", "y.in": "x.in"}}],
            },
        },
        "constants": {"s": "spot"},
        "constraints": ["not all(x: small; x.in == s)"],
    },
    "objects": {name: {"class": "spot"} for name in ("t", "u")}
    | {name: {"class": "big"} for name in "AB"}
    | {name: {"class": "small"} for name in "xy"},
    "state": {"A": {"in": "s"}, "B": {"in": "t"}, "x": {"in": "s"}, "y": {"in": "A"}},
}
"""Small things in big things on spots; attributes of attributes, counts, a constraint, effects of several kinds."""

AWKWARD = {
    "name": "awkward",
    "kind": "oomdp",
    "domain_spec": {
        "name": "awkward",
        "attributes": {"mode": ["F", "true-ish", "\u00e9t\u00e9"]},
        "classes": {"init": {"state": {"mode": "mode | none"}}},
        "functions": {"label": {"arguments": ["x: init", "m: mode"], "is": "x.mode == m"}},
        "actions": {
            "stay": {"arguments": ["x: init"], "when": "x.mode == F", "outcomes": [{"set": {"x.mode": '"true-ish"'}}]},
            "module": {
                "arguments": ["x: init"],
                "when": 'x.mode == "true-ish"',
                "outcomes": [{"set": {"x.mode": '"\u00e9t\u00e9"'}}],
            },
        },
    },
    "objects": {"a b": {"class": "init"}, "a_b": {"class": "init"}, "7 up \u2603": {"class": "init"}},
    "state": {"a b": {"mode": "F"}, "a_b": {"mode": "F"}, "7 up \u2603": {"mode": "none"}},
}
"""Names that PRISM does not take, and states in which nothing is possible."""

SINGLE = {
    "name": "single",
    "kind": "oomdp",
    "domain_spec": {
        "name": "single",
        "classes": {"spot": {}, "thing": {"state": {"in": "spot"}}},
        "constants": {"x": "thing", "s": "spot"},
        "functions": {"there": {"is": "x.in == s"}},
        "actions": {"wait": {"outcomes": [{}]}},
    },
    "state": {"x": {"in": "s"}},
}
"""One state."""

OOMDP: dict[str, dict[str, Any]] = {
    "toys": toys_spec(slip=0.1),
    "toys without slip": toys_spec(),
    "two toys": toys_spec(toys=2, slip=0.35),
    "walls": toys_spec(columns=3, rows=2, slip=0.2, walls=[("kitchen", "bedroom")]),
    "two toys on a grid": toys_spec(columns=2, rows=2, toys=2, slip=0.55),
    "navigation": navigation_spec(columns=4, rows=3, slip=0.1, blocked=[(2, 2)]),
    "long navigation": navigation_spec(columns=9, rows=2, landmarks={"home": (5, 1)}, blocked=[(2, 2), (6, 1)]),
    "switches": changed(SWITCHES, ("parameters", {"p": 0.3})),
    "sure switches": changed(SWITCHES, ("parameters", {"p": 1.0})),
    "chain": CHAIN,
    "awkward": AWKWARD,
    "single": SINGLE,
}


def loaded(name: str) -> Environment:
    """One of OOMDP."""
    return load_environment(OOMDP[name])


def explicit_spec(world: ArrayWorld) -> dict[str, Any]:
    """A double of the planning tests as the data of an explicit environment."""
    return {
        "name": "random",
        "kind": "explicit",
        "states": world.size,
        "initial": world.initial,
        "labels": {name: sorted(states) for name, states in world.holds.items()},
        "transitions": [
            {"from": state, "action": action, "to": [[target, chance] for target, chance in outcomes.items()]}
            for state, moves in world.transitions.items()
            for action, outcomes in moves.items()
        ],
    }
