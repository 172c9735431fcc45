"""The examples of docs/worlds.md work as the page says."""

import json
import re

import numpy as np
import pytest
import yaml

from models.logic.formula import Atom, Name
from models.world import compile_world, ground, limits, load_environment
from tests.world.worlds import TINY


@pytest.fixture(scope="module")
def page(pytestconfig):
    return (pytestconfig.rootpath / "docs" / "worlds.md").read_text(encoding="utf-8")


def block(page, language):
    return re.search(f"```{language}.*?\n(.*?)```", page, re.DOTALL)[1]


def test_the_complete_example(page):
    environment = load_environment(yaml.safe_load(block(page, "yaml")))
    world = compile_world(environment)
    assert world.size == 8
    assert world.valid().sum() == 6
    assert world.actions == ("east", "west", "press(ceiling_lamp)", "press(floor_lamp)")
    lit = Atom("lit", (Name("kitchen"),))

    def do(action, index):
        outcomes = world.outcomes(world.actions.index(action), np.array([index]))
        return outcomes.enabled[0], outcomes.successor[0, 0], outcomes.probability[:, 0].tolist()

    enabled, in_kitchen, chances = do("east", world.initial)
    assert (enabled, chances) == (True, [0.9, 0.1])
    assert not do("press(ceiling_lamp)", in_kitchen)[0], "two lamps would be on"
    enabled, dark, chances = do("press(floor_lamp)", world.initial)
    assert (enabled, chances) == (True, [0.8, 0.2])
    _, dark_kitchen, _ = do("east", dark)
    enabled, bright, _ = do("press(ceiling_lamp)", dark_kitchen)
    assert enabled
    assert world.labels([lit], np.array([world.initial, dark_kitchen, bright])).tolist() == [[False, False, True]]
    assert [c.symbol.name for c in ground("the blue light", environment).candidates] == ["floor_lamp"]
    assert [c.symbol.name for c in ground("the lamp in the kitchen", environment).candidates] == ["ceiling_lamp"]
    assert [c.symbol.name for c in ground("the lamp that is on", environment).candidates] == ["floor_lamp"]
    assert [c.symbol.name for c in ground("the lamp", environment).candidates] == ["ceiling_lamp", "floor_lamp"]


def test_the_explicit_example(page):
    assert json.loads(block(page, "json")) == TINY


def test_every_limit_is_in_the_table(page):
    rows = dict(re.findall(r"^\| `(MAX_\w+)` \| (\S+) \|", page, re.MULTILINE))
    shown = {2**62: "2^62", 2**24: "2^24", 2**25: "2^25", 2**20: "2^20"}
    values = {name: getattr(limits, name) for name in dir(limits) if name.startswith("MAX_")}
    assert rows == {name: shown.get(value, f"{value:,}") for name, value in values.items()}
