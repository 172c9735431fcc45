"""What says the contrary of a text is left out, and what says more is put right."""

from __future__ import annotations

import pytest

from models.language.corrections import corrected
from models.language.translation import Translation
from models.queries import parse_query


def correct(text: str, *queries: str) -> list[str]:
    found = corrected(text, [Translation(parse_query(query), 0.5) for query in queries])
    return [str(translation.query) for translation in found]


@pytest.mark.parametrize(
    ("text", "query"),
    [
        ("stay in the kitchen until you have the ball", "until(avoid(go(kitchen)), pickup(ball))"),
        ("Remain at my desk", "avoid(go(desk))"),
        ("wait by the door, then fetch it", "then(avoid(go(door)), fetch(it))"),
        ("don't leave the kitchen", "avoid(go(kitchen))"),
        ("never ever exit the hall", "avoid(go(hall))"),
        ("don't let the cup leave the living room", "avoid(bring(cup, living room))"),
        ("keep the oven off", "avoid(switch_off(oven))"),
        ("put the small bucket in the cart, not the big one", "avoid(put_in(small bucket, cart))"),
        ("before you see the hall or the lounge, go to the park", "then(or(go(hall), go(lounge)), go(park))"),
        ("never leave the oven on", "avoid(switch_off(oven))"),
        ("keep the oven on", "avoid(switch_on(oven))"),
        ("leave the oven running", "switch_off(oven)"),
        ("leave the oven off and go to the hall", "and(switch_on(oven), go(hall))"),
        ("stay away from the oven until the lamp is off", "until(avoid(switch_off(oven)), switch_off(lamp))"),
        ("you need not switch off the oven", "avoid(switch_off(oven))"),
        ("bring everything but the bag", "bring(bag)"),
        ("don't go anywhere but the hall", "avoid(go(hall))"),
        ("avoid every room except the hall", "avoid(go(any room hall))"),
    ],
)
def test_the_contrary_is_not_heard(text: str, query: str) -> None:
    assert correct(text, query, "pickup(ball)") == ["pickup(ball)"]


@pytest.mark.parametrize(
    ("text", "query"),
    [
        ("stay out of the kitchen", "avoid(go(kitchen))"),
        ("don't stay in the kitchen", "avoid(go(kitchen))"),
        ("the cup cannot stay in the hall", "avoid(bring(cup, hall))"),
        ("never leave the ball in the kitchen", "avoid(bring(ball, kitchen))"),
        ("never leave the oven on", "avoid(switch_on(oven))"),
        ("keep the oven off", "avoid(switch_on(oven))"),
        ("stay in the hall and never enter the kitchen", "avoid(go(kitchen))"),
        ("keep going to the hall again and again", "repeat(go(hall))"),
        ("visit the hall over and over again", "repeat(go(hall))"),
        ("go to the hall or the lounge", "or(go(hall), go(lounge))"),
        ("visit the hall but not the lounge", "and(go(hall), avoid(go(lounge)))"),
        ("leave the oven on", "switch_on(oven)"),
        ("never leave the oven on", "switch_off(oven)"),
        ("put the oven on the left", "switch_off(oven)"),
        ("go to the hall, you need not hurry", "go(hall)"),
        ("visit the hall and the lounge in any order", "and(go(hall), go(lounge))"),
        ("the hall and the park in any order, then the lounge", "then(and(go(hall), go(park)), go(lounge))"),
    ],
)
def test_what_the_text_says_stays(text: str, query: str) -> None:
    assert correct(text, query) == [query]


@pytest.mark.parametrize(
    ("text", "query", "right"),
    [
        ("turn it on, then off again", "then(start(it), repeat(stop(it)))", "then(start(it), stop(it))"),
        ("go to the hall again", "repeat(go(hall))", "go(hall)"),
        ("visit all rooms except the hall", "and(go(all rooms), avoid(go(hall)))", "go(all rooms except the hall)"),
        ("put any toy but the bag in it", "and(put(any toy, it), avoid(put(bag, it)))", "put(any toy but the bag, it)"),
        (
            "see every room but the hall and my lounge, please",
            "and(go(every room), avoid(go(hall)), avoid(go(lounge)))",
            "go(every room but the hall and my lounge)",
        ),
        (
            "patrol all rooms except the hall",
            "and(repeat(go(all rooms)), avoid(go(hall)))",
            "repeat(go(all rooms except the hall))",
        ),
        (
            "avoid every room except the hall",
            "and(avoid(go(every room)), avoid(go(hall)))",
            "avoid(go(any room except the hall))",
        ),
        (
            "hall, lounge, any order, just never the park",
            "and(then(go(hall), go(lounge)), avoid(go(park)))",
            "and(go(hall), go(lounge), avoid(go(park)))",
        ),
        ("hall and lounge, the order does not matter", "then(go(hall), go(lounge))", "and(go(hall), go(lounge))"),
        ("stay out of all rooms", "avoid(go(all rooms))", "avoid(go(any rooms))"),
        ("go to the hall and the lounge, in that order", "and(go(hall), go(lounge))", "then(go(hall), go(lounge))"),
        ("go to the hall and come back to the lounge", "and(go(hall), go(lounge))", "then(go(hall), go(lounge))"),
        (
            "bring it to the hall, then return to the lounge",
            "and(bring(it), go(lounge))",
            "then(bring(it), go(lounge))",
        ),
        (
            "bring it back to the hall and see the lounge",
            "and(bring(it, hall), go(lounge))",
            "and(bring(it, hall), go(lounge))",
        ),
        ("see the hall at least once", "repeat(go(hall))", "go(hall)"),
        (
            "pick up the cup, not the towel",
            "and(pickup(cup), avoid(move_to(towel)))",
            "and(pickup(cup), avoid(pickup(towel)))",
        ),
        (
            "pick up the cup, but do not go near the towel",
            "and(pickup(cup), avoid(move_to(towel)))",
            "and(pickup(cup), avoid(move_to(towel)))",
        ),
        ("go to the lounge instead of the hall", "or(go(lounge), go(hall))", "go(lounge)"),
        ("rather than my hall, visit the lounge", "or(go(lounge), go(hall))", "go(lounge)"),
    ],
)
def test_what_says_more_is_put_right(text: str, query: str, right: str) -> None:
    assert correct(text, query) == [right]


def test_what_comes_to_be_the_same_is_as_probable_as_all() -> None:
    (found,) = corrected(
        "go there again", [Translation(parse_query(q), 0.3) for q in ("repeat(go(there))", "go(there)")]
    )
    assert (str(found.query), found.confidence) == ("go(there)", 0.6)
