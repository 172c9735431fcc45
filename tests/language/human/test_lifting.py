"""Lifting: names in sentences, templates and arguments of formulas, and back."""

from __future__ import annotations

import pytest
from hypothesis import given
from hypothesis import strategies as st

from models.language.human.data import Command
from models.language.human.environment import DATASETS, environment, plain
from models.language.human.lifting import arity, fill, lift, lift_formula, with_usual_constants

THINGS = st.sampled_from(sorted(environment("drone").kind_of))


def test_names_are_found_longest_first_and_things_by_their_synonyms() -> None:
    sentence = environment("drone").sentence("Go to the twond floor, then landmark 2 in the red room.")
    found = [(" ".join(sentence.words[name.begin : name.end]), name.thing) for name in sentence.names]
    assert found == [("twond floor", "the second floor"), ("landmark 2", "landmark 2"), ("red room", "the red room")]


def test_published_spelling_is_undone() -> None:
    assert plain("Do n't go, it isn t red/blue") == "don't go, it isn't red blue"
    assert plain("do not enter; want tea") == "do not enter; want tea"


def test_sentences_about_other_things_become_the_same() -> None:
    drone = environment("drone")
    one = drone.in_order(drone.sentence("go to the green room through landmark 3, not the red room"))
    other = drone.in_order(drone.sentence("go to the blue room through landmark 1, not the purple room"))
    assert one.words == other.words
    assert [name.thing for name in one.names] == ["the green room", "landmark 3", "the red room"]


def test_a_command_is_lifted_in_the_order_of_the_formula() -> None:
    formula = "finally ( and ( the red room , finally ( landmark 1 ) ) )"
    lifted = lift(Command("go to landmark one through the red room", formula), environment("drone"))
    assert lifted.template == "finally ( and ( $1 , finally ( $2 ) ) )"
    assert lifted.things == ("the red room", "landmark 1")
    assert lifted.item(lifted.sentence).mentions == (((6, 8),), ((2, 4),))
    renamed = lifted.item(environment("drone").in_order(lifted.sentence))
    assert renamed.text == ("go", "to", "landmark", "one", "through", "the", "red", "room")


def test_a_thing_that_is_not_named_stays_a_constant() -> None:
    formula = "and ( finally ( landmark 1 ) , always ( the third floor ) )"
    lifted = lift(Command("go to landmark one without changing floors", formula), environment("drone"))
    assert (lifted.template, lifted.things) == ("and ( finally ( $1 ) , always ( the third floor ) )", ("landmark 1",))


def test_of_constants_in_the_same_place_the_most_frequent_is_kept() -> None:
    drone = environment("drone")
    floors = ["the first floor", "the second floor", "the second floor"]
    commands = [
        lift(Command("stay and go to landmark 1", f"and ( finally ( landmark 1 ) , always ( {floor} ) )"), drone)
        for floor in floors
    ]
    kept = {command.template for command in with_usual_constants(commands, drone)}
    assert kept == {"and ( finally ( $1 ) , always ( the second floor ) )"}


def test_the_colour_of_what_is_not_picked_is_an_argument() -> None:
    formula = "globally ( and ( until ( scan , not ( any non red cubes ) ) , finally ( any non red cubes ) ) )"
    lifted = lift(Command("pick everything but the orange ones", formula), environment("pick"))
    assert lifted.things == ("red",)
    assert arity(lifted.template) == 1


@given(st.lists(THINGS, min_size=2, max_size=2, unique=True))
def test_filling_undoes_lifting_also_when_things_change_places(things: list[str]) -> None:
    formula = f"until ( not ( {things[0]} ) , or ( {things[1]} , {things[0]} ) )"
    template, found = lift_formula(formula, things)
    assert template == "until ( not ( $1 ) , or ( $2 , $1 ) )"
    assert fill(template, found) == formula
    assert fill(template, found[::-1]) == f"until ( not ( {things[1]} ) , or ( {things[0]} , {things[1]} ) )"


@pytest.mark.parametrize("dataset", DATASETS)
def test_no_name_stands_for_two_things(dataset: str) -> None:
    names = [name for kind in environment(dataset).kinds.values() for things in kind.values() for name in things]
    assert len(names) == len(set(names))
