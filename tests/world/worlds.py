"""Small domains for tests, and how to change one thing in them."""

from __future__ import annotations

import copy

SWITCHES = {
    "name": "switches",
    "kind": "oomdp",
    "domain_spec": {
        "name": "switches",
        "parameters": {"p": {"default": 0.5, "minimum": 0.0, "maximum": 1.0}},
        "attributes": {"level": ["low", "high"], "color": ["red", "blue"]},
        "classes": {
            "robot": {"state": {"by": "lamp | none"}},
            "lamp": {"static": {"color": "color", "next": "lamp"}, "state": {"level": "level"}},
        },
        "constants": {"robot": "robot"},
        "define": {"bright": {"arguments": ["x: lamp"], "is": "x.level == high"}},
        "functions": {
            "lit": {"arguments": ["x: lamp"], "is": "bright(x)", "says": "{x} is on", "display": ["{x}_on"]},
            "by": {"arguments": ["x: lamp"], "is": "robot.by == x", "display": ["by_{x}"]},
            "idle": {"is": "robot.by == none"},
            "alike": {"arguments": ["x: lamp", "y: lamp"], "is": "x.color == y.color and x.level == y.level"},
            "painted": {"arguments": ["x: lamp", "c: color"], "is": "x.color == c"},
        },
        "actions": {
            "go": {"arguments": ["x: lamp"], "when": "robot.by != x", "outcomes": [{"set": {"robot.by": "x"}}]},
            "flip": {
                "when": "robot.by is lamp",
                "outcomes": [{"probability": "p", "set": {"robot.by": "none"}}, {"probability": "1 - p"}],
            },
            "press": {
                "arguments": ["x: lamp"],
                "when": "robot.by == x",
                "outcomes": [{"set": {"x.level": "low if bright(x) else high"}}],
            },
        },
        "constraints": ["count(x: lamp; bright(x)) <= 2"],
    },
    "objects": {
        "one": {"class": "lamp", "attributes": {"color": "red", "next": "two"}},
        "two": {"class": "lamp", "attributes": {"color": "blue", "next": "three"}},
        "three": {"class": "lamp", "attributes": {"color": "red"}},
    },
    "state": {
        "robot": {"by": "none"},
        "one": {"level": "low"},
        "two": {"level": "low"},
        "three": {"level": "high"},
    },
}
"""Lamps that a robot switches on and off; never three at once."""

NURSERY = {
    "name": "nursery",
    "kind": "oomdp",
    "domain": "toys",
    "values": {"color": ["brown"]},
    "grid": {
        "class": "cell",
        "map": ["KB", "LT"],
        "names": {"K": "kitchen", "B": "bedroom", "L": "living_room", "T": "bathroom"},
    },
    "objects": {
        "box": {"class": "box", "attributes": {"size": "large", "color": "brown"}},
        "crate": {"class": "box", "attributes": {"size": "small", "color": "red"}},
        "red_ball": {"class": "toy", "attributes": {"color": "red", "size": "small", "shape": "sphere"}},
        "blue_ball": {"class": "toy", "attributes": {"color": "blue", "size": "large", "shape": "sphere"}},
        "cube": {"class": "toy", "attributes": {"color": "red", "size": "large", "shape": "cube"}},
        "duck": {"class": "toy", "attributes": {"color": "yellow", "size": "small"}},
    },
    "state": {
        "robot": {"at": "kitchen"},
        "box": {"in": "kitchen"},
        "crate": {"in": "bedroom"},
        "red_ball": {"in": "crate"},
        "blue_ball": {"in": "box"},
        "cube": {"in": "bedroom"},
        "duck": {"in": "robot"},
    },
}
"""Four rooms in a square, two boxes and four toys: one in each box, one on the floor, one in the robot's hand."""

PANTRY = {
    "name": "pantry",
    "kind": "oomdp",
    "domain_spec": {
        "name": "pantry",
        "attributes": {"heat": ["cold", "cool", "warm", "hot"], "door": ["open", "closed"], "rank": ["good", "plain"]},
        "ordered": {"heat": {"less": ["icy"]}, "rank": {}},
        "classes": {
            "room": {},
            "robot": {"state": {"at": "room"}},
            "shelf": {"static": {"stands": "room"}, "state": {"door": "door"}, "words": ["cupboard"]},
            "dish": {"static": {"rank": "rank", "owner": "person"}, "state": {"on": "shelf | robot", "heat": "heat"}},
            "person": {},
        },
        "constants": {"robot": "robot"},
        "functions": {
            "beside": {
                "arguments": ["x: dish", "y: dish"],
                "is": "x.on == y.on and x.on is shelf",
                "says": "{x} is beside {y}",
            },
            "seen": {"arguments": ["r: room", "x: dish"], "is": "x.on.stands == r", "says": "{x} is seen from {r}"},
        },
        "actions": {"wait": {"outcomes": [{}]}},
    },
    "objects": {
        "hall": {"class": "room"},
        "cellar": {"class": "room"},
        "top": {"class": "shelf", "attributes": {"stands": "hall"}},
        "bottom": {"class": "shelf", "attributes": {"stands": "cellar"}},
        "soup": {"class": "dish", "attributes": {"rank": "good", "owner": "ann"}},
        "pie": {"class": "dish", "attributes": {"rank": "plain"}},
        "ice": {"class": "dish", "synonyms": ["ice on a stick"]},
        "stick": {"class": "dish"},
        "ann": {"class": "person"},
    },
    "state": {
        "robot": {"at": "hall"},
        "top": {"door": "open"},
        "bottom": {"door": "closed"},
        "soup": {"on": "top", "heat": "hot"},
        "pie": {"on": "top", "heat": "warm"},
        "ice": {"on": "bottom", "heat": "cold"},
        "stick": {"on": "robot", "heat": "cool"},
    },
}
"""Dishes on shelves that stand in rooms: relations by attributes and by functions, and ordered values."""

TINY = {
    "name": "tiny",
    "kind": "explicit",
    "states": 3,
    "initial": 0,
    "labels": {"a": [1], "b": [2]},
    "transitions": [
        {"from": 0, "action": "go", "to": [[1, 0.9], [0, 0.1]]},
        {"from": 1, "action": "go", "to": [[2, 1.0]]},
        {"from": 2, "action": "stay", "to": [[2, 1.0]]},
    ],
}

REMOVE = object()


def changed(data, *changes):
    """A copy of `data` with values put at paths ("a/b/0"), or taken out with REMOVE."""
    result = copy.deepcopy(data)
    for path, value in changes:
        *way, last = [int(part) if part.isdigit() else part for part in path.split("/")]
        place = result
        for part in way:
            place = place[part]
        if value is REMOVE:
            del place[last]
        elif isinstance(place, list) and last == len(place):
            place.append(value)
        else:
            place[last] = value
    return result
