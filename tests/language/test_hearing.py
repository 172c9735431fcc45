"""What a service that was just set up hears, in its own worlds: networks, common tasks, and environment together."""

from __future__ import annotations

import pytest

from benchmarks.language import Bench
from models.language.hearing import MOST_TEXTS, Hearing
from models.language.reading import Reading
from models.logic import Op, Unary
from models.logic import to_text as formula_text
from models.queries import ContextualQuery
from models.world import Environment
from service.questions import CLOSE


@pytest.fixture(scope="module")
def bench() -> Bench:
    return Bench.load()


def heard(bench: Bench, world: str, text: str) -> list[str]:
    """The formulas of the readings, best first; a dash for what means nothing there."""
    readings = bench.hearing.readings(text, bench.environments[world], candidates=2)
    return ["-" if reading.grounded is None else formula_text(reading.grounded.formula) for reading in readings]


@pytest.mark.parametrize(
    ("world", "text", "formula"),
    [
        ("toys", "put the ball in the box", "F in(sphere, box)"),
        ("toys", "put the ball in the kitchen", "F at(sphere, kitchen)"),
        ("toys", "bring the ball to the box", "F in(sphere, box)"),
        (
            "house",
            "pick up the red cup, then go to the kitchen",
            "F (holding(cup) & colored(cup, red) & F at(robot, kitchen))",
        ),
        ("toys", "grab the green ball, then put it in the crate", None),
        (
            "toys",
            "pick up the red cylinder and take the bag",
            "F (holding(cylinder) & colored(cylinder, red)) & F holding(bag)",
        ),
        (
            "house",
            "go to the kitchen and pick up the red cup",
            "F at(robot, kitchen) & F (holding(cup) & colored(cup, red))",
        ),
        ("toys", "go to the kitchen and pick up the ball", "F at(robot, kitchen) & F holding(sphere)"),
        (
            "warehouse",
            "pick up the red parcel and put it on the trolley",
            "F (holding(red_parcel) & colored(red_parcel, red)) & F in(red_parcel, trolley)",
        ),
        (
            "house",
            "when you have switched on all the appliances, go to the kitchen",
            "F (running(oven) & F at(robot, kitchen)) & F (running(washing_machine) & F at(robot, kitchen))",
        ),
        ("house", "turn the washing machine off", "F !running(washing_machine)"),
        ("house", "put the cup down in the bedroom", "F at(cup, bedroom)"),
        ("warehouse", "place the small parcel on shelf a", "F in(red_parcel, shelf_a)"),
        ("warehouse", "put the blue parcel back on shelf c", "F in(blue_parcel, shelf_c)"),
        ("warehouse", "go to shelf b and never go to shelf a", "F near(robot, shelf_b) & G !near(robot, shelf_a)"),
        ("toys", "put the sphere and the cylinder into the box", "F in(sphere, box) & F in(cylinder, box)"),
        (
            "toys",
            "take either the ball or the orange to the bathroom",
            "F at(sphere, bathroom) | F at(orange, bathroom)",
        ),
        ("house", "Take the cup and the towel to the kitchen", "F at(cup, kitchen) & F at(towel, kitchen)"),
        (
            "house",
            "Take the towel and the basket to the bathroom, then go to the kitchen",
            "F (at(towel, bathroom) & F at(robot, kitchen)) & F (at(basket, bathroom) & F at(robot, kitchen))",
        ),
        (
            "toys",
            "pick up the ball and the cylinder and put them in the box",
            "F holding(sphere) & F in(sphere, box) & F holding(cylinder) & F in(cylinder, box)",
        ),
        (
            "toys",
            "bring the ball and the orange to the kitchen or the bathroom",
            "(F at(sphere, kitchen) | F at(sphere, bathroom)) & (F at(orange, kitchen) | F at(orange, bathroom))",
        ),
        (
            "toys",
            "pick up either the red cylinder or the green ball",
            "F (holding(cylinder) & colored(cylinder, red)) | F (holding(sphere) & colored(sphere, green))",
        ),
        (
            "house",
            "bring the cup to the kitchen and the towel to the bedroom",
            "F at(cup, kitchen) & F at(towel, bedroom)",
        ),
        ("toys", "never touch the ball or the orange", "G !near(robot, sphere) & G !near(robot, orange)"),
        (
            "house",
            "Grab the mug from the living room and bring it to the kitchen",
            "F holding(cup) & F at(cup, kitchen)",
        ),
        ("toys", "Fetch the ball from the bedroom", "F holding(sphere)"),
        ("house", "put the kitchen in the basket", "-"),
        ("toys", "under no circumstances put the orange in the crate", "G !in(orange, box)"),
        ("toys", "put the box in the sphere", "-"),
        ("toys", "Take the ball out of the box", "-"),  # it is not there
        ("warehouse", "move the red parcel from shelf B to shelf A", "F in(red_parcel, shelf_a)"),
        (
            "warehouse",
            "Get the parcel off shelf A and bring it to the packing desk",
            "F holding(blue_parcel) & F at(blue_parcel, packing_station)",
        ),
        (
            "toys",
            "visit all rooms but the bathroom",
            "F at(robot, kitchen) & F at(robot, bedroom) & F at(robot, living_room)",
        ),
        ("house", "turn the oven on, then turn it off again", "F (running(oven) & F !running(oven))"),
        ("house", "hands off the towel", "G !holding(towel)"),
        (
            "house",
            "put the towel in the basket; before that, turn off the oven",
            "F (!running(oven) & F in(towel, basket))",
        ),
        (
            "house",
            "Neither the oven nor the washing machine should be on",
            "G !running(oven) & G !running(washing_machine)",
        ),
        ("house", "on your way to the bathroom, grab the towel", "F (holding(towel) & F at(robot, bathroom))"),
        ("toys", "go to the bedroom and come back to the kitchen", "F (at(robot, bedroom) & F at(robot, kitchen))"),
        ("toys", "put the ball in the box, not the bag", "F in(sphere, box) & G !in(bag, box)"),
        ("house", "keep the oven off", "F !running(oven)"),  # the service asks whether that is meant
        ("warehouse", "visit all shelves", "F near(robot, shelf_a) & F near(robot, shelf_b) & F near(robot, shelf_c)"),
        ("warehouse", "keep going between shelf a and shelf b", "G (F near(robot, shelf_a) & F near(robot, shelf_b))"),
    ],
)
def test_what_is_said_in_a_world(bench: Bench, world: str, text: str, formula: str | None) -> None:
    expected = formula or "F (holding(sphere) & colored(sphere, green) & F in(sphere, box))"
    assert heard(bench, world, text)[0] == expected


