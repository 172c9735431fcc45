"""Arguments of utterances found by what their words name in the built-in worlds."""

from __future__ import annotations

import pytest

from models.language import ExampleArgumentNotFoundError, find_arguments
from models.logic import parse
from models.queries import Example, Template, learn, parse_task
from models.world import Environment, builtin_environments, load_environment


@pytest.fixture(scope="module")
def toys() -> Environment:
    return load_environment(dict(builtin_environments())["toys"])


def template(query: str, ltl: str, environment: Environment) -> Template:
    return learn([Example(parse_task(query), parse(ltl))], environment)


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("stash the sphere in the box", "stow(sphere, box)"),
        ("the box is where the green ball belongs", "stow(green ball, box)"),
        ("let the box swallow the blue toy", "stow(blue toy, box)"),
    ],
)
def test_each_parameter_takes_what_fits_it(text: str, expected: str, toys: Environment) -> None:
    found = find_arguments(text, template("stow(cylinder, box)", "F in(cylinder, box)", toys), toys)
    assert str(found) == expected


@pytest.mark.parametrize(
    ("text", "detail"),
    [
        ("stash it in the box", 'it names "box", and stow has 2'),
        ("stash the unicorn in the box", 'it names "box"'),
        ("stash the sphere and the cylinder in the box", 'names "sphere", "cylinder", "box", and stow has 2'),
        ("stash it", "it names nothing"),
    ],
)
def test_what_cannot_be_found_is_told(text: str, detail: str, toys: Environment) -> None:
    with pytest.raises(ExampleArgumentNotFoundError, match=detail):
        find_arguments(text, template("stow(cylinder, box)", "F in(cylinder, box)", toys), toys)


def test_two_arguments_of_one_kind_have_to_be_marked(toys: Environment) -> None:
    tour = template("tour(kitchen, bathroom)", "F (at(robot, kitchen) & F at(robot, bathroom))", toys)
    with pytest.raises(ExampleArgumentNotFoundError, match="which names which argument cannot be told"):
        find_arguments("from the bedroom wander over to the kitchen", tour, toys)
