"""Matching with what was taught: probabilities that add up, and the shipped network."""

from __future__ import annotations

import numpy as np
import pytest

from models.language import Utterance
from models.language.matching import Matcher, Shelf, TaughtTask
from models.language.matching.cards import cards_of
from models.queries import ContextualQuery, parse_task


@pytest.fixture(scope="module")
def matcher() -> Matcher:
    return Matcher.load()


def taught(matcher: Matcher, query: str, says: str, *examples: str) -> TaughtTask:
    read = parse_task(query)
    known = matcher.known([Utterance.of(text, read) for text in examples])
    return TaughtTask(read.task, len(read.arguments), tuple(known), tuple(matcher.known(cards_of(read, says))))


@pytest.fixture(scope="module")
def shelf(matcher: Matcher) -> Shelf:
    return Shelf.of(
        [
            taught(matcher, "polish(mirror)", "eventually {1} is shiny", "polish the mirror"),
            taught(matcher, "hang_up(coat, hook)", "eventually {1} is on {2}", "hang the coat on the hook"),
            taught(matcher, "ring(bell)", "eventually {1} was rung", "ring the bell for dinner"),
            taught(matcher, "evacuate()", "eventually the house is empty", "everybody leave the house"),
        ]
    )


def test_other_words_and_other_things_of_a_taught_task(matcher: Matcher, shelf: Shelf) -> None:
    assert str(matcher.match("please polish the silver tray", shelf, candidates=1)[0].query) == "polish(silver tray)"
    (best,) = matcher.match("could you hang my jacket on the peg", shelf, candidates=1)
    assert str(best.query) == "hang_up(jacket, peg)"


def test_probabilities_add_up_and_are_the_same_every_time(matcher: Matcher, shelf: Shelf) -> None:
    for text in ("hang the hat on the nail", "what time is it", "polish", "the", "ring " * 60):
        found = matcher.match(text, shelf, candidates=20)
        assert sum(translation.confidence for translation in found) <= 1 + 1e-6
        assert [t.confidence for t in found] == sorted((t.confidence for t in found), reverse=True)
        assert found == matcher.match(text, shelf, candidates=20)


def test_tasks_that_do_not_fit_are_passed_over(matcher: Matcher, shelf: Shelf) -> None:
    found = matcher.match("polish the mirror", shelf, candidates=20, fits=lambda task: task != "polish")
    assert all(not str(translation.query).startswith("polish(") for translation in found)


def test_a_task_of_its_own_for_all_of_a_kind(matcher: Matcher) -> None:
    """Where all things of a kind are named, a task without arguments may be meant, which is told by its words."""
    lamps = taught(matcher, "turn_off(lamp)", "eventually {1} is off", "turn off the lamp")
    dark = taught(matcher, "lights_out()", "eventually it is dark", "turn off all the lights")
    shelf = Shelf.of([lamps, dark])
    expected = {
        "please switch off every light": ((4, 5), "lights_out()"),
        "please switch off the light": ((4, 5), "turn_off(light)"),
    }
    for text, (span, query) in expected.items():
        (best,) = matcher.match(text, shelf, candidates=1, named=lambda _, span=span: [span])
        assert str(best.query) == query
        assert best.confidence > 0.5
    (best,) = matcher.match("turn off every lamp", Shelf.of([lamps]), candidates=1, named=lambda _: [(3, 4)])
    assert str(best.query) == "turn_off(every lamp)"


def test_nothing_is_near_to_an_empty_shelf(matcher: Matcher) -> None:
    empty = Shelf.of([])
    assert matcher.match("polish the mirror", empty, candidates=3) == ()
    assert matcher.nearest("polish the mirror", empty, count=3) == ()


def test_the_nearest_tasks_are_named(matcher: Matcher, shelf: Shelf) -> None:
    names = [task for task, _ in matcher.nearest("polish the mirror", shelf, count=2)]
    assert names[0] == "polish"
    assert len(names) == 2


def test_what_was_read_survives_storage(matcher: Matcher) -> None:
    (known,) = matcher.known([Utterance.of("hang the coat on the hook", parse_task("hang_up(coat, hook)"))])
    data = matcher.to_bytes(known)
    back = matcher.from_bytes(data)
    assert back is not None
    assert back.asked.shape == known.asked.shape
    assert np.allclose(back.asked, known.asked, atol=1e-3)
    assert back.roles.shape == known.roles.shape
    assert np.allclose(back.roles, known.roles, atol=1e-3)
    assert matcher.from_bytes(b"another model" + data) is None
    assert matcher.from_bytes(None) is None


def test_cards_say_the_task_with_the_things_of_its_query() -> None:
    query = ContextualQuery("hang_up", ("coat", "hook"))
    says, call = cards_of(query, "eventually {1} is on {2}")
    assert says.words == ("eventually", "coat", "is", "on", "hook")
    assert call.words == ("hang", "up", "coat", "hook")
    assert says.mentions == (((1, 2),), ((4, 5),))
    assert cards_of(query, "it is done") == (call,)
    assert cards_of(query, "") == (call,)
