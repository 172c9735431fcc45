"""How often, how long and under which condition, on cases worked out by hand, and on the polite frames of training."""

from __future__ import annotations

import pytest

from models.language.dataset.asides import asides
from models.language.dataset.half import Half
from models.language.dataset.speech import frames
from models.language.unsayable import unsayable
from models.queries import parse_query

ZOO = parse_query("navigate_one(zoo)")


@pytest.mark.parametrize(
    ("text", "found"),
    [
        ("Visit the museum twice!", "twice"),
        ("go to the zoo three times", "three times"),
        ("go to the zoo 2 more times", "2 more times"),
        ("stay at the zoo for ten minutes", "for ten minutes"),
        ("go to the zoo for about ten minutes", "for about ten minutes"),
        ("go to the zoo and remain in it", "remain in it"),
        ("do not leave the zoo", "do not leave the zoo"),
        ("don't let the bag leave the zoo", "don't let the bag leave the zoo"),
        ("never leave the bag in the zoo", None),
        ("don't stay in the zoo", None),
        ("my sister is waiting at the zoo, go to the zoo", None),
        ("keep the zoo open", "keep the zoo open"),
        ("keep going to the zoo", None),
        ("set the zoo to 200 degrees", "set the zoo to 200"),
        ("turn the zoo down", "turn the zoo down"),
        ("turn up at the zoo", None),
        ("check on the zoo", "check on"),
        ("go to the zoo and come back", "come back"),
        ("come back to the zoo", None),
        ("you don't have to go to the zoo", "don't have to"),
        ("you needn't hurry, go to the zoo", None),
        ("it would be a bad idea to go to the zoo", "bad idea"),
        ("There is no point in going to the zoo", "no point in"),
        ("I never said that you should go to the zoo", "never said"),
        ("the bag is in the zoo.", "the bag is in the zoo"),
        ("my bag was already at the zoo", "my bag was already at the zoo"),
        ("the bag should be in the zoo", None),
        ("the zoo is on fire, so go there", None),
        ("except for the park, go to every zoo", "except for the park"),
        ("leave the zoo on until noon", "leave the zoo on"),
        ("leave the zoo on the left", None),
        ("turn the zoo off and on again", None),
        ("be at the zoo in 5 minutes", "in 5 minutes"),
        ("be at the zoo within 2 hours", "within 2 hours"),
        ("If it is open, go to the zoo", "if it is open"),
        ("go to the zoo unless it's closed", "unless it's closed"),
        ("if the red light is on, go to the zoo", "if the red light is on"),
        ("go to the zoo if it rains", "if it rains"),
        ("Go to the zoo, stay there", "stay there"),
        ("go to the zoo and wait there", "wait there"),
        ("go to the zoo before 5 pm", "before 5 pm"),
        ("go to the zoo by noon", "by noon"),
        ("go to the zoo at 8 o'clock", "at 8 o'clock"),
        ("go to the zoo at 8:30 am", "at 8 30 am"),
        ("go to the zoo after lunch", "after lunch"),
        ("tomorrow morning, go to the zoo", "tomorrow morning"),
        ("dinner is at noon, so go to the zoo", None),
        ("go to the zoo every day", "every day"),
        ("go to the zoo on Monday", "on monday"),
        ("when the bell rings, go to the zoo", "when the bell rings"),
        ("go to the zoo as soon as it rains", "as soon as it rains"),
        ("go to the zoo whenever I call", "whenever i call"),
        ("every time somebody knocks, go to the zoo", "every time somebody knocks"),
        ("go to the zoo whenever you see a lion", "whenever you see a lion"),
        ("every time you have been to the park, go to the zoo", "every time you have been to the park"),
        ("go to the zoo whenever you have a minute", None),
        ("go to the zoo when you have time", None),
        ("go to the zoo when possible", None),
        ("go to the zoo as soon as possible", None),
        ("when that is done, go to the zoo", None),
        ("when there, go to the zoo", None),
        ("when the zoo is open, go there", None),  # of which the query may speak
        ("go to the zoo for lunch", None),
        ("good morning, go to the zoo", None),
        ("keep away from the zoo at all times", None),
        ("sometimes go to the zoo", None),
        ("if you have a minute, go to the zoo", None),
        ("if you have the time, go to the zoo", None),
        ("if you can, go to the zoo", None),
        ("if you are near the park, go to the zoo", "if you are near the park go to the zoo"),
        ("go to the zoo if you've been to the park", "if you've been to the park"),
        ("go to the zoo only after the park", "only after"),
        ("never go to both the zoo and the park", "never go to both"),
        ("go to the zoo and the park, but not at the same time", "not at the same time"),
        ("go to the park and always end up at the zoo", "always end up at"),
        ("go to the zoo and back", "and back"),
        ("go to the zoo and back to the park", None),
        ("go to the park, no wait, the zoo", "no wait"),
        ("charge yourself, then go to the zoo", "charge yourself"),
        ("go to the zoo while the oven is on", "while the oven is on"),
        ("everything must go to the zoo", "everything"),
        ("go to the zoo if it isn't too much trouble", None),
        ("if that is okay, go to the zoo", None),
        ("if possible, go to the zoo", None),
        ("go to the zoo", None),
    ],
)
def test_what_no_query_says(text: str, found: str | None) -> None:
    assert unsayable(text, ZOO) == found


