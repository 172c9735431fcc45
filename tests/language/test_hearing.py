"""How what was taught and what the networks know weigh against each other."""

from __future__ import annotations

import pytest
from hypothesis import given
from hypothesis import strategies as st

from models.language import TaughtTranslator, Translation
from models.language.hearing import DOUBTED, Lessons, parted
from models.language.matching import Matcher, Shelf
from models.language.translation import weighed
from models.queries import Composition, ContextualQuery, Operator, Query

A, B, C = (ContextualQuery(name, ("x",)) for name in "abc")


def test_one_source_alone_stays_as_it_is() -> None:
    said = (Translation(A, 0.6), Translation(B, 0.2))
    assert weighed(said, ()) == said
    assert weighed((), said) == said
    assert weighed((), ()) == ()


def test_each_is_believed_as_far_as_the_other_is_in_doubt() -> None:
    """By hand: odds 0.9 * (1 - 0.3) to 0.3 * (1 - 0.9), of 0.9 + 0.3 - 0.27 in all."""
    first, second = weighed((Translation(A, 0.9),), (Translation(B, 0.3),))
    assert (first.query, second.query) == (A, B)
    assert first.confidence == pytest.approx(0.93 * 0.63 / 0.66)
    assert second.confidence == pytest.approx(0.93 * 0.03 / 0.66)


def test_both_sources_may_say_the_same() -> None:
    (only,) = weighed((Translation(A, 0.5),), (Translation(A, 0.5),))
    assert only.confidence == pytest.approx(0.75)


SHARES = st.lists(st.floats(0.01, 1.0), min_size=1, max_size=3)


@given(SHARES, SHARES)
def test_the_probabilities_are_probabilities(one: list[float], other: list[float]) -> None:
    sources = [
        tuple(
            Translation(query, share / max(1.0, sum(shares))) for query, share in zip((A, B, C), shares, strict=False)
        )
        for shares in (one, other)
    ]
    found = weighed(*sources)
    assert sum(translation.confidence for translation in found) <= 1 + 1e-9
    assert {t.query for t in found} == {t.query for source in sources for t in source}


def avoid(*queries: Query) -> Query:
    return Composition(Operator.AVOID, queries)


@pytest.fixture(scope="module")
def lessons() -> Lessons:
    return Lessons(TaughtTranslator.of([]), Shelf.of([]), Matcher.load(), {}, frozenset({"own"}))


def test_a_task_that_is_forbidden_is_not_all_that_is_said(lessons: Lessons) -> None:
    """ "Don't put the ball in the box" is near to "put the ball in the box"; what it says is the opposite."""
    near, heard = (Translation(A, 0.8),), (Translation(avoid(A), 0.6),)
    assert parted(near[0], heard) == Translation(A, DOUBTED * 0.8)
    assert lessons.doubted(heard[0], near) == heard[0]


def test_a_task_is_not_doubted_for_what_was_hardly_heard(lessons: Lessons) -> None:
    """ "Do not forget to water the hedge" forbids nothing."""
    assert parted(Translation(A, 0.8), (Translation(avoid(A), 0.3), Translation(avoid(B), 0.6))) == Translation(A, 0.8)
    assert parted(Translation(A, 0.8), (Translation(avoid(A), 0.3), Translation(avoid(avoid(A)), 0.3))) != Translation(
        A, 0.8
    )


def test_a_composition_around_one_taught_task_may_be_another_task_in_other_words(lessons: Lessons) -> None:
    """ "No lamp should be left on" is near to turning it off, not to leaving it on."""
    heard = Translation(avoid(A), 0.6)
    assert lessons.doubted(heard, (Translation(B, 0.8),)) == Translation(avoid(A), DOUBTED * 0.6)
    assert parted(Translation(B, 0.8), (heard,)) == Translation(B, 0.8)


def test_a_task_is_doubted_that_says_what_the_networks_heard_forbidden() -> None:
    """ "Don't pick up the sphere" does not ask for a taught task that fetches it."""
    own, other = ContextualQuery("own", A.arguments), ContextualQuery("own", ("y", "z"))
    for heard, expected in ((own, DOUBTED * 0.8), (other, 0.8)):
        assert parted(Translation(A, 0.8), (Translation(avoid(heard), 0.6),), {"own"}).confidence == expected


def test_what_the_networks_know_is_not_doubted(lessons: Lessons) -> None:
    own = ContextualQuery("own", ("x",))
    two = Composition(Operator.AND, (A, avoid(B)))
    for heard in (Translation(A, 0.6), Translation(avoid(own), 0.6), Translation(two, 0.6)):
        assert lessons.doubted(heard, ()) == heard
