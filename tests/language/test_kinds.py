"""Which task is meant, by the kinds of things that tasks were taught with."""

from __future__ import annotations

import pytest

from models.language import Translation
from models.language.kinds import strangers
from models.language.reading import STRANGE, rank, read
from models.language.scene import Scene
from models.logic import parse
from models.queries import Example, learn, parse_query
from models.world import builtin_environments, load_environment

WORLDS = {name: load_environment(data) for name, data in builtin_environments()}
TOYS, NAVIGATION = WORLDS["toys"], WORLDS["navigation"]
LESSONS = (
    ("move_to(sphere)", "F near(robot, sphere)", TOYS),
    ("navigate_one(library)", "F at(robot, library)", NAVIGATION),
)
TEMPLATES = {
    template.task: template
    for template in (learn([Example(parse_query(query), parse(ltl))], world) for query, ltl, world in LESSONS)
}


def counted(*queries: str) -> list[int]:
    translations = [Translation(parse_query(query), 0.5) for query in queries]
    readings = read(translations, Scene("", NAVIGATION, TEMPLATES.get))
    return strangers([(reading.grounded, reading.confidence) for reading in readings], TEMPLATES.get)


def test_a_landmark_is_not_what_move_to_was_taught_with() -> None:
    assert counted("move_to(bakery)", "navigate_one(bakery)") == [1, 0]


def test_only_readings_of_the_same_things_are_compared() -> None:
    assert counted("move_to(bakery)", "navigate_one(zoo)") == [0, 0]
    assert counted("move_to(bakery)", "avoid(navigate_one(bakery))") == [0, 0]


def test_what_is_far_less_likely_does_not_tell_what_is_strange() -> None:
    said = [Translation(parse_query("move_to(bakery)"), 0.6), Translation(parse_query("navigate_one(bakery)"), 0.05)]
    assert [reading.strange for reading in read(said, Scene("", NAVIGATION, TEMPLATES.get))] == [0, 0]


def test_parts_of_a_composition_count_one_by_one() -> None:
    assert counted(
        "and(move_to(bakery), move_to(zoo))",
        "and(move_to(bakery), navigate_one(zoo))",
        "and(navigate_one(bakery), navigate_one(zoo))",
    ) == [2, 1, 0]


def test_what_means_nothing_is_left_alone() -> None:
    assert counted("move_to(unicorn)", "navigate_one(unicorn)") == [0, 0]


def test_the_likelier_task_gives_way_to_the_one_that_was_taught_with_such_things() -> None:
    said = [Translation(parse_query("move_to(bakery)"), 0.6), Translation(parse_query("navigate_one(bakery)"), 0.3)]
    first, second = rank(said, Scene("go to the bakery", NAVIGATION, TEMPLATES.get))
    assert str(first.query) == "navigate_one(bakery)"
    assert second.confidence / first.confidence == pytest.approx(0.6 * STRANGE / 0.3)
