"""Networks trained on a few lifted commands, the linear baseline, and what is reported of them."""

from __future__ import annotations

import random
from dataclasses import replace

import pytest

from models.language.human.baseline import LinearBaseline, masked
from models.language.human.course import HumanCourse
from models.language.human.data import Command
from models.language.human.environment import environment
from models.language.human.lifting import Lifted, lift
from models.language.human.measurement import Outcome, measure, summary
from models.language.human.splits import Split, five_folds, unseen_formulas
from models.language.human.system import Plan, grounded
from models.language.spans.reader import SpanReading

PATTERNS = {
    "go to {0} and then go to {1}": "finally ( and ( {0} , finally ( {1} ) ) )",
    "go to {1} through {0}": "finally ( and ( {0} , finally ( {1} ) ) )",
    "avoid {0} until you reach {1}": "until ( not ( {0} ) , {1} )",
    "stay in {1} and go to {0}": "and ( finally ( {0} ) , always ( {1} ) )",
}
ROOMS = ["the red room", "the blue room", "the green room", "the yellow room", "the orange room"]


def commands() -> list[Command]:
    """Each pattern about every two rooms; the fold is that of the first room."""
    return [
        Command(text.format(one, other), formula.format(one, other), fold)
        for text, formula in PATTERNS.items()
        for fold, one in enumerate(ROOMS)
        for other in ROOMS
        if one != other
    ]


def test_a_tiny_training_understands_formulas_that_it_never_saw() -> None:
    plan = Plan(drawn=240)
    plan = replace(plan, settings=replace(plan.settings, epochs=4, batch=16))
    (split,) = unseen_formulas(commands(), [0])
    said: list[str] = []
    outcomes = measure(split, environment("drone"), seed=0, plan=plan, log=said.append)
    assert said == ["network 1 of 2", "network 2 of 2"]
    right = sum(outcome.right for outcome in outcomes) / len(outcomes)
    assert right > 0.8  # by chance one of three templates with its arguments in one of two orders: 1/6
    assert sum(outcome.baseline for outcome in outcomes) / len(outcomes) > 0.8
    assert not any(outcome.duplicate for outcome in outcomes)


def test_a_course_teaches_commands_as_they_are_and_renamed() -> None:
    drone = environment("drone")
    lifted = [lift(command, drone) for command in commands()]
    odd = Lifted(lifted[0].sentence, "next ( $1 )", lifted[0].things[:1])
    course = HumanCourse.of([*lifted, odd], drone, seed=0, known=("via",), drawn=50)
    part = "finally ( $1 )"  # which no command has, and the translator has words for
    assert dict(course.tasks) == dict.fromkeys({one.template for one in lifted}, 2) | {part: 1}
    assert {"via", "through", "until"} <= set(course.words)
    epoch = course.epoch(random.Random(1))
    assert len(epoch) == 60
    assert part in {item.task for item in epoch[50:]} <= set(course.own.ways)
    texts = {item.text for item in epoch[:50]}
    known = {one.sentence.words for one in lifted} | {drone.in_order(one.sentence).words for one in lifted}
    assert texts <= known
    assert len(course.checks(random.Random(0))) == len(course.checked) == 4


def test_an_argument_that_names_no_thing_or_two_makes_no_sense() -> None:
    sentence = environment("drone").sentence("go to the red room and the blue room")
    first, second = ((name.begin, name.end) for name in sentence.names)

    def things(*mentions: tuple[tuple[int, int], ...]) -> tuple[str, ...] | None:
        return grounded(sentence, SpanReading("task", mentions, 1.0, frozenset()))

    assert things((second,), (first,)) == ("the blue room", "the red room")
    assert things(((2, 5),)) == ("the red room",)
    assert things(((0, 1),)) is None
    assert things((first, second)) is None
    assert things((first,), (first,)) is None


def test_the_baseline_masks_things_by_kind_in_the_order_of_mention() -> None:
    drone = environment("drone")
    sentence = drone.sentence("go to landmark 2 through the red room, not landmark 1 or the red room")
    expected = "go to landmark1 through the room2 not landmark3 or the room2"
    assert masked(sentence, drone) == expected


def test_the_baseline_puts_things_back() -> None:
    drone = environment("drone")
    lifted = [lift(command, drone) for command in commands() if "purple" not in command.text]
    linear = LinearBaseline.fit(lifted, drone)
    sentences = [drone.sentence("go to landmark 3 through the purple room"), drone.sentence("avoid it until you do")]
    assert linear.formulas(sentences) == ["finally ( and ( the purple room , finally ( landmark 3 ) ) )", ""]


def test_folds_are_the_published_ones_and_halves_share_no_formula() -> None:
    for fold, split in enumerate(five_folds(commands())):
        assert {command.fold for command in split.test} == {fold}
        assert len(split.training) + len(split.test) == len(commands())
    for split in unseen_formulas(commands(), [1, 2]):
        assert {one.formula for one in split.training}.isdisjoint(one.formula for one in split.test)


def test_duplicates_are_counted_apart() -> None:
    runs = [[Outcome(True, True, True), Outcome(False, False, True)], [Outcome(False, True, False)]]
    assert summary(runs) == {
        "tested": [2, 1],
        "right": [0.5, 1.0],
        "baseline": [1.0, 0.0],
        "duplicates": {"tested": 1, "right": 1.0, "baseline": 1.0},
        "others": {"tested": 2, "right": 0.5, "baseline": 0.5},
    }


def test_a_text_of_the_training_set_is_a_duplicate() -> None:
    training = commands()
    plan = Plan(drawn=40)
    plan = replace(plan, settings=replace(plan.settings, epochs=1))
    other = Command("stay for ever in the red room", "always ( the red room )")
    split = Split("one", training, [training[0], other])
    outcomes = measure(split, environment("drone"), seed=0, plan=plan, log=[].append)
    assert [outcome.duplicate for outcome in outcomes] == [True, False]
    assert not outcomes[1].right


def test_summary_of_nothing_apart() -> None:
    assert summary([[Outcome(True, True, False)]])["others"] == {"tested": 0, "right": None, "baseline": None}


@pytest.mark.parametrize("seed", [0, 1])
def test_courses_of_a_seed_are_the_same(seed: int) -> None:
    drone = environment("drone")
    lifted = [lift(command, drone) for command in commands()]
    one, other = (HumanCourse.of(lifted, drone, seed=seed) for _ in range(2))
    assert one.epoch(random.Random(2)) == other.epoch(random.Random(2))