@pytest.mark.parametrize(
    ("world", "text"),
    [
        ("toys", "don't put the ball in the box"),
        ("toys", "never allow the ball into the crate"),
        ("toys", "never let the ball end up in the box"),
        ("house", "do not switch on the oven"),
    ],
)
def test_what_is_forbidden_is_not_done(bench: Bench, world: str, text: str) -> None:
    (best, *_) = bench.hearing.readings(text, bench.environments[world], candidates=1)
    assert best.grounded is not None
    formula = best.grounded.formula
    assert isinstance(formula, Unary)
    assert formula.op is Op.GLOBALLY
    assert isinstance(formula.operand, Unary)
    assert formula.operand.op is Op.NOT


@pytest.mark.parametrize(
    ("world", "text"),
    [
        ("warehouse", "never enter the loading bay while carrying a parcel"),
        ("warehouse", "don't go to the charger before delivering the parcel"),
        ("toys", "go to the kitchen, and never drop the ball"),
        ("house", "do not bring the towel to the bathroom until the oven is on"),
    ],
)
def test_a_text_that_forbids_a_part_of_what_it_says_is_not_taken_for_a_task(
    bench: Bench, world: str, text: str
) -> None:
    found = bench.hearing.readings(text, bench.environments[world], candidates=3)
    assert not any(isinstance(reading.query, ContextualQuery) for reading in found)


@pytest.mark.parametrize("text", ["turn on the oven and wave", "switch on the oven, then disinfect the kitchen"])
def test_a_part_that_is_known_is_not_taken_for_the_whole(bench: Bench, text: str) -> None:
    found = bench.hearing.readings(text, bench.environments["house"], candidates=3)
    assert not any(reading.grounded for reading in found)


def test_what_may_be_forbidden_is_asked_about(bench: Bench) -> None:
    text = "the ball must never be allowed into the crate"
    found = bench.hearing.readings(text, bench.environments["toys"], candidates=2)
    assert {str(reading.query) for reading in found} == {"put_in(ball, crate)", "avoid(put_in(ball, crate))"}
    assert found[1].confidence >= CLOSE * found[0].confidence


@pytest.mark.parametrize(
    ("world", "text"),
    [
        ("toys", "is the ball in the kitchen"),
        ("toys", "what is in the box"),
        ("house", "was the towel put in the basket"),
        ("house", "What's in the kitchen?"),
        ("toys", "pick up the ball and dance"),
        ("house", "bring me the cup"),  # near to switching it on, which means nothing there
        ("house", "leave the kitchen"),  # near to switching it off
        ("house", "empty the basket"),
        ("house", "swap the cup and the towel"),
    ],
)
def test_what_asks_for_nothing_known(bench: Bench, world: str, text: str) -> None:
    assert heard(bench, world, text) == []


def test_few_texts_are_read_for_a_command(bench: Bench, monkeypatch: pytest.MonkeyPatch) -> None:
    """However many names are joined in it, and in however many places."""
    texts: list[str] = []
    heard = Hearing._as_said

    def counted(
        hearing: Hearing, text: str, environment: Environment | None, *, candidates: int
    ) -> tuple[Reading, ...]:
        texts.append(text)
        return heard(hearing, text, environment, candidates=candidates)

    monkeypatch.setattr(Hearing, "_as_said", counted)
    said, toys = "fold the ball and the bag ", bench.environments["toys"]
    bench.hearing.readings(said * 4, toys, candidates=2)
    assert 2 < len(texts) <= 1 + MOST_TEXTS
    texts.clear()
    bench.hearing.readings(
        "fold the ball and the bag " + "very " * 40 + "nicely", bench.environments["toys"], candidates=2
    )
    assert len(texts) == 1
