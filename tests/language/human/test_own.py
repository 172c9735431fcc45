"""The translator's own ways to say the templates of the published commands."""

from __future__ import annotations

import random
import re

import pytest

from models.language.human.environment import environment
from models.language.human.lifting import fill, lift_formula
from models.language.human.own import OwnCommands, numbered, parts, read_formula
from models.logic import parse
from models.logic.spot import equivalent

AVOIDING = "and ( finally ( go to the $1 room ) , globally ( not ( go to the $2 room ) ) )"
EITHER_THEN = "finally ( and ( or ( go to the $1 room , go to the $2 room ) , finally ( go to the $3 room ) ) )"
CLEANUP, DRONE = environment("cleanup"), environment("drone")


def test_parts_of_a_template_bid_to_do_something() -> None:
    assert list(parts(AVOIDING)) == [AVOIDING, "finally ( go to the $1 room )"]
    assert list(parts("until ( not ( $1 ) , $2 )")) == ["until ( not ( $1 ) , $2 )"]
    assert list(parts("go to the $1 room")) == []


def test_holes_are_numbered_as_they_stand() -> None:
    assert numbered("finally ( and ( $2 , not ( $1 ) ) ) $2") == "finally ( and ( $1 , not ( $2 ) ) ) $1"


@pytest.mark.parametrize(
    ("template", "formula"),
    [
        (AVOIDING, "F at($1) & G !at($2)"),
        (EITHER_THEN, "F ((at($1) | at($2)) & F at($3))"),
        ("until ( not ( go to the $1 room ) , go to the $2 room )", "!at($1) U at($2)"),
        ("finally ( go to the $1 room with $2 )", None),  # not only where the robot is
        ("perhaps ( go to the $1 room )", None),
        ("finally ( go to the $1 room ) )", None),
    ],
)
def test_templates_are_read_as_formulas(template: str, formula: str | None) -> None:
    read = read_formula(template, "go to the {} room")
    assert read is None if formula is None else read is not None and equivalent(read, parse(formula))


def test_what_no_command_of_the_training_set_has_is_known_as_a_part_of_what_one_has() -> None:
    own = OwnCommands.of([AVOIDING], CLEANUP)
    assert set(own.ways) == {AVOIDING, "finally ( go to the $1 room )"}
    assert set(OwnCommands.of(["until ( not ( $1 ) , $2 )"], DRONE).ways) == {"until ( not ( $1 ) , $2 )"}
    assert OwnCommands.of(["finally ( any non $1 cubes )"], environment("pick")).ways == {}


@pytest.mark.parametrize("template", [AVOIDING, EITHER_THEN, "finally ( go to the $1 room )"])
def test_commands_name_what_their_formulas_are_about(template: str) -> None:
    own = OwnCommands.of([template], CLEANUP)
    drawn = own.draw(200, random.Random(7))
    assert {command.template for command in drawn} == set(own.ways)
    for command in drawn:
        named = {name.thing for name in command.sentence.names}
        assert named == set(command.things)
        assert lift_formula(fill(command.template, command.things), sorted(named)) == (command.template, command.things)
        for name in command.sentence.names:
            assert command.sentence.words[name.begin : name.end] in CLEANUP.kinds["color"][name.thing]


def test_what_is_done_first_is_the_first_argument_wherever_it_is_said() -> None:
    own = OwnCommands.of(["finally ( and ( $1 , finally ( $2 ) ) )"], DRONE)
    heard: dict[str, set[bool]] = {"first": set(), "prior to": set()}
    for command in own.draw(4000, random.Random(3)):
        text, first = " ".join(command.sentence.words), command.sentence.names[0].thing
        for opening in heard:
            if re.match(rf"{opening} \S+", text):
                heard[opening].add(first == command.things[0])
    assert heard == {"first": {True}, "prior to": {False}}