def test_a_name_is_no_measure() -> None:
    query = parse_query("then(navigate_one(zoo), navigate_one(cafe in two minutes))")
    assert unsayable("go to the zoo, then the cafe in two minutes", query) is None
    assert unsayable("go to the zoo twice, then the cafe in two minutes", query) == "twice"


def test_one_of_two_tasks_is_not_both() -> None:
    off, both = parse_query("switch_off(oven)"), parse_query("then(switch_off(oven), switch_on(oven))")
    assert unsayable("turn the oven off and on again", off) == "off and on"
    assert unsayable("turn the oven off and on again", both) is None


@pytest.mark.parametrize(
    ("text", "query", "found"),
    [
        ("don't go to the zoo after the park", "until(avoid(go(zoo)), go(park))", "don't go to the zoo after the park"),
        ("once you have seen the park, never go to the zoo", "until(avoid(go(zoo)), go(park))", "once"),
        ("don't go to the zoo until after the park", "until(avoid(go(zoo)), go(park))", None),
        ("don't go to the zoo before the park", "until(avoid(go(zoo)), go(park))", None),
        ("go to the zoo only via the park", "and(go(zoo), until(avoid(go(park)), go(zoo)))", "only via"),
        ("go to the zoo only via the park", "then(go(park), go(zoo))", None),
        ("do not go to the zoo and then to the park", "then(go(zoo), go(park))", "do not go"),
        ("do not go to the zoo but to the park", "then(go(zoo), go(park))", None),
        ("do not go to the zoo and the park", "avoid(and(go(zoo), go(park)))", None),
        ("never go in while the oven is on", "without(go(kitchen), switch_on(oven))", None),
    ],
)
def test_what_is_forbidden_in_another_way(text: str, query: str, found: str | None) -> None:
    said = unsayable(text, parse_query(query))
    assert said == found if found is None or said is None else said.startswith(found)


def test_a_choice_is_no_condition() -> None:
    query = parse_query("or(navigate_one(zoo), navigate_one(park))")
    assert unsayable("go to the zoo if it is open, else the park", query) is None
    assert unsayable("go to the zoo or the park", query) is None
    assert unsayable("go to the zoo if the park is closed", query) == "if the park is closed"


@pytest.mark.parametrize("half", list(Half))
def test_politeness_reasons_and_remarks_are_no_conditions(half: Half) -> None:
    polite, beside = frames(half), asides(half)
    said = [frame.format("go to the zoo") for frame in (*polite.calls, *polite.requests, *polite.closings)]
    said += [f"{reason} go to the zoo".format(object="the bag", place="the zoo") for reason in beside.reasons_before]
    after = (*beside.reasons_after, *beside.asides, *beside.purposes)
    said += [f"go to the zoo, {remark}".format(object="the bag", place="the zoo") for remark in after]
    assert len(said) > 100
    assert [text for text in said if unsayable(text, ZOO) is not None] == []
