"""Names that share all other words are told apart, and what is said of each is put together."""

from __future__ import annotations

import pytest

from models.language.coordination import MOST, joined
from models.queries import Operator, parse_query
from models.world import Environment, builtin_environments, load_environment


@pytest.fixture(scope="module")
def toys() -> Environment:
    return load_environment(dict(builtin_environments())["toys"])


@pytest.mark.parametrize(
    ("text", "operator", "texts"),
    [
        ("Put the ball and the orange in the box", "and", ["put the ball in the box", "put the orange in the box"]),
        ("take either the ball or my orange", "or", ["take the ball", "take my orange"]),
        ("put both the ball and orange in it", "and", ["put the ball in it", "put orange in it"]),
        ("visit the kitchen, bathroom, and bedroom", "and", ["visit the kitchen", "visit bathroom", "visit bedroom"]),
        (
            "get the ball or the bag and put them away",
            "or",
            ["get the ball and put it away", "get the bag and put it away"],
        ),
        ("bring the ball as well as the orange", "and", ["bring the ball", "bring the orange"]),
        ("bring the ball along with my orange", "and", ["bring the ball", "bring my orange"]),
        ("once the ball and the bag are there", "and", ["once the ball is there", "once the bag is there"]),
        ("get the red cylinder and the green ball!", "and", ["get the red cylinder !", "get the green ball !"]),
    ],
)
def test_a_command_is_said_of_one_name_at_a_time(toys: Environment, text: str, operator: str, texts: list[str]) -> None:
    (found,) = joined(text, toys)
    assert (found.operator, list(found.texts)) == (Operator(operator), texts)


@pytest.mark.parametrize(
    "text",
    [
        "put the ball in the box and the orange in the kitchen",  # the box and the orange stand side by side
        "go to the kitchen and pick up the ball",
        "put the ball in the box",
        "visit the kitchen, then the bedroom",
        "",
        ", ".join(["the ball"] * MOST) + " and the orange",
    ],
)
def test_other_names_share_nothing(toys: Environment, text: str) -> None:
    for found in joined(text, toys):
        assert found.put_together([parse_query("put_in(ball, box)"), parse_query("pickup(orange)")]) is None
        assert (" ".join(found.names[0]), " ".join(found.names[1])) == ("box", "orange")


def test_two_groups_are_told_apart_one_after_the_other(toys: Environment) -> None:
    first, second = joined("bring the ball and the orange to the kitchen or the bathroom", toys)
    assert first.texts == (
        "bring the ball to the kitchen or the bathroom",
        "bring the orange to the kitchen or the bathroom",
    )
    assert second.names == (("kitchen",), ("bathroom",))
    assert second.operator is Operator.OR


@pytest.mark.parametrize(
    ("parts", "whole"),
    [
        (["put_in(ball, box)", "put_in(orange, box)"], "and(put_in(ball, box), put_in(orange, box))"),
        (
            ["then(bring(ball, kitchen), go(bedroom))", "then(bring(orange, kitchen), go(bedroom))"],
            "then(and(bring(ball, kitchen), bring(orange, kitchen)), go(bedroom))",
        ),
        (
            ["and(pickup(ball), put_in(ball, box))", "and(pickup(orange), put_in(orange, box))"],
            "and(pickup(ball), put_in(ball, box), pickup(orange), put_in(orange, box))",
        ),
        (
            ["then(pickup(ball), put_in(ball, box))", "then(pickup(orange), put_in(orange, box))"],
            "and(then(pickup(ball), put_in(ball, box)), then(pickup(orange), put_in(orange, box)))",
        ),
        (["repeat(go(ball))", "repeat(go(orange))"], "repeat(and(go(ball), go(orange)))"),
        (
            ["until(avoid(go(hall)), put_in(ball, box))", "until(avoid(go(hall)), put_in(orange, box))"],
            "until(avoid(go(hall)), and(put_in(ball, box), put_in(orange, box)))",
        ),
        (["until(go(ball), go(hall))", "until(go(orange), go(hall))"], None),
        (["avoid(go(ball))", "avoid(go(orange))"], None),  # not both, or neither?
        (["put_in(ball, box)", "pickup(orange)"], None),
        (["put_in(ball, box)", "put_in(orange, bag)"], None),  # differs in what is no name of the two
        (["go(kitchen)", "go(kitchen)"], None),
        (["then(go(ball), go(hall))", "and(go(orange), go(hall))"], None),
    ],
)
def test_what_is_said_of_each_is_put_together(toys: Environment, parts: list[str], whole: str | None) -> None:
    (found,) = joined("do it with the ball and the orange", toys)
    together = found.put_together([parse_query(part) for part in parts])
    assert (None if together is None else str(together)) == whole


@pytest.mark.parametrize(
    ("query", "torn"),
    [
        ("and(pickup(ball), put_in(orange, box))", True),
        ("put_in(orange, box)", True),
        ("go(kitchen)", True),
        ("and(put_in(the ball, box), put_in(orange, box))", False),
        ("swap(ball, orange)", False),
    ],
)
def test_a_query_is_torn_that_does_other_things_to_another_name(toys: Environment, query: str, torn: bool) -> None:
    (found,) = joined("put the ball and the orange in the box", toys)
    assert found.tears(parse_query(query)) is torn
