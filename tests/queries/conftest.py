"""A small world with homonyms, made for the tests of the CQ-LTL algorithm."""

from __future__ import annotations

import pytest

from models.world import Environment, load_environment

DOMAIN = {
    "name": "store",
    "attributes": {"color": ["red", "blue", "orange"]},
    "classes": {
        "place": {},
        "robot": {"state": {"at": "place"}},
        "thing": {"static": {"color": "color"}, "state": {"on": "place"}},
        "bin": {"state": {"on": "place"}},
    },
    "constants": {"robot": "robot"},
    "functions": {
        "at": {"arguments": ["x: robot", "p: place"], "is": "x.at == p", "says": "{x} is at {p}"},
        "lies": {"arguments": ["x: thing | bin", "p: place"], "is": "x.on == p", "says": "{x} lies on {p}"},
        "by": {"arguments": ["x: thing", "b: bin"], "is": "x.on == b.on", "says": "{x} is by {b}"},
        "about": {"arguments": ["x: thing | color"], "is": "x is thing", "says": "the talk is about {x}"},
        "colored": {"arguments": ["x: thing", "v: color"], "is": "x.color == v", "says": "{x} is {v}"},
    },
    "actions": {"wait": {"outcomes": [{}]}},
}


@pytest.fixture(scope="session")
def store() -> Environment:
    """Places p, q, a "long table"; things ball, orange, sachet (called "bag"); bins crate and sack (called "bag")."""
    color = {"ball": "red", "orange": "orange", "sachet": "blue"}
    return load_environment(
        {
            "name": "store",
            "kind": "oomdp",
            "domain_spec": DOMAIN,
            "objects": {
                "p": {"class": "place"},
                "q": {"class": "place"},
                "table": {"class": "place", "synonyms": ["long table"]},
                "ball": {"class": "thing", "attributes": {"color": color["ball"]}},
                "orange": {"class": "thing", "attributes": {"color": color["orange"]}},
                "sachet": {"class": "thing", "synonyms": ["bag"], "attributes": {"color": color["sachet"]}},
                "crate": {"class": "bin"},
                "sack": {"class": "bin", "synonyms": ["bag"]},
            },
            "state": {
                "robot": {"at": "p"},
                **{name: {"on": "p"} for name in ("ball", "orange", "sachet", "crate", "sack")},
            },
        }
    )
