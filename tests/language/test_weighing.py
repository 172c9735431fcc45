"""How what was taught and what the networks know weigh against each other."""

from __future__ import annotations

import pytest

from models.language import Translation
from models.language.weighing import DOUBTED, doubted, forbidden_too, parted
from models.queries import Composition, ContextualQuery, Operator, Query

A, B, C = (ContextualQuery(name, ("x",)) for name in "abc")


def avoid(*queries: Query) -> Query:
    return Composition(Operator.AVOID, queries)


def test_a_task_that_is_forbidden_is_not_all_that_is_said() -> None:
    """ "Don't put the ball in the box" is near to "put the ball in the box"; what it says is the opposite."""
    near, heard = (Translation(A, 0.8),), (Translation(avoid(A), 0.6),)
    assert parted(near[0], heard) == Translation(A, DOUBTED * 0.8)
    assert doubted(heard[0], near) == heard[0]


def test_a_task_is_not_doubted_for_what_was_hardly_heard() -> None:
    """ "Do not forget to water the hedge" forbids nothing."""
    assert parted(Translation(A, 0.8), (Translation(avoid(A), 0.3), Translation(avoid(B), 0.6))) == Translation(A, 0.8)
    assert parted(Translation(A, 0.8), (Translation(avoid(A), 0.3), Translation(avoid(avoid(A)), 0.3))) != Translation(
        A, 0.8
    )


def test_a_composition_around_one_taught_task_may_be_another_task_in_other_words() -> None:
    """ "No lamp should be left on" is near to turning it off, not to leaving it on."""
    heard = Translation(avoid(A), 0.6)
    assert doubted(heard, (Translation(B, 0.8),)) == Translation(avoid(A), DOUBTED * 0.6)
    assert parted(Translation(B, 0.8), (heard,)) == Translation(B, 0.8)


def test_a_task_is_doubted_that_says_what_the_networks_heard_forbidden() -> None:
    """ "Don't pick up the sphere" does not ask for a taught task that fetches it."""
    own, other = ContextualQuery("own", A.arguments), ContextualQuery("own", ("y", "z"))
    for heard, expected in ((own, DOUBTED * 0.8), (other, 0.8)):
        assert parted(Translation(A, 0.8), (Translation(avoid(heard), 0.6),), {"own"}).confidence == expected


def test_what_the_networks_know_is_not_doubted() -> None:
    own = ContextualQuery("own", ("x",))
    two = Composition(Operator.AND, (A, avoid(B)))
    for heard in (Translation(A, 0.6), Translation(avoid(own), 0.6), Translation(two, 0.6)):
        assert doubted(heard, (), {"own"}) == heard


def test_what_seems_forbidden_is_nearly_as_likely_as_what_is_asked_for() -> None:
    """ "The ball must never be allowed into the crate" is near to putting it there."""
    found = {said.query: said.confidence for said in forbidden_too([Translation(A, 0.8), Translation(B, 0.1)])}
    assert found == pytest.approx({A: 0.44, avoid(A): 0.36, B: 0.055, avoid(B): 0.045})


def test_several_clauses_that_speak_of_all_things_say_more_than_one_task() -> None:
    """ "Pick up the red cup, then go to the kitchen" is near to bringing it there."""
    near = Translation(ContextualQuery("bring", ("red cup", "kitchen")), 0.8)
    clauses = ContextualQuery("pickup", ("cup", "red")), ContextualQuery("go", ("kitchen",))
    heard = Translation(Composition(Operator.THEN, clauses), 0.9)
    assert parted(near, (heard,), {"pickup", "go"}).confidence == DOUBTED * 0.8
    assert parted(near, (heard,), {"pickup"}) == near, "a clause is a task that was taught"
    alone = Translation(Composition(Operator.AVOID, clauses[:1]), 0.9)
    assert parted(near, (alone,), {"pickup", "go"}) == near, "nothing is said of the kitchen"
